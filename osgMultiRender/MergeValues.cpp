// SPDX-License-Identifier: MIT
// What varyings are worth, as far as a straight vertex main() says it.
#include <osgMultiRender/MergeProgram.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

using Kind = MergeEntity::Kind;

constexpr std::size_t LongestValue = 2000;

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// Follows the assignments of main() one after the other. A value is the text of its expression
/// with the values of what it reads in it; equal texts are equal values. What is assigned in a
/// branch, a loop, in parts or by functions has none.
class Follower
{
public:
    Follower(const MergeProgram& program, const GlslSource& source, const GlslFunction& main)
        : _program(program), _source(source)
    {
        for (std::size_t i = main.body.first + 1; i + 1 < main.body.last; ++i)
        {
            if (!source.tokens[i].blank())
            {
                _tokens.push_back(i);
            }
        }
        findGlobalsOfFunctions(main);
    }

    std::map<std::string, std::string> run()
    {
        for (std::size_t token : _tokens)
        {
            if (isOneOf(_source.word(token), {"return", "modf", "frexp", "uaddCarry", "usubBorrow",
                                              "umulExtended", "imulExtended"}))
            {
                return {};
            }
        }
        while (_at < _tokens.size())
        {
            const std::size_t first = _at;
            const bool simple = findEnd();
            if (!simple || !assignment(first, _at))
            {
                forget(first, _at);
            }
        }
        return _values;
    }

private:
    std::string_view word(std::size_t at) const
    {
        return at < _tokens.size() ? _source.word(_tokens[at]) : std::string_view();
    }

    /// What other functions read or write can't be followed.
    void findGlobalsOfFunctions(const GlslFunction& main)
    {
        for (const MergeShader& shader : _program.vertex.shaders)
        {
            const GlslSource& source = shader.source;
            for (const GlslFunction& function : source.functions)
            {
                if (&function == &main)
                {
                    continue;
                }
                for (std::size_t i = function.body.first; i < function.body.last; ++i)
                {
                    const GlslUse::Kind use = source.uses[i].kind;
                    if (use == GlslUse::Kind::Global || use == GlslUse::Kind::BlockMember ||
                        use == GlslUse::Kind::Builtin)
                    {
                        _hidden.emplace(source.word(i));
                    }
                }
            }
        }
    }

    /// Moves behind the statement at the cursor. False if it is no single expression.
    bool findEnd()
    {
        const bool control =
            isOneOf(word(_at), {"if", "else", "for", "while", "do", "switch", "{"});
        int depth = 0;
        for (; _at < _tokens.size(); ++_at)
        {
            const std::string_view text = word(_at);
            depth += isOneOf(text, {"(", "[", "{"}) ? 1 : isOneOf(text, {")", "]", "}"}) ? -1 : 0;
            if (depth == 0 && (text == ";" || text == "}"))
            {
                ++_at;
                break;
            }
        }
        return !control;
    }

    /// "vec3 n = …;", "n = …;", "gl_TexCoord[0] = …;"
    bool assignment(std::size_t first, std::size_t last)
    {
        std::size_t at = first;
        std::string type;
        if (isBuiltinType(word(at)) && word(at + 1) != "(" && word(at + 1) != "[")
        {
            type = word(at++);
        }
        if (at + 1 >= last || _source.uses[_tokens[at]].kind == GlslUse::Kind::None)
        {
            return false;
        }
        const std::string whole = keyOf(at++);
        std::string target = whole;
        if (word(at) == "[" && word(at + 2) == "]" &&
            _source.tokens[_tokens[at + 1]].kind == GlslToken::Kind::Number)
        {
            target += "[" + std::string(word(at + 1)) + "]";
            at += 3;
        }
        if (!type.empty() && word(at) == ";")
        {
            _values.erase(target);
            return true;
        }
        std::string value;
        const bool known = word(at) == "=" && expression(at + 1, last - 1, value);
        if (word(at) != "=" || !plainExpression(at + 1, last - 1))
        {
            return false;
        }
        // An element ends what is known of the whole, and the whole what is known of elements.
        target == whole ? forgetVariable(whole) : void(_values.erase(whole));
        if (known && !whole.empty())
        {
            // An int that becomes a float is not the same as the int.
            _values[target] = type.empty() ? value : type + "{" + value + "}";
        }
        else
        {
            _values.erase(target);
        }
        return true;
    }

