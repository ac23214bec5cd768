// SPDX-License-Identifier: MIT
// Attributes, uniforms and texture units of a merged program.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>
#include <cstdlib>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

bool isSampler(std::string_view type)
{
    return type.substr(0, 7) == "sampler" || (type.size() > 8 && type.substr(1, 7) == "sampler");
}

/// Components of a built-in type; 0 for others.
int componentsOf(const std::string& type)
{
    const auto digit = [&](std::size_t at)
    { return at < type.size() && type[at] >= '2' && type[at] <= '4' ? type[at] - '0' : 0; };
    const std::size_t vector = type.find("vec"), matrix = type.find("mat");
    if (vector != std::string::npos && vector <= 1)
    {
        return digit(vector + 3);
    }
    if (matrix != std::string::npos && matrix <= 1)
    {
        const int columns = digit(matrix + 3), rows = digit(matrix + 5);
        return columns * (rows ? rows : columns);
    }
    return isBuiltinType(type) && type != "void" ? 1 : 0;
}

struct Attribute
{
    MergeProgram* program;
    MergeEntity* entity;
    std::string name, type;
    int location;
};

class Resources
{
public:
    Resources(const std::vector<MergeProgram*>& programs, MergeNames& names,
              const MergeOptions& options, Merged& merged)
        : _programs(programs), _names(names), _options(options), _merged(merged)
    {
    }

    void run()
    {
        _merged.attributes.clear();
        _merged.uniforms.clear();
        _merged.textures.clear();
        MergeStatistics& s = _merged.statistics;
        s.vertexSamplers = s.fragmentSamplers = s.textureUnits = 0;
        s.vertexUniformComponents = s.fragmentUniformComponents = 0;
        attributes();
        for (MergeProgram* program : _programs)
        {
            uniforms(*program);
        }
        units();
    }

private:
    void attributes()
    {
        std::set<std::string> builtins;
        std::vector<Attribute> all;
        for (MergeProgram* program : _programs)
        {
            for (const std::string& name : program->vertex.usedBuiltins)
            {
                const bool attribute = name == "gl_Vertex" || name == "gl_Normal" ||
                                       name == "gl_Color" || name == "gl_SecondaryColor" ||
                                       name == "gl_FogCoord" ||
                                       name.compare(0, 16, "gl_MultiTexCoord") == 0;
                if (attribute || name == "ftransform")
                {
                    builtins.insert(attribute ? name : "gl_Vertex");
                }
            }
            collectAttributes(*program, all);
        }
        // Bound ones first: an unbound one of the same name joins them.
        std::stable_sort(all.begin(), all.end(),
                         [](const Attribute& a, const Attribute& b)
                         { return (a.location >= 0) > (b.location >= 0); });
        std::vector<std::vector<const Attribute*>> groups;
        for (const Attribute& one : all)
        {
            place(one, builtins.count("gl_Vertex") != 0, groups);
        }
        for (const std::vector<const Attribute*>& group : groups)
        {
            name(group);
        }
        _merged.statistics.vertexAttributes =
            static_cast<int>(builtins.size() + _merged.attributes.size());
    }

    void collectAttributes(MergeProgram& program, std::vector<Attribute>& all)
    {
        for (auto& [name, entity] : program.vertex.entities)
        {
            if (entity.kind != Kind::Attribute)
            {
                continue;
            }
            const MergeEntity::Place& place = entity.places.front();
            const GlslSource& source = program.vertex.shaders[place.shader].source;
            const GlslDeclaration& one = source.declarations[place.index];
            const auto bound = program.rendering->attributeBindings.find(name);
            int location = layoutValue(source, source.specifiersOf(one), "location");
            if (location < 0 && bound != program.rendering->attributeBindings.end())
            {
                location = static_cast<int>(std::min(bound->second, 255u));
            }
            entity.inPlace = false;
            all.push_back({&program, &entity, name, source.specifiersOf(one).type, location});
            if (!one.array.empty() || componentsOf(all.back().type) == 0)
            {
                program.fail(program.rendering->name + ": the attribute '" + name +
                             "' is of a type that can't be merged");
            }
        }
    }

