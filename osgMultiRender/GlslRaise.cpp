// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslRaise.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace osgMultiRender
{

namespace
{

bool isInterface(const GlslSpecifiers& specifiers)
{
    static constexpr std::string_view storage[] = {"uniform", "attribute", "varying",
                                                   "in",      "out",       "buffer"};
    return std::any_of(std::begin(storage), std::end(storage),
                       [&](std::string_view word) { return specifiers.has(word); });
}

/// Collects from one source what raising it to `target` must rename, or can't.
class Survey
{
public:
    Survey(const GlslSource& source, GlslStage stage, std::size_t shader, int target,
           GlslRaise& result)
        : _source(source), _stage(stage), _shader(shader), _target(target), _result(result)
    {
    }

    void run()
    {
        findAddressedMembers();
        for (std::size_t i = 0; i < _source.declarations.size(); ++i)
        {
            const GlslDeclaration& one = _source.declarations[i];
            checkWord(one.name, one.nameToken, addressed(i));
        }
        for (const GlslStruct& type : _source.structs)
        {
            checkWord(type.name, type.nameToken, false);
        }
        for (const GlslBlock& block : _source.blocks)
        {
            checkWord(block.name, block.nameToken, true);
        }
        for (const GlslFunction& function : _source.functions)
        {
            checkWord(function.name, function.nameToken, false);
        }
        checkExtensions();
    }

private:
    bool becomes(int since) const { return since > _source.version.number && since <= _target; }

    void checkWord(const std::string& name, std::size_t token, bool isAddressed)
    {
        const int since = reservedSince(name);
        if (!becomes(since) || _source.findMacro(name, token))
        {
            return;
        }
        if (isAddressed)
        {
            say(token, "'" + name + "' is a keyword from GLSL " + std::to_string(since) +
                           " on and must keep its name: the version can't be raised");
            return;
        }
        _result.words[name] = "osgmr_user_" + name;
    }

    void checkExtensions()
    {
        for (const GlslDirective& directive : _source.directives)
        {
            if (directive.name != "extension" || directive.parts.empty() || !directive.active)
            {
                continue;
            }
            const std::string name(textOf(_source.text, directive.parts[0]));
            if (name == "GL_EXT_geometry_shader4" || name == "GL_ARB_geometry_shader4")
            {
                say(directive.token,
                    name + " is not geometry shaders of GLSL 150: the version can't be raised");
            }
        }
    }

    void say(std::size_t token, const std::string& message)
    {
        const GlslToken& at = _source.tokens[token];
        _result.errors.push_back({_shader, {at.line, at.column, message}});
    }

    /// Whether the application, or another stage, knows a declaration by its name.
    bool addressed(std::size_t index) const
    {
        const GlslDeclaration& one = _source.declarations[index];
        switch (one.kind)
        {
        case GlslDeclaration::Kind::Global:
        {
            // Fragment outputs become plain globals of any name.
            const GlslSpecifiers& specifiers = _source.specifiersOf(one);
            const bool output = _stage == GlslStage::Fragment && specifiers.has("out");
            return isInterface(specifiers) && !output;
        }
        case GlslDeclaration::Kind::BlockMember:
            return true;
        case GlslDeclaration::Kind::Member:
            return _addressedMembers.count(index) != 0;
        default:
            return false;
        }
    }

    /// Members of blocks, and of structs that are part of an interface.
    void findAddressedMembers()
    {
        std::vector<std::string> pending;
        for (const GlslDeclaration& one : _source.declarations)
        {
            if (one.kind == GlslDeclaration::Kind::Global && isInterface(_source.specifiersOf(one)))
            {
                pending.push_back(_source.specifiersOf(one).type);
            }
        }
        for (const GlslBlock& block : _source.blocks)
        {
            addMembers(block.members, pending);
        }
        std::map<std::string, std::vector<const GlslStruct*>> structs;
        for (const GlslStruct& type : _source.structs)
        {
            structs[type.name].push_back(&type);
        }
        std::set<std::string> seen;
        while (!pending.empty())
        {
            const std::string type = pending.back();
            pending.pop_back();
            if (seen.insert(type).second)
            {
                for (const GlslStruct* found : structs[type])
                {
                    addMembers(found->members, pending);
                }
            }
        }
    }

    void addMembers(const std::vector<std::size_t>& members, std::vector<std::string>& pending)
    {
        for (std::size_t member : members)
        {
            _addressedMembers.insert(member);
            pending.push_back(_source.specifiersOf(_source.declarations[member]).type);
        }
    }

    const GlslSource& _source;
    GlslStage _stage;
    std::size_t _shader;
    int _target;
    GlslRaise& _result;
    std::set<std::size_t> _addressedMembers;
};

} // namespace

bool mustRaise(const GlslSource& source, const GlslVersion& target)
{
    return source.version.number < target.number;
}

GlslVersion raisedVersion(const GlslSource& source, const GlslVersion& target)
{
    if (!mustRaise(source, target))
    {
        return source.version;
    }
    GlslVersion raised = target;
    const bool unnamed = source.version.profile == GlslVersion::Profile::None;
    if (source.version.profile == GlslVersion::Profile::Core ||
        (unnamed && source.version.number >= 150))
    {
        raised.profile = GlslVersion::Profile::Core;
    }
    return raised;
}

GlslRaise planRaise(const std::vector<GlslShader>& shaders, const std::vector<GlslSource>& sources,
                    const GlslVersion& target)
{
    GlslRaise result;
    // Functions join shader objects of one stage by name: what one of them renames, all do.
    std::map<GlslStage, GlslEdit::Names> functions;
    for (std::size_t i = 0; i < sources.size(); ++i)
    {
        if (!mustRaise(sources[i], target))
        {
            continue;
        }
        Survey(sources[i], shaders[i].stage, i, target.number, result).run();
        for (const GlslFunction& function : sources[i].functions)
        {
            const int since = builtinFunctionSince(function.name);
            if (since > sources[i].version.number && since <= target.number)
            {
                functions[shaders[i].stage][function.name] = "osgmr_user_" + function.name;
            }
        }
    }
    for (std::size_t i = 0; i < sources.size(); ++i)
    {
        GlslEdit::Names names;
        for (const GlslFunction& function : sources[i].functions)
        {
            const GlslEdit::Names& stage = functions[shaders[i].stage];
            const auto found = stage.find(function.name);
            if (found != stage.end())
            {
                names.insert(*found);
            }
        }
        result.functions.push_back(std::move(names));
    }
    return result;
}

void raiseDirectives(const GlslSource& source, const GlslVersion& target, GlslEdit& edit)
{
    const std::string line = "#version " + toString(raisedVersion(source, target)) + "\n";
    bool found = false;
    for (const GlslDirective& directive : source.directives)
    {
        const GlslToken& token = source.tokens[directive.token];
        if (directive.name == "version" && !found)
        {
            // OSG takes the line out only where it begins with "#version".
            edit.replace(token.begin, token.end, line);
            found = true;
        }
        else if (directive.name == "line" && source.version.number < 330 &&
                 !directive.parts.empty())
        {
            const GlslToken& part = directive.parts[0];
            const std::string_view word = textOf(source.text, part);
            int number = 0;
            const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
            if (parsed.ec == std::errc() && number < 1000000000)
            {
                edit.replace(part.begin, part.end, std::to_string(number + 1));
            }
        }
    }
    if (!found)
    {
        edit.insertBefore(0, line);
    }
}

} // namespace osgMultiRender
