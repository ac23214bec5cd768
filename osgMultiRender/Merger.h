// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Rendering.h>

#include <string>
#include <vector>

namespace osgMultiRender
{

/// What a context allows. The defaults are the least of OpenGL 3.3.
struct MergeLimits
{
    int version = 460;                    ///< Of GLSL.
    int varyingVectors = 15;              ///< GL_MAX_VARYING_VECTORS, or components / 4.
    int fragmentSamplers = 16;            ///< GL_MAX_TEXTURE_IMAGE_UNITS
    int vertexSamplers = 16;              ///< GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS
    int textureUnits = 48;                ///< GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS
    int vertexUniformComponents = 1024;   ///< GL_MAX_VERTEX_UNIFORM_COMPONENTS
    int fragmentUniformComponents = 1024; ///< GL_MAX_FRAGMENT_UNIFORM_COMPONENTS
    int vertexAttributes = 16;            ///< GL_MAX_VERTEX_ATTRIBS
};

/// What a pixel shows where all weights are 0.
enum class MergeOutside
{
    Background,  ///< The pixel is discarded.
    Transparent, ///< (0, 0, 0, 0)
    Base         ///< The base rendering.
};

struct MergeEntry
{
    const Rendering* rendering = nullptr; ///< Must live while mergeRenderings() runs.
    double importance = 1.0; ///< Where a limit is passed, the least one that counts for it goes.
};

struct MergeOptions
{
    GlslVersion version{330, GlslVersion::Profile::Compatibility}; ///< At least; 330 or more.
    /// Index of the entry that gives gl_Position and point sizes, and goes last where limits are
    /// passed. That of no entry: the first one of those that are in gives them.
    std::size_t base = 0;

    /// GLSL that defines `float osgmr_weight(int rendering)`, with the uniforms that it needs.
    /// `rendering` is an entry's index. Empty: all weights are 1 / the number of renderings.
    std::string weights;

    /// Statements at the head of the fragment stage's main(), with what `weights` defines.
    std::string begin;
    /// Name of a function that `weights` defines, `void f(vec3 eyePosition)`. It is called instead
    /// of `begin` where a varying of a rendering is known to hold the fragment's position.
    std::string beginAt;
    /// Name of a function that `weights` defines, `vec4 f(vec4 sum)`: from the sum of weight times
    /// colour, and of the weights, to the fragment's colour. Empty: the sum, clamped to 0 to 1.
    std::string end;