    /// In compatibility contexts attribute 0 and gl_Vertex are the same array.
    void place(const Attribute& one, bool vertexIsBuiltin,
               std::vector<std::vector<const Attribute*>>& groups)
    {
        if (one.location == 0 && vertexIsBuiltin && isVector(one.type))
        {
            one.entity->merged = "gl_Vertex" + swizzle(componentsOf(one.type), 4);
            return;
        }
        for (std::vector<const Attribute*>& group : groups)
        {
            const Attribute& other = *group.front();
            const bool same =
                one.location >= 0 ? one.location == other.location : one.name == other.name;
            if (!same)
            {
                continue;
            }
            if (one.type != other.type && !(isVector(one.type) && isVector(other.type)))
            {
                one.program->fail(one.program->rendering->name + ": the attribute '" + one.name +
                                  "' is " + one.type + ", but " + other.type +
                                  " in another rendering");
                return;
            }
            group.push_back(&one);
            return;
        }
        groups.push_back({&one});
    }

    static bool isVector(const std::string& type)
    {
        return type == "float" || type.compare(0, 3, "vec") == 0;
    }

    /// Keeps the name that the application binds, unless it would mean something else somewhere.
    void name(const std::vector<const Attribute*>& group)
    {
        const Attribute& first = *group.front();
        const auto sameName = [&](const Attribute* one) { return one->name == first.name; };
        const auto taken = [&](const MergedAttribute& one) { return one.merged == first.name; };
        const int since = reservedSince(first.name);
        const bool keeps =
            std::all_of(group.begin(), group.end(), sameName) &&
            std::none_of(_merged.attributes.begin(), _merged.attributes.end(), taken) &&
            !(since && since <= _merged.version.number) && !builtinFunctionSince(first.name);
        MergedAttribute made;
        made.name = first.name;
        made.merged = keeps ? first.name : _names.make(first.name, first.program->id);
        made.type = isVector(first.type) ? "vec4" : first.type;
        made.location = first.location;
        for (const Attribute* one : group)
        {
            one->entity->merged =
                made.merged + (isVector(one->type) ? swizzle(componentsOf(one->type), 4) : "");
        }
        _merged.attributes.push_back(std::move(made));
    }

    static std::string swizzle(int components, int of)
    {
        return components == of ? "" : "." + std::string("xyzw").substr(0, std::size_t(components));
    }

    void uniforms(MergeProgram& program)
    {
        std::map<std::string, std::size_t> made;
        for (MergeStage* stage : {&program.vertex, &program.fragment})
        {
            const std::set<std::string>& used = stage->usedGlobals;
            for (const auto& [name, entity] : stage->entities)
            {
                if (entity.kind == Kind::Uniform || entity.kind == Kind::Block)
                {
                    uniform(program, *stage, name, entity, used.count(name) != 0, made);
                }
            }
        }
    }

