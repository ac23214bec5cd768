// SPDX-License-Identifier: MIT
// Reading a rendering for the merger: entities, outputs, features.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslExpand.h>
#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>
#include <cctype>

namespace osgMultiRender
{

namespace
{

constexpr char DefaultVertex[] = R"(#version 120
void main()
{
    gl_Position = ftransform();
    gl_FrontColor = gl_Color;
    gl_BackColor = gl_Color;
    gl_FrontSecondaryColor = gl_SecondaryColor;
    gl_FogFragCoord = abs((gl_ModelViewMatrix * gl_Vertex).z);
    gl_TexCoord[0] = gl_TextureMatrix[0] * gl_MultiTexCoord0;
    gl_TexCoord[1] = gl_TextureMatrix[1] * gl_MultiTexCoord1;
}
)";

std::string identifierOf(const std::string& name)
{
    std::string result;
    for (char c : name)
    {
        const bool word = std::isalnum(static_cast<unsigned char>(c)) && !(c & 0x80);
        if (word)
        {
            result += c;
        }
        else if (!result.empty() && result.back() != '_')
        {
            result += '_';
        }
        if (result.size() >= 64)
        {
            break;
        }
    }
    while (!result.empty() && result.back() == '_')
    {
        result.pop_back();
    }
    const bool digit = !result.empty() && std::isdigit(static_cast<unsigned char>(result[0]));
    return result.empty() || digit || result.compare(0, 3, "gl_") == 0 ? "rendering_" + result
                                                                       : result;
}

/// Texture lookups that choose the level by derivatives, and what takes derivatives itself.
bool takesDerivatives(std::string_view word)
{
    const auto starts = [&](std::string_view prefix)
    { return word.substr(0, prefix.size()) == prefix; };
    const auto holds = [&](std::string_view part)
    { return word.find(part) != std::string_view::npos; };
    if (starts("dFd") || starts("fwidth") || starts("textureQueryL"))
    {
        return true;
    }
    const bool lookup = starts("texture") || starts("shadow1D") || starts("shadow2D");
    return lookup && builtinFunctionSince(word) && !holds("Lod") && !holds("Grad") &&
           !holds("Size") && !holds("Gather") && !holds("Samples") && !holds("Levels");
}

class Reader
{
public:
    Reader(MergeProgram& program, std::vector<MergedFile>& files) : _program(program), _files(files)
    {
    }

    void run()
    {
        const Rendering& rendering = *_program.rendering;
        for (const RenderingShader& shader : rendering.shaders)
        {
            if (shader.stage == GlslStage::Vertex || shader.stage == GlslStage::Fragment)
            {
                const bool vertex = shader.stage == GlslStage::Vertex;
                add(vertex ? _program.vertex : _program.fragment, shader.text, shader.fileName);
            }
            else
            {
                _program.fail((shader.fileName.empty() ? rendering.name : shader.fileName) +
                              ": only vertex and fragment stages can be merged, not geometry or "
                              "tessellation");
            }
        }
        if (_program.fragment.shaders.empty())
        {
            _program.fail(rendering.name + ": it has no fragment shader");
        }
        if (_program.vertex.shaders.empty())
        {
            add(_program.vertex, DefaultVertex, "default vertex shader");
        }
        for (MergeStage* stage : {&_program.vertex, &_program.fragment})
        {
            for (std::size_t i = 0; i < stage->shaders.size(); ++i)
            {
                collect(*stage, i);
            }
            // A declared size bounds what an index that varies may mean.
            stage->texCoords.erase(stage->texCoords.lower_bound(_texCoords),
                                   stage->texCoords.end());
            _texCoords = 32;
            checkMain(*stage);
            findTaints(*stage);
        }
        findDiscards();
    }

private:
    void add(MergeStage& stage, const std::string& text, const std::string& fileName)
    {
        MergeShader shader;
        shader.file = _files.size();
        _files.push_back({_program.id, fileName.empty() ? _program.rendering->name : fileName});
        GlslExpanded expanded = expandGlsl(text, _program.rendering->defines);
        for (GlslExtension& extension : expanded.extensions)
        {
            _program.extensions.push_back(std::move(extension));
        }
        _program.invariantAll = _program.invariantAll || expanded.invariantAll;
        shader.source = parseGlsl(std::move(expanded.text));
        std::vector<GlslMessage> errors = std::move(expanded.errors);
        errors.insert(errors.end(), shader.source.messages.begin(), shader.source.messages.end());
        for (const GlslMessage& error : errors)
        {
            const std::string line =
                error.line ? ":" + std::to_string(shader.authorLine(error.line)) : "";
            _program.fail(_files.back().name + line + ": " + error.message);
        }
        _program.version = std::max(_program.version, shader.source.version.number);
        stage.shaders.push_back(std::move(shader));
    }