    /// No assignments, no second declarator.
    bool plainExpression(std::size_t first, std::size_t last) const
    {
        int depth = 0;
        for (std::size_t i = first; i < last; ++i)
        {
            const std::string_view text = word(i);
            depth += isOneOf(text, {"(", "["}) ? 1 : isOneOf(text, {")", "]"}) ? -1 : 0;
            const bool assigns =
                isOneOf(text, {"=", "++", "--",
                               "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="});
            // A function of the rendering's own may write what it is given.
            const bool calls = _source.uses[_tokens[i]].kind == GlslUse::Kind::Function;
            if (assigns || calls || (depth == 0 && text == ","))
            {
                return false;
            }
        }
        return true;
    }

    bool expression(std::size_t first, std::size_t last, std::string& value)
    {
        for (std::size_t i = first; i < last; ++i)
        {
            if (!term(i, value) || value.size() > LongestValue)
            {
                return false;
            }
            value += ' ';
        }
        return true;
    }

    bool term(std::size_t& at, std::string& value)
    {
        using Use = GlslUse::Kind;
        const std::string text(word(at));
        switch (_source.uses[_tokens[at]].kind)
        {
        case Use::None:
        case Use::Member:
            value += text;
            return true;
        case Use::Builtin:
            return builtin(at, text, value);
        case Use::Local:
        {
            const auto found = _values.find(keyOf(at));
            value += found == _values.end() ? "" : "(" + found->second + ")";
            return found != _values.end();
        }
        case Use::Global:
            return global(at, text, value);
        default:
            return false;
        }
    }

    bool builtin(std::size_t at, const std::string& text, std::string& value)
    {
        const auto written = _program.vertex.builtins.find(text);
        if (written == _program.vertex.builtins.end())
        {
            value += text;
            return true;
        }
        const auto found = _values.find(keyOf(at));
        value += found == _values.end() ? "" : "(" + found->second + ")";
        return found != _values.end();
    }

    bool global(std::size_t at, const std::string& text, std::string& value)
    {
        const auto entity = _program.vertex.entities.find(text);
        if (entity == _program.vertex.entities.end())
        {
            return false;
        }
        const auto& place = entity->second.places.front();
        const GlslSource& source = _program.vertex.shaders[place.shader].source;
        const GlslDeclaration& one = source.declarations[place.index];
        switch (entity->second.kind)
        {
        case Kind::Uniform:
            value += entity->second.merged;
            return true;
        case Kind::Attribute:
        {
            const auto bound = _program.rendering->attributeBindings.find(text);
            value += "attribute " + source.specifiersOf(one).type + " " + text;
            const int location = layoutValue(source, source.specifiersOf(one), "location");
            value += bound == _program.rendering->attributeBindings.end()
                         ? ""
                         : " at " + std::to_string(bound->second);
            value += location < 0 ? "" : " in " + std::to_string(location);
            return true;
        }
        case Kind::Constant:
            for (std::size_t i = one.initializer.first; i < one.initializer.last; ++i)
            {
                if (source.tokens[i].kind == GlslToken::Kind::Identifier)
                {
                    return false;
                }
            }
            value += source.specifiersOf(one).type + "{" + source.spell(one.initializer) + "}";
            return true;
        default:
            break;
        }
        const auto found = _values.find(keyOf(at));
        value += found == _values.end() ? "" : "(" + found->second + ")";
        return found != _values.end();
    }

