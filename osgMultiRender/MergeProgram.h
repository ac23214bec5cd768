// SPDX-License-Identifier: MIT
// What the merger knows of one rendering. Not installed.
#pragma once

#include <osgMultiRender/GlslExpand.h>
#include <osgMultiRender/Merger.h>

#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

namespace osgMultiRender
{

/// A shader object after the preprocessor.
struct MergeShader
{
    std::size_t file = 0; ///< Index into Merged::files.
    GlslSource source;

    /// The line of a token as its author counts: "#line" moves it.
    unsigned int lineOf(std::size_t token) const;
    unsigned int authorLine(unsigned int line) const;
};

/// A global name of one stage, with all its declarations: overloads are one entity.
struct MergeEntity
{
    enum class Kind
    {
        Function,
        Struct,
        Constant,
        Variable,
        Uniform,
        Attribute,
        Varying, ///< Between the stages; also the members of in and out blocks.
        Output,
        Block
    };

    /// Index of a declaration, function, struct or block in the source of a shader object.
    struct Place
    {
        std::size_t shader = 0, index = 0;
    };

    Kind kind = Kind::Variable;
    std::vector<Place> places;
    std::string merged;       ///< Its name, or an expression, in the merged text.
    bool inPlace = true;      ///< False: declared elsewhere: by another rendering or at the head.
    bool tainted = false;     ///< Its initializer depends on what main() sets up.
    bool localStruct = false; ///< A function declares a struct of that name, too.
};

struct MergeStage
{
    std::vector<MergeShader> shaders;
    std::map<std::string, MergeEntity> entities;
    std::map<std::string, std::string>
        builtins; ///< "gl_FragColor" to the global that stands for it.
    std::map<std::string, std::string> reserved; ///< Locals and fields that become keywords.
    std::set<std::string> usedBuiltins;
    std::set<std::string> usedGlobals; ///< What code uses, beyond declaring it.
    std::set<int> texCoords;           ///< Elements of gl_TexCoord that are used.
    int fragData = 0;                  ///< Size of gl_FragData.
    int clipDistances = 0;

    bool uses(const std::string& builtin) const { return usedBuiltins.count(builtin) != 0; }
};

/// A scalar or vector that goes from the vertex to the fragment stage.
struct MergeVarying
{
    std::string vertex, fragment; ///< Expressions in the merged texts.
    char base = 'f';              ///< f, i, u.
    int components = 1;
    std::string interpolation; ///< "", "flat", "noperspective", with "centroid" or "sample".
    std::string condition;     ///< Only then the fragment's variable takes it; empty: always.
    std::string value;         ///< What is known of its value; empty: nothing.
    std::size_t slot = 0;      ///< Index into the plan's vectors.
    int offset = 0;            ///< First component in it.
    const MergeVarying* sharedWith = nullptr; ///< The one that writes it, if not this one.
};

struct MergeProgram
{
    std::size_t id = 0; ///< Index of the entry.
    const Rendering* rendering = nullptr;
    std::string name; ///< An identifier.
    MergeStage vertex, fragment;
    std::vector<MergeVarying> varyings;
    std::vector<std::string> outputs; ///< Assignments that give each output a value.
    std::string color;                ///< Expression of type vec4 for the result.
    std::string discarded;            ///< The flag's name.
    std::string depth;    ///< The name that stands for gl_FragDepth; empty if not written.
    std::string position; ///< The value of gl_Position by MergeValues; empty if not known.
    bool discards = false, derivatives = false, invariantAll = false;
    bool discardsInLoops = false; ///< A function that discards is called by another one.
    int version = 110;
    std::vector<GlslExtension> extensions;
    std::vector<MergeMessage> messages;
    bool moves = false;
    bool failed = false;

    /// Adds an error about a token of a shader object.
    void fail(const std::vector<MergedFile>& files, const MergeShader& shader, std::size_t token,
              const std::string& text);
    void fail(const std::string& text);
    void note(const std::string& text);
};

/// Names that no source holds, for all that merging adds.
class MergeNames
{
public:
    void take(const GlslSource& source);

    /// "name_2" for entry 2, or the next free one like it.
    std::string make(const std::string& name, std::size_t id);

