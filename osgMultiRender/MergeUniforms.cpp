// SPDX-License-Identifier: MIT
#include <osgMultiRender/MergeUniforms.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

constexpr int MostElements = 256;         ///< Of an array whose members or samplers are listed.
constexpr std::size_t MostMembers = 4096; ///< Of a uniform.
constexpr int DeepestStruct = 8;

bool isSampler(std::string_view type)
{
    return type.substr(0, 7) == "sampler" || (type.size() > 8 && type.substr(1, 7) == "sampler");
}

bool isBlock(const MergedUniform& uniform)
{
    return uniform.type == "block";
}

/// The uniforms of one stage of one program.
class StageUniforms
{
public:
    StageUniforms(MergeProgram& program, MergeStage& stage)
        : _program(program), _stage(stage), _isFragment(&stage == &program.fragment)
    {
    }

    /// A uniform or block; none for what the application does not set by name.
    std::vector<MergedUniform> read(const std::string& name, const MergeEntity& entity)
    {
        const MergeEntity::Place& place = entity.places.front();
        _source = &_stage.shaders[place.shader].source;
        _isUsed = _stage.usedGlobals.count(name) != 0;
        _components = 0;
        MergedUniform one;
        one.rendering = _program.id;
        one.name = name;
        one.merged = entity.merged;
        _isFragment ? one.fragment = true : one.vertex = true;
        return entity.kind == Kind::Block ? readBlock(one, place.index)
                                          : readUniform(one, place.index);
    }

    /// What that takes.
    int getComponents() const { return _components; }

private:
    std::vector<MergedUniform> readBlock(MergedUniform& one, std::size_t index)
    {
        const GlslSpecifiers& specifiers = _source->specifiers[_source->blocks[index].specifiers];
        if (!specifiers.has("uniform") && !specifiers.has("buffer"))
        {
            return {};
        }
        one.type = "block";
        one.ownBinding = layoutValue(*_source, specifiers, "binding");
        one.binding = specifiers.has("buffer") ? 1 : 0; // the kind, for now
        return {one};
    }

    std::vector<MergedUniform> readUniform(MergedUniform& one, std::size_t index)
    {
        const GlslDeclaration& declared = _source->declarations[index];
        const bool instance = std::any_of(_source->blocks.begin(), _source->blocks.end(),
                                          [&](const GlslBlock& block)
                                          { return block.specifiers == declared.specifiers; });
        one.inBlock = declared.kind == GlslDeclaration::Kind::BlockMember;
        if (instance || (one.inBlock && one.merged.empty()))
        {
            return {};
        }
        one.type = _source->specifiersOf(declared).type;
        const std::vector<int> sizes = sizesOf(declared);
        one.arraySize = sizes.empty() ? 0 : countOf(sizes);
        _components =
            _isUsed && !one.inBlock
                ? static_cast<int>(std::min(1LL * countOf(sizes) * sizeOf(one.type, 0), 1000000LL))
                : 0;
        addUnits(one, declared);
        std::vector<MergedUniform> all = {one};
        if (const GlslStruct* type = one.inBlock ? nullptr : findStruct(one.type))
        {
            addMembers(one, *type, sizes, 0, all);
        }
        return all;
    }

    const GlslStruct* findStruct(const std::string& type) const
    {
        const auto found =
            std::find_if(_source->structs.begin(), _source->structs.end(),
                         [&](const GlslStruct& one) { return !type.empty() && one.name == type; });
        return found == _source->structs.end() ? nullptr : &*found;
    }

    /// Outermost first.
    std::vector<int> sizesOf(const GlslDeclaration& declared) const
    {
        std::vector<int> sizes;
        arraySizes(*_source, declared.array, sizes);
        arraySizes(*_source, _source->specifiersOf(declared).typeArray, sizes);
        return sizes;
    }

    static int countOf(const std::vector<int>& sizes)
    {
        long long count = 1;
        for (const int size : sizes)
        {
            count = std::min(count * std::max(size, 1), 1000000LL);
        }
        return static_cast<int>(count);
    }

    int sizeOf(const std::string& type, int depth) const
    {
        if (isSampler(type) || depth > DeepestStruct)
        {
            return 1;
        }
        const int components = componentsOf(type);
        const GlslStruct* made = components ? nullptr : findStruct(type);
        int sum = 0;
        for (std::size_t i = 0; made && i < made->members.size() && sum <= 100000; ++i)
        {
            const GlslDeclaration& field = _source->declarations[made->members[i]];
            const std::vector<int> sizes = sizesOf(field);
            sum += (sizes.size() == 1 ? sizes[0] : 1) *
                   sizeOf(_source->specifiersOf(field).type, depth + 1);
        }
        return components ? components : std::max(sum, 1);
    }

    /// The members of a struct as GL names them: "lights[1].color".
    void addMembers(const MergedUniform& whole, const GlslStruct& type,
                    const std::vector<int>& sizes, int depth, std::vector<MergedUniform>& all)
    {
        for (const std::string& element : elementsOf(sizes))
        {
            for (const std::size_t member : type.members)
            {
                addMember(whole, element, _source->declarations[member], depth, all);
            }
        }
    }