    MergeOutside outside = MergeOutside::Background;
    bool normalize = false;        ///< Divide by the sum of the weights where it is above 1.
    bool clampVertexColors = true; ///< gl_FrontColor as under GL's own GL_CLAMP_VERTEX_COLOR.
    /// gl_LightSource, gl_LightModel, materials and their products are those of RenderingState, for
    /// renderings whose description holds them; else the context's, as for all others.
    bool ownLighting = false;
    /// Bits of the GL lights that are on: a constant in place of a `uniform int osg_EnabledLights`,
    /// so that compilers unroll loops over lights and compute once what renderings have in common
    /// of them. AnyLights: it stays a uniform.
    static constexpr int AnyLights = -1;
    int lights = AnyLights;
    bool skipZeroWeights = true; ///< Branch around renderings of weight 0 where that is defined.
    bool share = true;           ///< Equal functions, constants, structs and varyings once.
    MergeLimits limits;
    std::vector<unsigned int> occupiedUnits; ///< Texture units that renderings' own can't have.
};

struct MergedFile
{
    std::size_t rendering = 0; ///< Index of the entry; their number: our own text.
    std::string name;
};

struct MergedUniform
{
    std::size_t rendering = 0;
    /// As the rendering's author knows it; of a block: the block's name. Members of structs are
    /// there by themselves, too: "lights[1].color".
    std::string name;
    std::string merged;   ///< In the merged program.
    std::string type;     ///< "block" for uniform and storage blocks.
    bool inBlock = false; ///< A member of a block without a name: set by the block's buffer.
    int arraySize = 0;    ///< 0: no array.
    bool vertex = false, fragment = false; ///< The stages that declare it.
    std::vector<unsigned int> units;       ///< Of samplers: the texture unit of each element.
    int ownBinding = -1; ///< Of blocks: the one that the rendering's text asks for.
    int binding = -1;    ///< Of blocks: one that no other block of the program has.
};

struct MergedTexture
{
    unsigned int unit = 0;     ///< In the merged program.
    std::size_t rendering = 0; ///< The first one that uses it.
    unsigned int ownUnit = 0;  ///< As that rendering counts.
    bool own = false; ///< A texture of that rendering; false: the model's texture at this unit.
};

struct MergedAttribute
{
    std::string name;   ///< As the first rendering that has it knows it.
    std::string merged; ///< In the merged program.
    std::string type;
    int location = -1; ///< -1: not bound.
};

enum class MergeSeverity
{
    Note,
    Warning,
    Error ///< The rendering is left out.
};

struct MergeMessage
{
    MergeSeverity severity = MergeSeverity::Note;
    std::size_t rendering = 0; ///< Their number: about all.
    std::string text;          ///< "phong.frag:12: …", one line.
};

/// What became of one entry.
struct MergedRendering
{
    std::string name; ///< As an identifier, without the id: "electronic_microscope".
    bool included = false;
    bool discards = false;
    bool writesDepth = false;
    bool usesDerivatives = false; ///< Evaluated in each fragment, whatever its weight.
    bool movesVertices = false;   ///< gl_Position is not the base's.
    std::vector<std::string> qualified, functions, globals; ///< The paper's lists; own names.
    std::vector<unsigned int> textureUnits;                 ///< As the rendering counts.
};

struct MergeStatistics
{
    double milliseconds = 0.0;
    std::size_t sharedFunctions = 0, sharedConstants = 0, sharedStructs = 0, sharedVaryings = 0;
    int varyingVectors = 0, varyingComponents = 0;
    int fragmentSamplers = 0, vertexSamplers = 0, textureUnits = 0;
    int vertexUniformComponents = 0, fragmentUniformComponents = 0;
    int vertexAttributes = 0;
};

/// One program made of many.
struct OSGMULTIRENDER_EXPORT Merged
{
    bool ok = false; ///< False: no entry is included, or the options are wrong.
    GlslVersion version;
    std::string vertex, fragment;            ///< Complete sources.
    std::vector<MergedRendering> renderings; ///< One an entry.
    std::vector<MergedUniform> uniforms;
    std::vector<MergedTexture> textures;
    std::vector<MergedAttribute> attributes;
    std::vector<MergedFile> files; ///< By the numbers that "#line" gives.
    std::vector<MergeMessage> messages;
    MergeStatistics statistics;

    /// A uniform or block by entry and its author's name; null if there is none.
    const MergedUniform* findUniform(std::size_t rendering, const std::string& name) const;

    /// "lights[2].color" of an entry as the merged program has it; empty if there is none.
    std::string nameOf(std::size_t rendering, const std::string& name) const;

    /// A compiler's or linker's log with the renderings' own files and lines:
    /// "phong.frag:12: 'x' undeclared".
    std::string explain(const std::string& log) const;
};

/// Makes one vertex and one fragment source of the programs of several renderings.
///
/// Each fragment's colour is the sum of the renderings' colours times their weights, clamped to 0
/// to 1; its alpha is the sum of the weights. A rendering that can't be merged, or that passes a
/// limit, is left out and named in `messages`; the others are merged. Needs no context; callable
/// from any thread.
///
/// - `discard` takes the rendering's weight out; the pixel is discarded if all with weight do.
/// - gl_FragDepth is the mean of the depths by weight; a rendering that writes none has
///   gl_FragCoord.z.
/// - A rendering whose fragment stage takes derivatives (dFdx …, texture lookups that choose the
///   level themselves) is evaluated for all fragments, outside of any branch on the weight.
OSGMULTIRENDER_EXPORT Merged mergeRenderings(const std::vector<MergeEntry>& entries,
                                             const MergeOptions& options = {});

} // namespace osgMultiRender