    void uniform(MergeProgram& program, const MergeStage& stage, const std::string& name,
                 const MergeEntity& entity, bool used, std::map<std::string, std::size_t>& made)
    {
        const bool isFragment = &stage == &program.fragment;
        const MergeEntity::Place& place = entity.places.front();
        const GlslSource& source = stage.shaders[place.shader].source;
        MergedUniform one;
        one.rendering = program.id;
        one.name = name;
        one.merged = entity.merged;
        int components = 0;
        if (entity.kind == Kind::Block)
        {
            const GlslBlock& block = source.blocks[place.index];
            const GlslSpecifiers& specifiers = source.specifiers[block.specifiers];
            if (!specifiers.has("uniform") && !specifiers.has("buffer"))
            {
                return;
            }
            one.type = "block";
            one.ownBinding = layoutValue(source, specifiers, "binding");
            one.binding =
                made.count(name) ? 0 : bindingFor(one.ownBinding, specifiers.has("buffer"));
        }
        else
        {
            const GlslDeclaration& declared = source.declarations[place.index];
            const bool instance = std::any_of(source.blocks.begin(), source.blocks.end(),
                                              [&](const GlslBlock& block)
                                              { return block.specifiers == declared.specifiers; });
            one.inBlock = declared.kind == GlslDeclaration::Kind::BlockMember;
            if (instance || (one.inBlock && entity.merged.empty()))
            {
                return;
            }
            one.type = source.specifiersOf(declared).type;
            if (one.merged == name && name.compare(0, 4, "osg_") == 0 &&
                _osgTypes.emplace(name, one.type).first->second != one.type)
            {
                program.fail(program.rendering->name + ": the uniform '" + name + "' is " +
                             one.type + ", but " + _osgTypes[name] + " in another rendering");
            }
            std::vector<int> sizes;
            arraySizes(source, declared.array, sizes);
            arraySizes(source, source.specifiersOf(declared).typeArray, sizes);
            int count = 1;
            for (int size : sizes)
            {
                count = static_cast<int>(std::min(1LL * count * size, 1000000LL));
            }
            one.arraySize = sizes.empty() ? 0 : count;
            components = used && !one.inBlock ? count * sizeOf(source, one.type, 0) : 0;
            if (isSampler(one.type) && used)
            {
                samplers(program, one, source, declared);
            }
        }
        MergeStatistics& s = _merged.statistics;
        int& total = isFragment ? s.fragmentUniformComponents : s.vertexUniformComponents;
        total = static_cast<int>(std::min(1LL * total + components, 1000000000LL));
        const auto [found, added] = made.emplace(name, _merged.uniforms.size());
        if (added)
        {
            _merged.uniforms.push_back(one);
        }
        MergedUniform& kept = _merged.uniforms[found->second];
        if (kept.type != one.type)
        {
            program.fail(program.rendering->name + ": the uniform '" + name + "' is " + one.type +
                         ", but " + kept.type + " in the vertex stage");
        }
        kept.units = kept.units.empty() ? one.units : kept.units;
        kept.vertex = kept.vertex || !isFragment;
        kept.fragment = kept.fragment || isFragment;
        const int samplerCount = static_cast<int>(one.units.size());
        (isFragment ? s.fragmentSamplers : s.vertexSamplers) += samplerCount;
    }

    /// The binding that a block asks for, if it is free, else the next free one.
    int bindingFor(int asked, bool storage)
    {
        std::set<int>& taken = _bindings[storage ? 1 : 0];
        int binding = std::max(asked, 0);
        while (!taken.insert(binding).second)
        {
            ++binding;
        }
        return binding;
    }

    int sizeOf(const GlslSource& source, const std::string& type, int depth) const
    {
        if (isSampler(type) || depth > 8)
        {
            return 1;
        }
        const int components = componentsOf(type);
        int sum = 0;
        for (const GlslStruct& one : source.structs)
        {
            for (std::size_t member : one.members)
            {
                if (components || one.name != type || sum > 100000)
                {
                    break;
                }
                const GlslDeclaration& field = source.declarations[member];
                std::vector<int> sizes;
                arraySizes(source, field.array, sizes);
                const int count = sizes.size() == 1 ? sizes[0] : 1;
                sum += count * sizeOf(source, source.specifiersOf(field).type, depth + 1);
            }
        }
        return components ? components : std::max(sum, 1);
    }

    /// The units that a sampler has in its own rendering; units() moves them.
    void samplers(const MergeProgram& program, MergedUniform& one, const GlslSource& source,
                  const GlslDeclaration& declared)
    {
        const RenderingUniform* known = program.rendering->findUniform(one.name);
        const int bound = layoutValue(source, source.specifiersOf(declared), "binding");
        for (int i = 0; i < std::max(one.arraySize, 1) && i < 256; ++i)
        {
            const auto index = static_cast<std::size_t>(i);
            double unit = bound >= 0 ? bound + i : 0.0;
            if (known && index < known->values.size())
            {
                unit = known->values[index];
            }
            one.units.push_back(unit >= 0.0 && unit < 256.0 ? static_cast<unsigned int>(unit) : 0);
        }
    }

