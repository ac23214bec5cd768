// SPDX-License-Identifier: MIT
#include <osgMultiRender/Merger.h>

#include <osgMultiRender/MergeProgram.h>

#include <algorithm>
#include <chrono>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;
using Programs = std::vector<MergeProgram*>;

/// What is taken of one limit.
struct Taken
{
    int value, limit;
    const char* what;

    bool isPassed() const { return value > limit; }
    /// "17 fragment samplers of 16".
    std::string toString() const
    {
        return std::to_string(value) + " " + what + " of " + std::to_string(limit);
    }
};

std::vector<Taken> takenOf(const MergeStatistics& s, const MergeLimits& limits)
{
    return {
        {s.varyingVectors, limits.varyingVectors, "varying vectors"},
        {s.fragmentSamplers, limits.fragmentSamplers, "fragment samplers"},
        {s.vertexSamplers, limits.vertexSamplers, "vertex samplers"},
        {s.textureUnits, limits.textureUnits, "texture units"},
        {s.vertexUniformComponents, limits.vertexUniformComponents, "vertex uniform components"},
        {s.fragmentUniformComponents, limits.fragmentUniformComponents,
         "fragment uniform components"},
        {s.vertexAttributes, limits.vertexAttributes, "vertex attributes"},
    };
}

class Merge
{
public:
    Merge(const std::vector<MergeEntry>& entries, const MergeOptions& options)
        : _entries(entries), _options(options)
    {
    }

    Merged run()
    {
        const auto start = std::chrono::steady_clock::now();
        if (checkOptions())
        {
            read();
            plan();
            write();
        }
        collect();
        const std::chrono::duration<double, std::milli> passed =
            std::chrono::steady_clock::now() - start;
        _merged.statistics.milliseconds = passed.count();
        return std::move(_merged);
    }

private:
    bool checkOptions()
    {
        const GlslVersion& version = _options.version;
        if (version.number < 330 || version.profile == GlslVersion::Profile::Es)
        {
            _merged.messages.push_back({MergeSeverity::Error, _entries.size(),
                                        "GLSL 330 or later is needed, not " + toString(version)});
            return false;
        }
        return true;
    }

    void read()
    {
        _merged.version.number = _options.version.number;
        _merged.version.profile = GlslVersion::Profile::Compatibility;
        _all.reserve(_entries.size());
        for (std::size_t i = 0; i < _entries.size(); ++i)
        {
            static const Rendering none;
            const Rendering& rendering = _entries[i].rendering ? *_entries[i].rendering : none;
            _all.push_back(readMergeProgram(rendering, i, _merged.files));
            MergeProgram& program = _all.back();
            if (program.version > _options.limits.version)
            {
                program.fail(rendering.name + ": it is of GLSL " + std::to_string(program.version) +
                             ", beyond the limit of " + std::to_string(_options.limits.version));
            }
            if (!program.failed)
            {
                _merged.version.number = std::max(_merged.version.number, program.version);
            }
            takeNames(program);
        }
        _names.take(parseGlsl(_options.weights));
        for (MergeProgram& program : _all)
        {
            nameMergeProgram(program, _names, _merged.version.number, _options.ownLighting);
            if (!program.failed)
            {
                connectStages(program, _merged.files, _options.clampVertexColors);
            }
            if (!program.failed)
            {
                valueVaryings(program);
            }
        }
    }

    void takeNames(const MergeProgram& program)
    {
        for (const MergeStage* stage : {&program.vertex, &program.fragment})
        {
            for (const MergeShader& shader : stage->shaders)
            {
                _names.take(shader.source);
            }
        }
    }

    /// The programs that are still in, and what they take.
    Programs included()
    {
        Programs programs;
        for (MergeProgram& program : _all)
        {
            if (!program.failed)
            {
                programs.push_back(&program);
            }
        }
        return programs;
    }

    void measure(const Programs& programs)
    {
        _merged.messages.clear();
        _vectors = packVaryings(programs, _options.share, _merged.statistics);
        planResources(programs, _names, _options, _merged);
    }

