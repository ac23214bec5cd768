// SPDX-License-Identifier: MIT
// What goes from the vertex to the fragment stage of a rendering, and what comes out of it.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslFragment.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

constexpr std::size_t MaximumElements = 1024;
constexpr unsigned int GLFlat = 0x1D00;

/// One declared varying of a stage, taken apart into scalars and vectors.
struct Side
{
    std::vector<MergeVarying> elements; ///< `vertex` holds the expression, whichever stage it is.
    std::string interpolation;
    std::size_t shader = 0, token = 0;
    std::string type;
    int location = -1;
    bool used = false;
};

class Connector
{
public:
    Connector(MergeProgram& program, const std::vector<MergedFile>& files, bool clampColors)
        : _program(program), _files(files), _clampColors(clampColors)
    {
    }

    void run()
    {
        outputs();
        std::map<std::string, Side> vertex = sidesOf(_program.vertex);
        const std::map<std::string, Side> fragment = sidesOf(_program.fragment);
        for (const auto& [key, side] : fragment)
        {
            if (side.used)
            {
                connect(key, side, vertex);
            }
        }
        colors();
        coordinates();
    }

private:
    void outputs()
    {
        GlslWrapped wrapped;
        std::vector<GlslFragment> fragments;
        for (std::size_t i = 0; i < _program.fragment.shaders.size(); ++i)
        {
            fragments.emplace_back(_program.fragment.shaders[i].source, i);
            fragments.back().read(wrapped);
        }
        mergeFragmentBuiltins(fragments, wrapped);
        for (const GlslWrapMessage& error : wrapped.errors)
        {
            const std::size_t file = _program.fragment.shaders[error.shader].file;
            _program.fail(_files[file].name + ":" + std::to_string(error.where.line) + ": " +
                          error.where.message);
        }
        std::string error;
        if (!bindOutputs(wrapped.outputs, _program.rendering->fragmentDataBindings, error))
        {
            _program.fail(_program.rendering->name + ": " + error);
        }
        _program.color = "vec4(0.0)";
        int location = 64;
        for (const GlslOutput& output : wrapped.outputs)
        {
            const bool builtin = output.name.compare(0, 3, "gl_") == 0;
            const std::string name = builtin ? _program.fragment.builtins[output.name]
                                             : _program.fragment.entities[output.name].merged;
            const int size = output.name == "gl_FragData" ? _program.fragment.fragData
                                                          : output.arraySize;
            for (int i = 0; i < std::max(size, 1); ++i)
            {
                const std::string element = size ? name + "[" + std::to_string(i) + "]" : name;
                _program.outputs.push_back(element + " = " + output.type + "(0)");
            }
            if (output.location < location)
            {
                location = output.location;
                const bool known = output.elements.empty() || output.elements.front() == 0;
                color(output.type, size ? name + (known ? "[0]" : "[" + std::to_string(output.elements.front()) + "]") : name);
            }
        }
        if (wrapped.outputs.size() > 1)
        {
            _program.note(_program.rendering->name + ": only its first colour is shown");
        }
    }

    void color(const std::string& type, const std::string& value)
    {
        if (type == "vec4")
        {
            _program.color = value;
        }
        else if (type == "vec3" || type == "vec2" || type == "float")
        {
            _program.color = "vec4(" + value + (type == "vec3"   ? ", 1.0)"
                                                : type == "vec2" ? ", 0.0, 1.0)"
                                                                 : ", 0.0, 0.0, 1.0)");
        }
        else
        {
            _program.fail(_program.rendering->name + ": its colour is of type " + type +
                          ", which can't be blended");
        }
    }

    std::map<std::string, Side> sidesOf(const MergeStage& stage)
    {
        std::map<std::string, Side> sides;
        const std::set<std::string> used = usedGlobals(stage);
        for (const auto& [name, entity] : stage.entities)
        {
            if (entity.kind == Kind::Varying)
            {
                addSide(stage, name, entity, used.count(name) != 0, sides);
            }
        }
        return sides;
    }

    void addSide(const MergeStage& stage, const std::string& name, const MergeEntity& entity,
                 bool used, std::map<std::string, Side>& sides)
    {
        const MergeEntity::Place& place = entity.places.front();
        const GlslSource& source = stage.shaders[place.shader].source;
        const GlslDeclaration& one = source.declarations[place.index];
        for (const GlslBlock& block : source.blocks)
        {
            const bool instance = block.instance == name && block.specifiers == one.specifiers;
            for (std::size_t member : block.members)
            {
                if (!instance && member != place.index)
                {
                    continue;
                }
                const GlslDeclaration& field = source.declarations[member];
                const std::string expression =
                    instance ? entity.merged + "." + field.name : entity.merged;
                Side side = sideOf(stage, place.shader, field, expression, used,
                                   source.specifiers[block.specifiers]);
                sides.emplace(block.name + "." + field.name, std::move(side));
            }
            if (instance)
            {
                return;
            }
        }
        if (one.kind == GlslDeclaration::Kind::Global)
        {
            sides.emplace(name, sideOf(stage, place.shader, one, entity.merged, used,
                                       source.specifiersOf(one)));
        }
    }

