// SPDX-License-Identifier: MIT
// Reading a rendering for the merger: its shaders and what they declare.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslExpand.h>

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
            findTaints(_program, *stage, _files);
        }
        findDiscards(_program);
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
        findFeatures(_program, stage, stage.shaders[index], _files);
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
