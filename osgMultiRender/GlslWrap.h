// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/GlslSource.h>

#include <map>
#include <string>
#include <vector>

namespace osgMultiRender
{

enum class GlslStage
{
    Vertex,
    TessellationControl,
    TessellationEvaluation,
    Geometry,
    Fragment
};

/// One shader object of a program.
struct GlslShader
{
    GlslStage stage = GlslStage::Fragment;
    std::string text;
};

/// A colour that the user's fragment stage writes.
struct GlslOutput
{
    /// The size of gl_FragData that is indexed with a variable.
    static constexpr int AllDrawBuffers = -1;

    std::string name;          ///< As the application knows it: "color", "gl_FragColor".
    std::string variable;      ///< The plain global that now holds it: "color", "osgmr_fragColor".
    std::string type;          ///< "vec4", "uint", …
    int location = -1;         ///< Of its first element; -1: the text doesn't say.
    int arraySize = 0;         ///< 0: no array.
    std::vector<int> elements; ///< The written ones where they are known; empty: all.
    bool broadcast = false;    ///< gl_FragColor: goes to each draw buffer.
    bool conditional = false;  ///< Declared under an #if that was not known here.
};

/// A finding about one shader object.
struct GlslWrapMessage
{
    std::size_t shader = 0; ///< Index of the shader object; their number: about the whole program.
    GlslMessage where;
};

/// A program whose fragment stage can be called.
struct GlslWrapped
{
    bool ok = false;
    GlslVersion version;            ///< For our own shader objects of this program.
    std::vector<std::string> texts; ///< One a shader object, in their order; empty unless ok.
    std::vector<GlslOutput> outputs;
    std::vector<GlslWrapMessage> errors;   ///< Why it is not ok, in one clause each.
    std::vector<GlslWrapMessage> warnings; ///< Doubts; the compiler has the last word.
};

/// Makes the `main` of a program's fragment stage a function `osgmr_userMain` that writes globals.
///
/// gl_FragColor, gl_FragData and `out` variables become plain globals, shared between the shader
/// objects of the stage; `discard`, gl_FragDepth and inputs stay. Texts below `target` are raised
/// to its number, all alike, texts of 150 core to its core profile; names that are keywords or
/// built-in functions there and were not before are renamed ("osgmr_user_sample"), except names
/// that the application addresses (uniforms, attributes, varyings): then the result is not ok and
/// says which. The other stages are only raised. Lines of compiler messages stay those of the user.
/// `target` must be 330 or more. `isOurs`: names that begin with osgmr_ are taken, as in what
/// mergeRenderings() makes. Needs no context; callable from any thread.
OSGMULTIRENDER_EXPORT GlslWrapped wrapProgram(const std::vector<GlslShader>& shaders,
                                              const GlslVersion& target, bool isOurs = false);

/// Gives each output its location: that of the text, else of `bindings` (by name, as
/// glBindFragDataLocation), else the next free one. False, with the cause in `error`, where two
/// outputs meet.
OSGMULTIRENDER_EXPORT bool bindOutputs(std::vector<GlslOutput>& outputs,
                                       const std::map<std::string, unsigned int>& bindings,
                                       std::string& error);

/// GLSL that wrapperMain() adds for a kit.
struct GlslSnippet
{
    std::string declarations; ///< Before main: outputs of its own, functions, uniforms.
    std::string statements;   ///< In main, behind the assignment of the user's outputs.
};

struct GlslMainOptions
{
    int drawBuffers = 1;        ///< As many get gl_FragColor.
    int maximumDrawBuffers = 8; ///< GL_MAX_DRAW_BUFFERS of the context.
    int userLocations = 8;      ///< Outputs at these locations and above are not written.
    std::vector<GlslSnippet> snippets;
};

/// The text of a further fragment shader object with our `main`.
///
/// It declares `layout(location = n) out T osgmr_outn` for each bound output and
/// `vec4 osgmr_surface()`, which calls the user's main and returns the colour at location 0
/// (missing components are 0, 0, 0, 1; integer outputs give 0). main() assigns, then runs the
/// snippets.
OSGMULTIRENDER_EXPORT std::string wrapperMain(const GlslVersion& version,
                                              const std::vector<GlslOutput>& outputs,
                                              const GlslMainOptions& options = {});

/// "330 compatibility", as behind "#version".
OSGMULTIRENDER_EXPORT std::string toString(const GlslVersion& version);

} // namespace osgMultiRender