    Side sideOf(const MergeStage& stage, std::size_t shader, const GlslDeclaration& one,
                const std::string& expression, bool used, const GlslSpecifiers& outer)
    {
        const GlslSource& source = stage.shaders[shader].source;
        const GlslSpecifiers& specifiers = source.specifiersOf(one);
        Side side;
        side.shader = shader;
        side.token = one.nameToken;
        side.used = used;
        side.type = specifiers.type;
        side.location = layoutValue(source, specifiers, "location");
        for (const char* word : {"centroid", "sample", "flat", "noperspective"})
        {
            if (specifiers.has(word) || outer.has(word))
            {
                side.interpolation += (side.interpolation.empty() ? "" : " ") + std::string(word);
            }
        }
        std::vector<int> sizes;
        const bool known = arraySizes(source, one.array, sizes) &&
                           arraySizes(source, specifiers.typeArray, sizes);
        if (!known || !takeApart(source, specifiers.type, sizes, 0, expression, side))
        {
            _program.fail(_files, stage.shaders[shader], one.nameToken,
                          "the varying '" + one.name + "' is of a type or size that can't be merged");
        }
        return side;
    }

    /// Adds the scalars and vectors that a variable is made of. False for unknown types.
    bool takeApart(const GlslSource& source, const std::string& type, const std::vector<int>& sizes,
                   std::size_t level, const std::string& expression, Side& side)
    {
        if (side.elements.size() > MaximumElements || level > 8)
        {
            return false;
        }
        if (level < sizes.size())
        {
            for (int i = 0; i < sizes[level]; ++i)
            {
                if (!takeApart(source, type, sizes, level + 1,
                               expression + "[" + std::to_string(i) + "]", side))
                {
                    return false;
                }
            }
            return true;
        }
        MergeVarying one;
        one.vertex = expression;
        const char digit = type.empty() ? '0' : type.back();
        const int last = digit >= '2' && digit <= '4' ? digit - '0' : 0;
        if (type == "float" || type == "int" || type == "uint")
        {
            one.base = type[0];
        }
        else if (type.size() == 4 && type.compare(0, 3, "vec") == 0 && last)
        {
            one.components = last;
        }
        else if (type.size() == 5 && (type[0] == 'i' || type[0] == 'u') &&
                 type.compare(1, 3, "vec") == 0 && last)
        {
            one.base = type[0];
            one.components = last;
        }
        else if (type.compare(0, 3, "mat") == 0 && last && (type.size() == 4 || type.size() == 6))
        {
            one.components = last;
            const int columns = type[3] - '0';
            for (int i = 0; i < columns; ++i)
            {
                one.vertex = expression + "[" + std::to_string(i) + "]";
                side.elements.push_back(one);
            }
            return true;
        }
        else
        {
            return takeApartStruct(source, type, level, expression, side);
        }
        side.elements.push_back(one);
        return true;
    }

    bool takeApartStruct(const GlslSource& source, const std::string& type, std::size_t level,
                         const std::string& expression, Side& side)
    {
        if (_structs.size() > 8 || type.empty())
        {
            return false;
        }
        _structs.push_back(type);
        const bool known = takeMembersApart(source, type, level, expression, side);
        _structs.pop_back();
        return known;
    }

    bool takeMembersApart(const GlslSource& source, const std::string& type, std::size_t level,
                          const std::string& expression, Side& side)
    {
        for (const GlslStruct& one : source.structs)
        {
            if (one.name != type)
            {
                continue;
            }
            for (std::size_t member : one.members)
            {
                const GlslDeclaration& field = source.declarations[member];
                const GlslSpecifiers& specifiers = source.specifiersOf(field);
                // The arrays of the outer levels are behind us: pad for the recursion's bound.
                std::vector<int> sizes(level, 1);
                if (!arraySizes(source, field.array, sizes) ||
                    !arraySizes(source, specifiers.typeArray, sizes) ||
                    !takeApart(source, specifiers.type, sizes, level,
                               expression + "." + field.name, side))
                {
                    return false;
                }
            }
            return true;
        }
        return false;
    }