    /// The name under which the value of a variable is kept; empty if it can't be followed.
    std::string keyOf(std::size_t at) const
    {
        const std::string text(word(at));
        const GlslUse& use = _source.uses[_tokens[at]];
        if (use.kind == GlslUse::Kind::Local)
        {
            // Inner scopes are not followed: one declaration is one variable.
            return "local " + std::to_string(use.target);
        }
        if (_hidden.count(text))
        {
            return "";
        }
        const auto builtin = _program.vertex.builtins.find(text);
        if (builtin != _program.vertex.builtins.end())
        {
            return builtin->second;
        }
        const auto entity = _program.vertex.entities.find(text);
        return entity == _program.vertex.entities.end() ? "" : entity->second.merged;
    }

    /// All that a statement names may have changed.
    void forget(std::size_t first, std::size_t last)
    {
        for (std::size_t i = first; i < last; ++i)
        {
            if (_source.uses[_tokens[i]].kind == GlslUse::Kind::None)
            {
                continue;
            }
            forgetVariable(keyOf(i));
        }
    }

    void forgetVariable(const std::string& key)
    {
        for (auto it = _values.lower_bound(key);
             !key.empty() && it != _values.end() && it->first.compare(0, key.size(), key) == 0;)
        {
            const bool same = it->first.size() == key.size() || it->first[key.size()] == '[';
            it = same ? _values.erase(it) : std::next(it);
        }
    }

    const MergeProgram& _program;
    const GlslSource& _source;
    std::vector<std::size_t> _tokens;
    std::size_t _at = 0;
    std::set<std::string> _hidden;
    std::map<std::string, std::string> _values;
};

/// A value without brackets, spaces and its type.
std::string plainOf(const std::string& value)
{
    std::string plain;
    for (std::size_t i = 0; i < value.size(); ++i)
    {
        if (value.compare(i, 5, "vec4{") == 0 || value.compare(i, 5, "vec3{") == 0)
        {
            i += 4;
        }
        else if (std::string(" (){}").find(value[i]) == std::string::npos)
        {
            plain += value[i];
        }
    }
    return plain;
}

/// The usual ways to write what ftransform() does, as one.
std::string positionOf(const std::string& value)
{
    const std::string plain = plainOf(value);
    const bool usual = plain == "ftransform" || plain == "gl_ModelViewProjectionMatrix*gl_Vertex" ||
                       plain == "gl_ProjectionMatrix*gl_ModelViewMatrix*gl_Vertex";
    return usual ? "ftransform" : value;
}

} // namespace

bool hasUsualPosition(const MergeProgram& program)
{
    return program.position == "ftransform";
}

bool isEyePosition(const MergeVarying& varying)
{
    const std::string plain = plainOf(varying.value);
    const std::string eye = "gl_ModelViewMatrix*gl_Vertex";
    const bool isWhole = varying.components == 4 && plain == eye;
    const bool isPart = varying.components == 3 && (plain == "vec3" + eye || plain == eye + ".xyz");
    return (isWhole || isPart) && varying.base == 'f' && varying.interpolation.empty() &&
           varying.condition.empty();
}

void valueVaryings(MergeProgram& program)
{
    std::map<std::string, std::string> values;
    for (const MergeShader& shader : program.vertex.shaders)
    {
        for (const GlslFunction& function : shader.source.functions)
        {
            if (function.name == "main" && !function.body.empty())
            {
                values = Follower(program, shader.source, function).run();
            }
        }
    }
    const auto position = program.vertex.builtins.find("gl_Position");
    if (position != program.vertex.builtins.end() && values.count(position->second))
    {
        program.position = positionOf(values[position->second]);
    }
    const std::string clamp = "clamp(";
    for (MergeVarying& one : program.varyings)
    {
        const bool clamped = one.vertex.compare(0, clamp.size(), clamp) == 0;
        const std::string name =
            clamped ? one.vertex.substr(clamp.size(), one.vertex.find(',') - clamp.size())
                    : one.vertex;
        const auto found = values.find(name);
        one.value = found == values.end() ? "" : (clamped ? "clamped " : "") + found->second;
    }
}

} // namespace osgMultiRender
