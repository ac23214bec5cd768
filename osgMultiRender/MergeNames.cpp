// SPDX-License-Identifier: MIT
// The names that things have in the merged program.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

/// Built-ins that each rendering writes or reads for itself, by stage.
constexpr const char* VertexBuiltins[] = {
    "gl_Position",   "gl_PointSize",   "gl_ClipVertex",          "gl_ClipDistance",
    "gl_FrontColor", "gl_BackColor",   "gl_FrontSecondaryColor", "gl_BackSecondaryColor",
    "gl_TexCoord",   "gl_FogFragCoord"};
constexpr const char* FragmentBuiltins[] = {"gl_FragColor",   "gl_FragData",       "gl_FragDepth",
                                            "gl_Color",       "gl_SecondaryColor", "gl_TexCoord",
                                            "gl_FogFragCoord"};
/// Those that are its own where its description holds materials, lights.
constexpr const char* MaterialBuiltins[] = {"gl_FrontMaterial", "gl_BackMaterial", "gl_LightModel",
                                            "gl_FrontLightModelProduct",
                                            "gl_BackLightModelProduct"};
constexpr const char* LightBuiltins[] = {"gl_LightSource", "gl_FrontLightProduct",
                                         "gl_BackLightProduct"};

/// "gl_FragColor" as "fragColor".
std::string plainName(const std::string& builtin)
{
    std::string name = builtin.substr(3);
    name[0] = static_cast<char>(name[0] - 'A' + 'a');
    return name;
}

template <std::size_t N>
void nameBuiltins(MergeStage& stage, const char* const (&builtins)[N], MergeNames& names,
                  std::size_t id, std::map<std::string, std::string>& both)
{
    for (const char* builtin : builtins)
    {
        if (stage.uses(builtin))
        {
            const auto [found, added] = both.try_emplace(builtin);
            found->second = added ? names.make(plainName(builtin), id) : found->second;
            stage.builtins[builtin] = found->second;
        }
    }
}

/// Names that OSG sets itself are one uniform for all.
bool setByOsg(const std::string& name, Kind kind)
{
    return kind == Kind::Uniform && name.compare(0, 4, "osg_") == 0;
}

void nameReserved(MergeStage& stage, std::map<std::string, std::string>& known, MergeNames& names,
                  std::size_t id, int version)
{
    for (const MergeShader& shader : stage.shaders)
    {
        const GlslSource& source = shader.source;
        for (std::size_t i = 0; i < source.tokens.size(); ++i)
        {
            if (source.tokens[i].kind != GlslToken::Kind::Identifier)
            {
                continue;
            }
            const std::string word(source.word(i));
            const int since = reservedSince(word);
            if (since && since <= version)
            {
                const auto [found, added] = known.try_emplace(word);
                found->second = added ? names.make(word, id) : found->second;
            }
        }
    }
    stage.reserved = known;
}

} // namespace

void MergeNames::take(const GlslSource& source)
{
    for (const GlslToken& token : source.tokens)
    {
        if (token.kind == GlslToken::Kind::Identifier || token.kind == GlslToken::Kind::Keyword)
        {
            _taken.emplace(textOf(source.text, token));
        }
    }
}

std::string MergeNames::claim(const std::string& name)
{
    std::string stem = name, result = name;
    for (char more = 'b'; !_taken.insert(result).second; ++more)
    {
        result = stem + more;
        if (more == 'z')
        {
            stem += 'z';
            more = 'a';
        }
    }
    return result;
}

std::string MergeNames::make(const std::string& name, std::size_t id)
{
    std::string stem = name;
    while (!stem.empty() && stem.back() == '_')
    {
        // Two underlines are reserved.
        stem.pop_back();
    }
    return claim((stem.empty() ? "x" : stem) + "_" + std::to_string(id));
}

void nameMergeProgram(MergeProgram& program, MergeNames& names, int version, bool ownLighting)
{
    std::map<std::string, std::string> both, reserved;
    const std::string mainName = program.name + "_" + std::to_string(program.id) + "_main";
    for (MergeStage* stage : {&program.vertex, &program.fragment})
    {
        nameReserved(*stage, reserved, names, program.id, version);
        if (ownLighting && program.rendering->state.hasMaterials)
        {
            nameBuiltins(*stage, MaterialBuiltins, names, program.id, both);
        }
        if (ownLighting && !program.rendering->state.lights.empty())
        {
            nameBuiltins(*stage, LightBuiltins, names, program.id, both);
        }
        for (auto& [name, entity] : stage->entities)
        {
            if (setByOsg(name, entity.kind) || entity.kind == Kind::Attribute)
            {
                entity.merged = name;
                continue;
            }
            const auto [found, added] = both.try_emplace(name);
            const auto word = reserved.find(name);
            if (added)
            {
                found->second = name == "main"           ? names.claim(mainName)
                                : word == reserved.end() ? names.make(name, program.id)
                                                         : word->second;
            }
            entity.merged = found->second;
        }
    }
    nameBuiltins(program.vertex, VertexBuiltins, names, program.id, both);
    nameBuiltins(program.fragment, FragmentBuiltins, names, program.id, both);
    program.discarded = program.discards ? names.make("discarded", program.id) : "";
    const auto depth = program.fragment.builtins.find("gl_FragDepth");
    program.depth = depth == program.fragment.builtins.end() ? "" : depth->second;
}

} // namespace osgMultiRender
