// SPDX-License-Identifier: MIT
// Attributes and texture units of a merged program.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>
#include <osgMultiRender/MergeUniforms.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

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
        _merged.textures.clear();
        MergeStatistics& s = _merged.statistics;
        s.textureUnits = 0;
        attributes();
        planUniforms(_programs, _merged);
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
};

} // namespace

void planResources(const std::vector<MergeProgram*>& programs, MergeNames& names,
                   const MergeOptions& options, Merged& merged)
{
    Resources(programs, names, options, merged).run();
}

} // namespace osgMultiRender