    bool isFragment(const MergeStage& stage) const { return &stage == &_program.fragment; }

    /// Globals whose initializers read what main() sets up first: varyings, and what depends on
    /// them.
    void findTaints(MergeStage& stage)
    {
        for (const MergeShader& shader : stage.shaders)
        {
            const GlslSource& source = shader.source;
            for (const GlslDeclaration& one : source.declarations)
            {
                const auto found = stage.entities.find(one.name);
                if (one.kind != GlslDeclaration::Kind::Global || one.initializer.empty() ||
                    found == stage.entities.end() || !readsMain(stage, source, one.initializer))
                {
                    continue;
                }
                found->second.tainted = true;
                const bool main = std::any_of(source.functions.begin(), source.functions.end(),
                                              [](const GlslFunction& f)
                                              { return f.name == "main" && !f.body.empty(); });
                if (!main || source.word(one.initializer.first) == "{")
                {
                    _program.fail(_files, shader, one.nameToken,
                                  "the initializer of '" + one.name + "' can't be merged");
                }
            }
        }
    }

    bool readsMain(const MergeStage& stage, const GlslSource& source, const GlslRange& range) const
    {
        static const std::set<std::string_view> written = {"gl_Color", "gl_SecondaryColor",
                                                           "gl_TexCoord", "gl_FogFragCoord"};
        for (std::size_t i = range.first; i < range.last; ++i)
        {
            const GlslUse::Kind use = source.uses[i].kind;
            const auto found = stage.entities.find(std::string(source.word(i)));
            const bool entity =
                (use == GlslUse::Kind::Global || use == GlslUse::Kind::BlockMember) &&
                found != stage.entities.end();
            if (use == GlslUse::Kind::Function ||
                (use == GlslUse::Kind::Builtin && isFragment(stage) &&
                 written.count(source.word(i))) ||
                (entity &&
                 (found->second.tainted || found->second.kind == MergeEntity::Kind::Varying)))
            {
                return true;
            }
        }
        return false;
    }

    /// Whether `discard` stands in a function that another one calls.
    void findDiscards()
    {
        for (const MergeShader& shader : _program.fragment.shaders)
        {
            const GlslSource& source = shader.source;
            for (const GlslFunction& function : source.functions)
            {
                for (std::size_t i = function.body.first;
                     function.name != "main" && i < function.body.last; ++i)
                {
                    _program.discardsInLoops = _program.discardsInLoops ||
                                               (source.tokens[i].kind == GlslToken::Kind::Keyword &&
                                                source.word(i) == "discard");
                }
            }
        }
    }

    void checkMain(const MergeStage& stage)
    {
        std::size_t mains = 0;
        for (const MergeShader& shader : stage.shaders)
        {
            for (const GlslFunction& function : shader.source.functions)
            {
                mains += function.name == "main" && !function.body.empty() ? 1 : 0;
            }
        }
        if (mains != 1 && !_program.failed)
        {
            _program.fail(_program.rendering->name + ": " +
                          (mains ? "several shader objects define" : "no shader object defines") +
                          " main of the " + (isFragment(stage) ? "fragment" : "vertex") + " stage");
        }
    }

    void collect(MergeStage& stage, std::size_t index)
    {
        const GlslSource& source = stage.shaders[index].source;
        const std::vector<bool> local = localTokens(source);
        _blockOf.assign(source.declarations.size(), nullptr);
        for (const GlslBlock& one : source.blocks)
        {
            for (std::size_t member : one.members)
            {
                _blockOf[member] = &one;
            }
        }
        for (std::size_t i = 0; i < source.declarations.size(); ++i)
        {
            const GlslDeclaration& one = source.declarations[i];
            if (one.kind == GlslDeclaration::Kind::Global ||
                one.kind == GlslDeclaration::Kind::BlockMember)
            {
                declaration(stage, index, i);
            }
        }
        for (std::size_t i = 0; i < source.functions.size(); ++i)
        {
            place(stage, source.functions[i].name, MergeEntity::Kind::Function, {index, i},
                  source.functions[i].nameToken);
        }
        for (std::size_t i = 0; i < source.structs.size(); ++i)
        {
            if (!source.structs[i].name.empty())
            {
                // A local one of the same name follows its global name.
                place(stage, source.structs[i].name, MergeEntity::Kind::Struct, {index, i},
                      source.structs[i].nameToken);
                stage.entities[source.structs[i].name].localStruct |=
                    local[source.structs[i].nameToken];
            }
        }
        for (std::size_t i = 0; i < source.blocks.size(); ++i)
        {
            block(stage, index, i);
        }
        layouts(source);
        features(stage, index);
    }