    struct Assigned
    {
        unsigned int unit;
        std::string type;
    };

    void units()
    {
        std::set<unsigned int> taken(_options.occupiedUnits.begin(), _options.occupiedUnits.end());
        std::map<unsigned int, std::string> modelUnits;
        for (const MergedUniform& uniform : _merged.uniforms)
        {
            for (unsigned int unit : uniform.units)
            {
                if (!renderingOf(uniform).findTexture(unit))
                {
                    taken.insert(unit);
                }
            }
        }
        std::map<std::string, unsigned int> ownTextures;
        for (MergedUniform& uniform : _merged.uniforms)
        {
            for (unsigned int& unit : uniform.units)
            {
                const unsigned int own = unit;
                const RenderingTexture* texture = renderingOf(uniform).findTexture(own);
                if (texture)
                {
                    unit = place(uniform.type + keyOf(uniform, *texture), ownTextures, taken);
                }
                else if (modelUnits.emplace(own, uniform.type).first->second != uniform.type)
                {
                    unit = place(uniform.type + "model" + std::to_string(own), ownTextures, taken);
                    _merged.messages.push_back(
                        {MergeSeverity::Warning, uniform.rendering,
                         renderingOf(uniform).name + ": texture unit " + std::to_string(own) +
                             " is a " + modelUnits[own] + " for another rendering; '" +
                             uniform.name + "' has unit " + std::to_string(unit)});
                }
                const bool known =
                    std::any_of(_merged.textures.begin(), _merged.textures.end(),
                                [&](const MergedTexture& other) { return other.unit == unit; });
                if (!known)
                {
                    _merged.textures.push_back({unit, uniform.rendering, own, texture != nullptr});
                }
            }
        }
        for (const MergedTexture& texture : _merged.textures)
        {
            _merged.statistics.textureUnits =
                std::max(_merged.statistics.textureUnits, static_cast<int>(texture.unit) + 1);
        }
    }

    const Rendering& renderingOf(const MergedUniform& uniform) const
    {
        const auto found = std::find_if(_programs.begin(), _programs.end(),
                                        [&](const MergeProgram* program)
                                        { return program->id == uniform.rendering; });
        return *(*found)->rendering;
    }

    static unsigned int place(const std::string& key, std::map<std::string, unsigned int>& known,
                              std::set<unsigned int>& taken)
    {
        const auto found = known.find(key);
        if (found != known.end())
        {
            return found->second;
        }
        unsigned int unit = 0;
        while (taken.count(unit))
        {
            ++unit;
        }
        taken.insert(unit);
        known[key] = unit;
        return unit;
    }

    /// Textures of equal content, filters and wraps are one.
    std::string keyOf(const MergedUniform& uniform, const RenderingTexture& texture) const
    {
        std::string key = " " + texture.fileName;
        if (texture.fileName.empty())
        {
            key += "|" + std::to_string(uniform.rendering) + ":" + std::to_string(texture.unit);
        }
        for (const std::string& face : texture.faces)
        {
            key += "|" + face;
        }
        for (unsigned int value : {texture.target, texture.minFilter, texture.magFilter,
                                   texture.wrap[0], texture.wrap[1], texture.wrap[2]})
        {
            key += "," + std::to_string(value);
        }
        return key;
    }

    const std::vector<MergeProgram*>& _programs;
    MergeNames& _names;
    const MergeOptions& _options;
    Merged& _merged;
    std::set<int> _bindings[2];                   ///< Of uniform and of storage blocks.
    std::map<std::string, std::string> _osgTypes; ///< Types of the uniforms that OSG sets.
};

} // namespace

void planResources(const std::vector<MergeProgram*>& programs, MergeNames& names,
                   const MergeOptions& options, Merged& merged)
{
    Resources(programs, names, options, merged).run();
}

} // namespace osgMultiRender
