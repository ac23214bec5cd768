// SPDX-License-Identifier: MIT
// Equal functions, constants and structs of several renderings are declared once.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>
#include <unordered_map>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

// Functions that call each other deeper than this are not compared.
constexpr int MaximumDepth = 100;

/// What an equal declaration of an earlier rendering is called.
using Classes = std::unordered_map<std::string, std::pair<std::size_t, std::string>>;

/// Finds what the entities of one stage of one rendering mean, apart from their rendering.
class Comparer
{
public:
    Comparer(MergeProgram& program, MergeStage& stage, Classes& classes, bool all,
             MergeStatistics& statistics)
        : _program(program), _stage(stage), _classes(classes), _all(all), _statistics(statistics)
    {
        findInterfaceTypes();
    }

    void run()
    {
        for (auto& [name, entity] : _stage.entities)
        {
            if (_all || entity.kind == Kind::Uniform)
            {
                classOf(name, entity, 0);
            }
        }
    }

private:
    /// The class of an entity: equal for equal ones; empty if it is the rendering's own.
    std::string classOf(const std::string& name, MergeEntity& entity, int depth)
    {
        const auto [found, added] = _known.try_emplace(name);
        if (!added || depth > MaximumDepth)
        {
            return found->second;
        }
        std::string key = keyOf(name, entity, depth);
        if (key.empty() || entity.kind == Kind::Attribute)
        {
            return _known[name] = key;
        }
        const auto [known, first] =
            _classes.emplace(key, std::make_pair(_classes.size(), entity.merged));
        if (!first)
        {
            entity.inPlace = false;
            entity.merged = known->second.second;
            count(entity.kind);
        }
        return _known[name] = "@" + std::to_string(known->second.first);
    }

    void count(Kind kind)
    {
        _statistics.sharedFunctions += kind == Kind::Function ? 1 : 0;
        _statistics.sharedConstants += kind == Kind::Constant ? 1 : 0;
        _statistics.sharedStructs += kind == Kind::Struct ? 1 : 0;
    }

    std::string keyOf(const std::string& name, const MergeEntity& entity, int depth)
    {
        switch (entity.kind)
        {
        case Kind::Function:
            return functionKey(name, entity, depth);
        case Kind::Struct:
            return structKey(name, entity, depth);
        case Kind::Constant:
            return constantKey(name, entity, depth);
        case Kind::Attribute:
            return "attribute " + entity.merged;
        case Kind::Uniform:
            return entity.merged == name && name.compare(0, 4, "osg_") == 0
                       ? "uniform " + spelled(entity, depth)
                       : "";
        default:
            return "";
        }
    }

    std::string spelled(const MergeEntity& entity, int depth)
    {
        const auto& place = entity.places.front();
        const GlslSource& source = _stage.shaders[place.shader].source;
        const GlslDeclaration& one = source.declarations[place.index];
        std::string key = source.specifiersOf(one).type + " " + one.name + " ";
        return add(source, one.array, depth, key) ? key : "";
    }

    std::string functionKey(const std::string& name, const MergeEntity& entity, int depth)
    {
        // Calls of overloaded built-in functions are told apart by their arguments.
        if (name == "main" || builtinFunctionSince(name))
        {
            return "";
        }
        std::vector<std::string> keys;
        for (const auto& place : entity.places)
        {
            const GlslSource& source = _stage.shaders[place.shader].source;
            const GlslFunction& function = source.functions[place.index];
            if (function.body.empty())
            {
                continue;
            }
            std::string key;
            const std::size_t first = source.specifiers[function.specifiers].statement.first;
            if (!add(source, {first, function.body.last}, depth, key))
            {
                return "";
            }
            keys.push_back(std::move(key));
        }
        std::sort(keys.begin(), keys.end());
        std::string all = keys.empty() ? "" : "function";
        for (const std::string& key : keys)
        {
            all += " " + key;
        }
        return all;
    }

    std::string structKey(const std::string& name, const MergeEntity& entity, int depth)
    {
        if (entity.localStruct || entity.places.size() != 1 || _interfaceTypes.count(name))
        {
            return "";
        }
        const auto& place = entity.places.front();
        const GlslSource& source = _stage.shaders[place.shader].source;
        const GlslStruct& one = source.structs[place.index];
        for (std::size_t i = 0; i < source.specifiers.size(); ++i)
        {
            const GlslSpecifiers& specifiers = source.specifiers[i];
            if (specifiers.typeToken != one.nameToken)
            {
                continue;
            }
            const bool declares = std::any_of(
                source.declarations.begin(), source.declarations.end(),
                [&](const GlslDeclaration& declared) { return declared.specifiers == i; });
            std::string key = "struct";
            return !declares && add(source, specifiers.statement, depth, key) ? key : "";
        }
        return "";
    }