    /// "layout(early_fragment_tests) in;" counts for the whole program, so it can't be one's own.
    void layouts(const GlslSource& source)
    {
        for (const GlslSpecifiers& specifiers : source.specifiers)
        {
            for (const GlslQualifier& qualifier : specifiers.qualifiers)
            {
                for (std::size_t i = qualifier.range.first; i < qualifier.range.last; ++i)
                {
                    if (specifiers.type.empty() && source.word(i) == "early_fragment_tests")
                    {
                        _program.note(_program.rendering->name +
                                      ": early_fragment_tests is not taken: it would hold for the "
                                      "other renderings, too");
                    }
                }
            }
        }
    }

    /// The tokens that lie within functions.
    static std::vector<bool> localTokens(const GlslSource& source)
    {
        std::vector<bool> local(source.tokens.size() + 1, false);
        for (const GlslFunction& function : source.functions)
        {
            for (std::size_t i = function.body.first; i < function.body.last; ++i)
            {
                local[i] = true;
            }
        }
        return local;
    }

    void place(MergeStage& stage, const std::string& name, MergeEntity::Kind kind,
               MergeEntity::Place where, std::size_t token)
    {
        const auto [found, added] = stage.entities.try_emplace(name);
        MergeEntity& entity = found->second;
        if (added)
        {
            entity.kind = kind;
        }
        else if (entity.kind != kind)
        {
            _program.fail(_files, stage.shaders[where.shader], token,
                          "'" + name + "' is declared as something else before");
        }
        entity.places.push_back(where);
    }

    void declaration(MergeStage& stage, std::size_t shader, std::size_t index)
    {
        const GlslSource& source = stage.shaders[shader].source;
        const GlslDeclaration& one = source.declarations[index];
        const GlslBlock* inBlock = _blockOf[index];
        const GlslSpecifiers& specifiers =
            source.specifiers[inBlock ? inBlock->specifiers : one.specifiers];
        if (inBlock && inBlock->name.compare(0, 3, "gl_") == 0)
        {
            return;
        }
        if (one.name.compare(0, 3, "gl_") == 0)
        {
            redeclaration(source, one);
            return;
        }
        MergeEntity::Kind kind = MergeEntity::Kind::Variable;
        const bool in = specifiers.has("in"), out = specifiers.has("out");
        if (specifiers.has("uniform") || specifiers.has("buffer"))
        {
            kind = MergeEntity::Kind::Uniform;
        }
        else if (specifiers.has("attribute") || (in && !isFragment(stage)))
        {
            kind = MergeEntity::Kind::Attribute;
        }
        else if (specifiers.has("varying") || in || (out && !isFragment(stage)))
        {
            kind = MergeEntity::Kind::Varying;
        }
        else if (out)
        {
            kind = MergeEntity::Kind::Output;
        }
        else if (specifiers.has("const"))
        {
            kind = MergeEntity::Kind::Constant;
        }
        if (specifiers.has("subroutine"))
        {
            _program.fail(_files, stage.shaders[shader], one.nameToken,
                          "subroutines can't be merged");
        }
        place(stage, one.name, kind, {shader, index}, one.nameToken);
    }

    /// "varying vec4 gl_TexCoord[3];"
    void redeclaration(const GlslSource& source, const GlslDeclaration& one)
    {
        std::vector<int> sizes;
        if (one.name == "gl_TexCoord" && arraySizes(source, one.array, sizes) && sizes.size() == 1)
        {
            _texCoords = std::min(_texCoords, sizes[0]);
        }
        for (const GlslQualifier& qualifier : source.specifiersOf(one).qualifiers)
        {
            if (one.name == "gl_FragCoord" && qualifier.word == "layout")
            {
                _program.fail(_program.rendering->name +
                              ": gl_FragCoord with a layout can't be merged");
            }
        }
    }