    /// `name`, or the next free one like it.
    std::string claim(const std::string& name);

private:
    std::unordered_set<std::string> _taken;
};

/// Reads the shaders of a rendering: preprocessor, parser, entities, features.
MergeProgram readMergeProgram(const Rendering& rendering, std::size_t id,
                              std::vector<MergedFile>& files);

/// Finds what the code of a shader object of `stage` uses: built-ins, globals, derivatives,
/// discard.
void findFeatures(MergeProgram& program, MergeStage& stage, const MergeShader& shader,
                  const std::vector<MergedFile>& files);

/// Finds whether `discard` stands in a function that another one calls.
void findDiscards(MergeProgram& program);

/// Marks globals whose initializers read what main() sets up first: varyings, and what depends on
/// them.
void findTaints(MergeProgram& program, MergeStage& stage, const std::vector<MergedFile>& files);

/// The condition under which the rendering's alpha test lets a fragment pass, of an expression for
/// its alpha; empty where all do.
std::string alphaTestOf(const RenderingState& state, const std::string& alpha);

/// Chooses merged names for all that is the rendering's own; with `ownLighting` that is the lights
/// and materials of its description, too.
void nameMergeProgram(MergeProgram& program, MergeNames& names, int version, bool ownLighting);

/// Declares what stands for a built-in of lights or materials by the values of a description; empty
/// for other built-ins.
std::string lightingConstant(const RenderingState& state, const std::string& builtin,
                             const std::string& name);

/// Finds the varyings of a program, by both stages' declarations, when it is named.
void connectStages(MergeProgram& program, const std::vector<MergedFile>& files, bool clampColors);

/// The integer that tokens [first, last) are worth: numbers and constants of the text.
long long constantOf(const GlslSource& source, std::size_t first, std::size_t last, bool& known);

/// The value of "key = n" in the layout of a declaration; -1 if there is none.
int layoutValue(const GlslSource& source, const GlslSpecifiers& specifiers, std::string_view key);

/// The sizes of an array, "[2][3]", outermost first. False if one is not known.
bool arraySizes(const GlslSource& source, const GlslRange& range, std::vector<int>& sizes);

/// Marks the entities that later renderings need not declare again. `all`: not only the uniforms
/// that OSG sets.
void shareEntities(const std::vector<MergeProgram*>& programs, bool all,
                   MergeStatistics& statistics);

/// Lines carry their file in front: some compilers (Mesa) lose the file's number of "#line".
constexpr unsigned long LinesPerFile = 100000;

/// "#line" that gives the next line a number in a file.
std::string lineDirective(std::size_t file, unsigned long line);

/// Finds what varyings and positions are worth, so that equal ones are known.
void valueVaryings(MergeProgram& program);

/// Whether gl_Position is known to be what ftransform() gives.
bool hasUsualPosition(const MergeProgram& program);
/// Whether a varying is known to be gl_ModelViewMatrix * gl_Vertex, smooth over the triangle.
bool isEyePosition(const MergeVarying& varying);

/// One vector that is interpolated, with the components of several renderings.
struct MergeVector
{
    char base = 'f';
    std::string interpolation;
    int used = 0; ///< Components.
    std::string name;
};

/// Gives each varying its place; equal ones share it.
std::vector<MergeVector> packVaryings(const std::vector<MergeProgram*>& programs, bool share,
                                      MergeStatistics& statistics);

/// Decides on attributes and texture units, and what of each limit the programs take.
void planResources(const std::vector<MergeProgram*>& programs, MergeNames& names,
                   const MergeOptions& options, Merged& merged);

/// The complete sources of a plan.
void writeMerged(const std::vector<MergeProgram*>& programs,
                 const std::vector<MergeVector>& vectors, const MergeOptions& options,
                 Merged& merged);

/// The text of a stage of a program as it stands in the merged source.
std::string mergedText(const MergeProgram& program, const MergeStage& stage,
                       const GlslVersion& version);

/// Declarations of the globals that stand for built-ins, flags included.
std::string builtinGlobals(const MergeProgram& program, bool fragment);

} // namespace osgMultiRender