    std::string constantKey(const std::string& name, const MergeEntity& entity, int depth)
    {
        if (entity.places.size() != 1 || entity.tainted)
        {
            return "";
        }
        const auto& place = entity.places.front();
        const GlslSource& source = _stage.shaders[place.shader].source;
        const GlslDeclaration& one = source.declarations[place.index];
        const GlslSpecifiers& specifiers = source.specifiersOf(one);
        std::string key = "const ";
        const bool known =
            add(source, {specifiers.typeToken, specifiers.typeToken + 1}, depth, key) &&
            add(source, specifiers.typeArray, depth, key) && add(source, one.array, depth, key) &&
            add(source, one.initializer, depth, key);
        return known ? key + "= " + name : "";
    }

    /// Adds the words of a range. False if they mean something of the rendering's own.
    bool add(const GlslSource& source, const GlslRange& range, int depth, std::string& key)
    {
        using Use = GlslUse::Kind;
        for (std::size_t i = range.first; i < range.last; ++i)
        {
            const GlslToken& token = source.tokens[i];
            if (token.blank() || token.kind == GlslToken::Kind::Directive)
            {
                continue;
            }
            const std::string word(source.word(i));
            const Use use = source.uses[i].kind;
            const bool global = use == Use::Global || use == Use::BlockMember ||
                                use == Use::Function || use == Use::Type || use == Use::BlockName;
            const auto entity = global ? _stage.entities.find(word) : _stage.entities.end();
            if (word == "discard" || use == Use::Undeclared ||
                (use == Use::Builtin && _stage.builtins.count(word)))
            {
                return false;
            }
            if (entity == _stage.entities.end())
            {
                key += word;
            }
            else if (declares(source, i, entity->second))
            {
                key += "! " + word;
            }
            else
            {
                const std::string other = classOf(word, entity->second, depth + 1);
                if (other.empty())
                {
                    return false;
                }
                key += other;
            }
            key += ' ';
        }
        return true;
    }

    /// True where the name of an entity itself stands.
    static bool declares(const GlslSource& source, std::size_t token, const MergeEntity& entity)
    {
        return std::any_of(entity.places.begin(), entity.places.end(),
                           [&](const MergeEntity::Place& place)
                           {
                               if (entity.kind == Kind::Function)
                               {
                                   return place.index < source.functions.size() &&
                                          source.functions[place.index].nameToken == token;
                               }
                               return entity.kind == Kind::Struct &&
                                      place.index < source.structs.size() &&
                                      source.structs[place.index].nameToken == token;
                           });
    }

    /// Structs of uniforms and varyings must be the same in both stages: they are not shared.
    void findInterfaceTypes()
    {
        for (const MergeStage* stage : {&_program.vertex, &_program.fragment})
        {
            for (const MergeShader& shader : stage->shaders)
            {
                addInterfaceTypes(shader.source);
            }
        }
    }

    void addInterfaceTypes(const GlslSource& source)
    {
        std::vector<std::string> pending;
        for (const GlslDeclaration& one : source.declarations)
        {
            const GlslSpecifiers& specifiers = source.specifiersOf(one);
            const bool plain =
                specifiers.qualifiers.empty() ||
                (specifiers.qualifiers.size() == 1 && specifiers.qualifiers[0].word == "const");
            if ((one.kind == GlslDeclaration::Kind::Global && !plain) ||
                one.kind == GlslDeclaration::Kind::BlockMember)
            {
                pending.push_back(specifiers.type);
            }
        }
        for (const GlslBlock& block : source.blocks)
        {
            for (std::size_t member : block.members)
            {
                pending.push_back(source.specifiersOf(source.declarations[member]).type);
            }
        }
        while (!pending.empty())
        {
            const std::string type = pending.back();
            pending.pop_back();
            if (isBuiltinType(type) || !_interfaceTypes.insert(type).second)
            {
                continue;
            }
            for (const GlslStruct& one : source.structs)
            {
                for (std::size_t i = 0; one.name == type && i < one.members.size(); ++i)
                {
                    pending.push_back(
                        source.specifiersOf(source.declarations[one.members[i]]).type);
                }
            }
        }
    }

    MergeProgram& _program;
    MergeStage& _stage;
    Classes& _classes;
    bool _all;
    MergeStatistics& _statistics;
    std::map<std::string, std::string> _known;
    std::set<std::string> _interfaceTypes;
};

} // namespace

void shareEntities(const std::vector<MergeProgram*>& programs, bool all,
                   MergeStatistics& statistics)
{
    Classes vertex, fragment;
    for (MergeProgram* program : programs)
    {
        Comparer(*program, program->vertex, vertex, all, statistics).run();
        Comparer(*program, program->fragment, fragment, all, statistics).run();
    }
}

} // namespace osgMultiRender