    void block(MergeStage& stage, std::size_t shader, std::size_t index)
    {
        const GlslSource& source = stage.shaders[shader].source;
        const GlslBlock& one = source.blocks[index];
        if (one.name.compare(0, 3, "gl_") == 0)
        {
            return;
        }
        place(stage, one.name, MergeEntity::Kind::Block, {shader, index}, one.nameToken);
    }

    /// What the code of a shader object uses.
    void features(MergeStage& stage, std::size_t index)
    {
        const GlslSource& source = stage.shaders[index].source;
        for (std::size_t i = 0; i < source.tokens.size(); ++i)
        {
            const std::string_view word = source.word(i);
            if (source.tokens[i].kind == GlslToken::Kind::Keyword)
            {
                _program.discards = _program.discards || (isFragment(stage) && word == "discard");
                continue;
            }
            const GlslUse& meant = source.uses[i];
            const bool variable =
                meant.kind == GlslUse::Kind::Global || meant.kind == GlslUse::Kind::BlockMember;
            if (variable && source.declarations[meant.target].nameToken != i)
            {
                stage.usedGlobals.emplace(word);
            }
            // Redeclared ones are globals: "varying vec4 gl_TexCoord[2];".
            const GlslUse::Kind use = source.uses[i].kind;
            const bool redeclared = use == GlslUse::Kind::Global && word.substr(0, 3) == "gl_" &&
                                    source.declarations[source.uses[i].target].nameToken != i;
            if (use != GlslUse::Kind::Builtin && !redeclared)
            {
                continue;
            }
            const bool derives = isFragment(stage) && takesDerivatives(word);
            _program.derivatives = _program.derivatives || derives;
            if (word.substr(0, 3) == "gl_" || word == "ftransform")
            {
                stage.usedBuiltins.emplace(word);
                indexed(stage, source, i);
            }
            if (word.substr(0, 13) == "interpolateAt")
            {
                _program.fail(_files, stage.shaders[index], i,
                              std::string(word) + " can't be merged: varyings are packed");
            }
            if (word.substr(0, 20) == "gl_SecondaryFragData" ||
                word.substr(0, 21) == "gl_SecondaryFragColor")
            {
                _program.fail(_files, stage.shaders[index], i,
                              "dual-source blending can't be merged");
            }
        }
    }

    /// The size that "gl_TexCoord[2]" asks for.
    void indexed(MergeStage& stage, const GlslSource& source, std::size_t token)
    {
        const std::string_view word = source.word(token);
        if (word != "gl_TexCoord" && word != "gl_FragData" && word != "gl_ClipDistance")
        {
            return;
        }
        std::size_t open = token + 1;
        while (open < source.tokens.size() && source.tokens[open].blank())
        {
            ++open;
        }
        std::size_t close = open;
        while (close < source.tokens.size() && source.word(close) != "]" && close < open + 16)
        {
            ++close;
        }
        bool known = false;
        const long long index = open < close && source.word(open) == "["
                                    ? constantOf(source, open + 1, close, known)
                                    : 0;
        // An index that varies, or the whole array: all that contexts have.
        const int last = known && index >= 0 && index < 32 ? static_cast<int>(index) : 7;
        if (word == "gl_TexCoord")
        {
            for (int i = known ? last : 0; i <= last; ++i)
            {
                stage.texCoords.insert(i);
            }
            return;
        }
        int& size = word == "gl_FragData" ? stage.fragData : stage.clipDistances;
        size = std::max(size, last + 1);
    }

    MergeProgram& _program;
    std::vector<MergedFile>& _files;
    int _texCoords = 32;                    ///< The declared size of gl_TexCoord.
    std::vector<const GlslBlock*> _blockOf; ///< By declaration of the source that is read.
};

} // namespace

MergeProgram readMergeProgram(const Rendering& rendering, std::size_t id,
                              std::vector<MergedFile>& files)
{
    MergeProgram program;
    program.id = id;
    program.rendering = &rendering;
    program.name = identifierOf(rendering.name);
    Reader(program, files).run();
    program.discards = program.discards || !alphaTestOf(rendering.state, "a").empty();
    return program;
}

} // namespace osgMultiRender