    void plan()
    {
        for (;;)
        {
            Programs programs = included();
            if (programs.empty())
            {
                return;
            }
            measure(programs);
            if (included().size() != programs.size())
            {
                continue;
            }
            const std::vector<Taken> all = takenOf(_merged.statistics, _options.limits);
            const auto passed = std::find_if(all.begin(), all.end(),
                                             [](const Taken& one) { return one.isPassed(); });
            if (passed == all.end())
            {
                return;
            }
            leaveOut(programs, static_cast<std::size_t>(passed - all.begin()));
        }
    }

    /// What these programs take of one limit.
    Taken measure(const Programs& programs, std::size_t limit)
    {
        measure(programs);
        return takenOf(_merged.statistics, _options.limits)[limit];
    }

    /// Finds where the limit is passed and leaves the least important program out.
    void leaveOut(const Programs& programs, std::size_t limit)
    {
        const auto takenBy = [&](std::size_t count)
        {
            const auto end = programs.begin() + static_cast<std::ptrdiff_t>(count);
            return measure({programs.begin(), end}, limit);
        };
        // With each rendering more is taken: the first count that passes, by halves.
        std::size_t fits = 0, passes = programs.size();
        while (passes - fits > 1)
        {
            const std::size_t middle = fits + (passes - fits) / 2;
            (takenBy(middle).isPassed() ? passes : fits) = middle;
        }
        const std::string passed = takenBy(passes).toString();
        const MergeProgram* by = programs[passes - 1];
        MergeProgram* least = leastThatHelps(programs, limit);
        least->fail(least->rendering->name + ": left out: with '" + by->rendering->name +
                    "' the program has " + passed);
    }

    /// The least important one without which less is taken; where all is shared, of all.
    MergeProgram* leastThatHelps(const Programs& programs, std::size_t limit)
    {
        Programs order = programs;
        // Of equal ones the last, but the base as long as another one is there.
        std::reverse(order.begin(), order.end());
        std::stable_sort(order.begin(), order.end(),
                         [&](const MergeProgram* a, const MergeProgram* b)
                         {
                             const bool baseA = a->id == _options.base;
                             const bool baseB = b->id == _options.base;
                             return baseA != baseB
                                        ? baseB
                                        : _entries[a->id].importance < _entries[b->id].importance;
                         });
        const int all = measure(programs, limit).value;
        for (MergeProgram* candidate : order)
        {
            Programs others = programs;
            others.erase(std::find(others.begin(), others.end(), candidate));
            if (measure(others, limit).value < all)
            {
                return candidate;
            }
        }
        return order.front();
    }

    void write()
    {
        const Programs programs = included();
        _merged.ok = !programs.empty();
        if (!_merged.ok)
        {
            return;
        }
        comparePositions(programs);
        shareEntities(programs, _options.share, _merged.statistics);
        writeMerged(programs, _vectors, _options, _merged);
    }

    void comparePositions(const Programs& programs)
    {
        const MergeProgram* base = programs.front();
        for (const MergeProgram* program : programs)
        {
            base = program->id == _options.base ? program : base;
        }
        for (MergeProgram* program : programs)
        {
            program->moves = program != base &&
                             (program->position.empty() || program->position != base->position);
            if (program->moves)
            {
                program->messages.push_back(
                    {MergeSeverity::Warning, program->id,
                     program->rendering->name + ": it may move vertices otherwise than '" +
                         base->rendering->name + "', whose positions are shown"});
            }
        }
    }

    void collect()
    {
        for (const MergeProgram& program : _all)
        {
            _merged.messages.insert(_merged.messages.end(), program.messages.begin(),
                                    program.messages.end());
            MergedRendering one;
            one.name = program.name;
            one.included = !program.failed && _merged.ok;
            one.discards = program.discards;
            one.writesDepth = !program.depth.empty();
            one.usesDerivatives = program.derivatives;
            one.movesVertices = program.moves;
            lists(program, one);
            _merged.renderings.push_back(std::move(one));
        }
        _merged.renderings.resize(_entries.size());
        _merged.files.push_back({_entries.size(), "merged program"});
        _merged.files.push_back({_entries.size(), "weights"});
    }