    void addMember(const MergedUniform& whole, const std::string& element,
                   const GlslDeclaration& field, int depth, std::vector<MergedUniform>& all)
    {
        if (depth > DeepestStruct || all.size() > MostMembers)
        {
            return;
        }
        const auto renamed = _stage.reserved.find(field.name);
        const std::vector<int> sizes = sizesOf(field);
        MergedUniform one = whole;
        one.name += element + "." + field.name;
        one.merged +=
            element + "." + (renamed == _stage.reserved.end() ? field.name : renamed->second);
        one.type = _source->specifiersOf(field).type;
        one.arraySize = sizes.empty() ? 0 : countOf(sizes);
        if (const GlslStruct* type = findStruct(one.type))
        {
            addMembers(one, *type, sizes, depth + 1, all);
            return;
        }
        addUnits(one, field);
        all.push_back(std::move(one));
    }

    /// "[0][1]" of each element; one empty text for what is no array.
    static std::vector<std::string> elementsOf(const std::vector<int>& sizes)
    {
        std::vector<std::string> elements = {""};
        for (const int size : sizes)
        {
            std::vector<std::string> next;
            for (const std::string& element : elements)
            {
                for (int i = 0; i < std::min(size, MostElements) && next.size() < MostMembers; ++i)
                {
                    next.push_back(element + "[" + std::to_string(i) + "]");
                }
            }
            elements = std::move(next);
        }
        return elements;
    }

    /// The units that a sampler has in its own rendering.
    void addUnits(MergedUniform& one, const GlslDeclaration& declared)
    {
        if (!isSampler(one.type) || !_isUsed)
        {
            return;
        }
        const RenderingUniform* known = _program.rendering->findUniform(one.name);
        const int bound = layoutValue(*_source, _source->specifiersOf(declared), "binding");
        for (int i = 0; i < std::max(one.arraySize, 1) && i < MostElements; ++i)
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

    MergeProgram& _program;
    const MergeStage& _stage;
    const bool _isFragment;
    const GlslSource* _source = nullptr;
    bool _isUsed = false;
    int _components = 0;
};

class Uniforms
{
public:
    explicit Uniforms(Merged& merged) : _merged(merged) {}

    void add(MergeProgram& program)
    {
        _made.clear();
        for (MergeStage* stage : {&program.vertex, &program.fragment})
        {
            StageUniforms reader(program, *stage);
            for (const auto& [name, entity] : stage->entities)
            {
                if (entity.kind != Kind::Uniform && entity.kind != Kind::Block)
                {
                    continue;
                }
                for (MergedUniform& one : reader.read(name, entity))
                {
                    add(program, one);
                }
                MergeStatistics& s = _merged.statistics;
                int& total = stage == &program.fragment ? s.fragmentUniformComponents
                                                        : s.vertexUniformComponents;
                total =
                    static_cast<int>(std::min(1LL * total + reader.getComponents(), 1000000000LL));
            }
        }
    }

private:
    void add(MergeProgram& program, MergedUniform& one)
    {
        if (isBlock(one))
        {
            one.binding = _made.count(one.name) ? 0 : bindingFor(one.ownBinding, one.binding == 1);
        }
        else if (one.merged == one.name && one.name.compare(0, 4, "osg_") == 0 &&
                 _osgTypes.emplace(one.name, one.type).first->second != one.type)
        {
            program.fail(program.rendering->name + ": the uniform '" + one.name + "' is " +
                         one.type + ", but " + _osgTypes[one.name] + " in another rendering");
        }
        MergeStatistics& s = _merged.statistics;
        (one.fragment ? s.fragmentSamplers : s.vertexSamplers) +=
            static_cast<int>(one.units.size());
        const auto [found, isNew] = _made.emplace(one.name, _merged.uniforms.size());
        if (isNew)
        {
            _merged.uniforms.push_back(one);
            return;
        }
        MergedUniform& kept = _merged.uniforms[found->second];
        if (kept.type != one.type)
        {
            program.fail(program.rendering->name + ": the uniform '" + one.name + "' is " +
                         one.type + ", but " + kept.type + " in the vertex stage");
        }
        kept.units = kept.units.empty() ? one.units : kept.units;
        kept.vertex = kept.vertex || one.vertex;
        kept.fragment = kept.fragment || one.fragment;
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

    Merged& _merged;
    std::map<std::string, std::size_t> _made;     ///< Of one program, by name.
    std::set<int> _bindings[2];                   ///< Of uniform and of storage blocks.
    std::map<std::string, std::string> _osgTypes; ///< Types of the uniforms that OSG sets.
};

} // namespace

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

void planUniforms(const std::vector<MergeProgram*>& programs, Merged& merged)
{
    MergeStatistics& s = merged.statistics;
    merged.uniforms.clear();
    s.vertexSamplers = s.fragmentSamplers = 0;
    s.vertexUniformComponents = s.fragmentUniformComponents = 0;
    Uniforms uniforms(merged);
    for (MergeProgram* program : programs)
    {
        uniforms.add(*program);
    }
}

} // namespace osgMultiRender