    void connect(const std::string& key, const Side& fragment, std::map<std::string, Side>& vertex)
    {
        auto found = vertex.find(key);
        if (found == vertex.end() && fragment.location >= 0)
        {
            // From GLSL 410 on locations join, whatever the names.
            found = std::find_if(vertex.begin(), vertex.end(), [&](const auto& one)
                                 { return one.second.location == fragment.location; });
        }
        const MergeShader& shader = _program.fragment.shaders[fragment.shader];
        if (found == vertex.end())
        {
            _program.fail(_files, shader, fragment.token,
                          "the vertex stage does not declare the varying '" + key + "'");
            return;
        }
        const Side& from = found->second;
        bool same = from.elements.size() == fragment.elements.size();
        for (std::size_t i = 0; same && i < from.elements.size(); ++i)
        {
            same = from.elements[i].base == fragment.elements[i].base &&
                   from.elements[i].components == fragment.elements[i].components;
        }
        if (!same)
        {
            _program.fail(_files, shader, fragment.token,
                          "the varying '" + key + "' is " + fragment.type + ", but " + from.type +
                              " in the vertex stage");
            return;
        }
        for (std::size_t i = 0; i < from.elements.size(); ++i)
        {
            MergeVarying one = from.elements[i];
            one.fragment = fragment.elements[i].vertex;
            one.interpolation =
                fragment.interpolation.empty() ? from.interpolation : fragment.interpolation;
            if (one.base != 'f' && one.interpolation.find("flat") == std::string::npos)
            {
                one.interpolation = "flat";
            }
            _program.varyings.push_back(std::move(one));
        }
    }

    std::string builtin(const MergeStage& stage, const char* name) const
    {
        const auto found = stage.builtins.find(name);
        return found == stage.builtins.end() ? "" : found->second;
    }

    void add(const std::string& vertex, const std::string& fragment, int components,
             const std::string& interpolation, const std::string& condition = "")
    {
        if (vertex.empty() || fragment.empty())
        {
            return;
        }
        MergeVarying one;
        one.vertex = vertex;
        one.fragment = fragment;
        one.components = components;
        one.interpolation = interpolation;
        one.condition = condition;
        _program.varyings.push_back(std::move(one));
    }

    void colors()
    {
        const RenderingState& state = _program.rendering->state;
        const std::string interpolation = state.shadeModel == GLFlat ? "flat" : "";
        const auto clamped = [&](const std::string& name)
        {
            return name.empty() || !_clampColors ? name : "clamp(" + name + ", 0.0, 1.0)";
        };
        const std::string pairs[][3] = {
            {"gl_Color", "gl_FrontColor", "gl_BackColor"},
            {"gl_SecondaryColor", "gl_FrontSecondaryColor", "gl_BackSecondaryColor"}};
        for (const auto& names : pairs)
        {
            const std::string to = builtin(_program.fragment, names[0].c_str());
            add(clamped(builtin(_program.vertex, names[1].c_str())), to, 4, interpolation);
            if (state.twoSided)
            {
                add(clamped(builtin(_program.vertex, names[2].c_str())), to, 4, interpolation,
                    "!gl_FrontFacing");
            }
        }
        add(builtin(_program.vertex, "gl_FogFragCoord"), builtin(_program.fragment, "gl_FogFragCoord"),
            1, "");
    }

    void coordinates()
    {
        const std::string from = builtin(_program.vertex, "gl_TexCoord");
        const std::string to = builtin(_program.fragment, "gl_TexCoord");
        for (int i : _program.fragment.texCoords)
        {
            if (_program.vertex.texCoords.count(i))
            {
                const std::string index = "[" + std::to_string(i) + "]";
                add(from.empty() ? "" : from + index, to.empty() ? "" : to + index, 4, "");
            }
        }
    }

    MergeProgram& _program;
    const std::vector<MergedFile>& _files;
    bool _clampColors;
    std::vector<std::string> _structs; ///< Those that are being taken apart.
};

} // namespace

std::set<std::string> usedGlobals(const MergeStage& stage)
{
    std::set<std::string> used;
    for (const MergeShader& shader : stage.shaders)
    {
        const GlslSource& source = shader.source;
        for (std::size_t i = 0; i < source.tokens.size(); ++i)
        {
            const GlslUse& use = source.uses[i];
            const bool variable =
                use.kind == GlslUse::Kind::Global || use.kind == GlslUse::Kind::BlockMember;
            if (variable && source.declarations[use.target].nameToken != i)
            {
                used.emplace(source.word(i));
            }
        }
    }
    return used;
}

void connectStages(MergeProgram& program, const std::vector<MergedFile>& files, bool clampColors)
{
    Connector(program, files, clampColors).run();
}

} // namespace osgMultiRender