    void lists(const MergeProgram& program, MergedRendering& result) const
    {
        std::set<std::string> seen;
        std::set<unsigned int> units;
        for (const MergeStage* stage : {&program.vertex, &program.fragment})
        {
            for (const auto& [name, entity] : stage->entities)
            {
                listOne(*stage, name, entity, seen, result);
            }
        }
        for (const RenderingTexture& texture : program.rendering->textures)
        {
            units.insert(texture.unit);
        }
        for (const MergedTexture& texture : _merged.textures)
        {
            if (texture.rendering == program.id)
            {
                units.insert(texture.ownUnit);
            }
        }
        result.textureUnits.assign(units.begin(), units.end());
    }

    static void listOne(const MergeStage& stage, const std::string& name, const MergeEntity& entity,
                        std::set<std::string>& seen, MergedRendering& result)
    {
        const MergeEntity::Place& place = entity.places.front();
        const GlslSource& source = stage.shaders[place.shader].source;
        if (entity.kind == Kind::Function)
        {
            if (seen.insert(name + "()").second)
            {
                result.functions.push_back(name);
            }
            return;
        }
        if (entity.kind == Kind::Struct || entity.kind == Kind::Block)
        {
            return;
        }
        const GlslDeclaration& one = source.declarations[place.index];
        const GlslSpecifiers& specifiers = source.specifiersOf(one);
        std::string text;
        for (const GlslQualifier& qualifier : specifiers.qualifiers)
        {
            text += qualifier.word == "layout" ? "" : qualifier.word + " ";
        }
        text += specifiers.type + source.spell(specifiers.typeArray) + " " + name +
                source.spell(one.array);
        if (!seen.insert(text).second)
        {
            return;
        }
        const bool plain = entity.kind == Kind::Variable || entity.kind == Kind::Constant;
        (plain ? result.globals : result.qualified).push_back(text);
    }

    const std::vector<MergeEntry>& _entries;
    const MergeOptions& _options;
    Merged _merged;
    MergeNames _names;
    std::vector<MergeProgram> _all;
    std::vector<MergeVector> _vectors;
};

/// In place of the uniform, wherever it is declared as MixLights.h says.
void writeLights(std::string& source, int lights)
{
    const std::string kind = "uniform", declaration = " int osg_EnabledLights";
    const std::size_t at = source.find(kind + declaration + ";");
    if (at != std::string::npos)
        source.replace(at, kind.size() + declaration.size(),
                       "const" + declaration + " = " + std::to_string(lights));
}

} // namespace

const MergedUniform* Merged::findUniform(std::size_t rendering, const std::string& name) const
{
    const auto found = std::find_if(uniforms.begin(), uniforms.end(),
                                    [&](const MergedUniform& one)
                                    { return one.rendering == rendering && one.name == name; });
    return found == uniforms.end() ? nullptr : &*found;
}

std::string Merged::nameOf(std::size_t rendering, const std::string& name) const
{
    if (const MergedUniform* member = findUniform(rendering, name))
    {
        return member->merged;
    }
    const std::size_t end = std::min(name.find_first_of(".["), name.size());
    const MergedUniform* uniform = findUniform(rendering, name.substr(0, end));
    return uniform ? uniform->merged + name.substr(end) : "";
}

Merged mergeRenderings(const std::vector<MergeEntry>& entries, const MergeOptions& options)
{
    Merged merged = Merge(entries, options).run();
    if (options.lights != MergeOptions::AnyLights)
        for (std::string* source : {&merged.vertex, &merged.fragment})
            writeLights(*source, options.lights);
    return merged;
}

} // namespace osgMultiRender
