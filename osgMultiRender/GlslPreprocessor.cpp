// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslPreprocessor.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

using Words = std::vector<std::string_view>;

/// What is known about a macro's name while the directives are walked through.
enum class Presence
{
    Undefined,
    Defined,
    Unknown
};

/// Bracket balance of a stretch of tokens: the sum, and the lowest sum on the way.
struct Balance
{
    long sum = 0, lowest = 0;

    void add(long change)
    {
        sum += change;
        lowest = std::min(lowest, sum);
    }
    void add(const Balance& inner)
    {
        lowest = std::min(lowest, sum + inner.lowest);
        sum += inner.sum;
    }
    bool closed() const { return sum == 0 && lowest == 0; }
};

struct Balances
{
    Balance braces, brackets;

    void add(const Balances& inner)
    {
        braces.add(inner.braces);
        brackets.add(inner.brackets);
    }
    void add(std::string_view word)
    {
        if (word.size() != 1)
        {
            return;
        }
        braces.add(word[0] == '{' ? 1 : word[0] == '}' ? -1 : 0);
        brackets.add(word[0] == '(' || word[0] == '['   ? 1
                     : word[0] == ')' || word[0] == ']' ? -1
                                                        : 0);
    }
    bool closed() const { return braces.closed() && brackets.closed(); }
};

/// An #if with its branches so far.
struct Chain
{
    std::size_t token = 0;
    bool enclosingActive = true;
    bool active = true;
    bool taken = false;   ///< A branch is surely compiled: no later one is.
    bool unknown = false; ///< A condition was not known.
    bool hasElse = false;
    unsigned int branches = 0; ///< Kept ones.
    bool unbalanced = false;
    std::size_t firstEnd = 0; ///< Kept tokens behind the first kept branch.
    Balances first, branch;
};

class Preprocessor
{
public:
    Preprocessor(GlslSource& source, int version) : _source(source), _version(version) {}

    GlslActiveTokens run()
    {
        for (_token = 0; _token < _source.tokens.size(); ++_token)
        {
            const GlslToken& token = _source.tokens[_token];
            if (token.kind == GlslToken::Kind::Directive)
            {
                directive();
            }
            else if (token.kind == GlslToken::Kind::Comment)
            {
                checkComment(token);
            }
            else if (!token.blank())
            {
                keep(token);
            }
        }
        for (const Chain& chain : _chains)
        {
            say(chain.token, "#if without #endif");
        }
        while (!_chains.empty())
        {
            endif();
        }
        return std::move(_kept);
    }

private:
    void say(std::size_t token, const std::string& message)
    {
        const GlslToken& at = _source.tokens[token];
        _source.messages.push_back({at.line, at.column, message});
    }

    bool active() const { return _chains.empty() || _chains.back().active; }

    void checkComment(const GlslToken& token)
    {
        const std::string_view text = textOf(_source.text, token);
        if (text[1] == '*' && (text.size() < 4 || text.substr(text.size() - 2) != "*/"))
        {
            say(_token, "the comment is not closed");
        }
    }

    void keep(const GlslToken& token)
    {
        if (!active())
        {
            dropToken(_token);
            return;
        }
        if (!_chains.empty() && token.kind == GlslToken::Kind::Operator)
        {
            _chains.back().branch.add(textOf(_source.text, token));
        }
        _kept.tokens.push_back(_token);
        _kept.conditional.push_back(_unknownChains > 0);
    }

    void dropToken(std::size_t token)
    {
        if (_source.tokens[token].kind == GlslToken::Kind::Identifier)
        {
            _source.uses[token].kind = GlslUse::Kind::Inactive;
        }
    }

    void directive()
    {
        GlslDirective read = readDirective(_source.text, _source.tokens[_token], _token, _version);
        read.active = active();
        const std::string name = read.name;
        _source.directives.push_back(std::move(read));
        const GlslDirective& directive = _source.directives.back();
        if (name == "if" || name == "ifdef" || name == "ifndef")
        {
            openChain(name, directive);
        }
        else if (name == "elif" || name == "else" || name == "endif")
        {
            if (_chains.empty())
            {
                say(_token, "#" + name + " without #if");
                return;
            }
            name == "endif" ? endif() : nextBranch(name, directive);
        }
        else if (directive.active)
        {
            statement(name, directive);
        }
    }

    void statement(const std::string& name, const GlslDirective& directive)
    {
        if (name == "define")
        {
            define(directive);
        }
        else if (name == "undef" && !directive.parts.empty())
        {
            undefine(std::string(textOf(_source.text, directive.parts[0])));
        }
        else if (name == "pragma" && directive.parts.size() > 1 &&
                 textOf(_source.text, directive.parts[0]) == "import_defines")
        {
            // OSG defines these, or not, when it compiles the shader.
            for (const GlslToken& part : directive.parts)
            {
                if (part.kind == GlslToken::Kind::Identifier)
                {
                    _presence[std::string(textOf(_source.text, part))] = Presence::Unknown;
                }
            }
        }
    }

    void undefine(const std::string& name)
    {
        _presence[name] = _unknownChains ? Presence::Unknown : Presence::Undefined;
        const auto found = _source.macrosByName.find(name);
        if (found == _source.macrosByName.end())
        {
            return;
        }
        GlslMacro& macro = _source.macros[found->second.back()];
        macro.conditional = macro.conditional || _unknownChains;
        macro.undefined = _unknownChains ? macro.undefined : std::min(macro.undefined, _token);
    }

    void define(const GlslDirective& directive)
    {
        if (directive.parts.empty())
        {
            return;
        }
        GlslMacro macro;
        const auto& parts = directive.parts;
        macro.name = textOf(_source.text, parts[0]);
        macro.token = _token;
        macro.conditional = _unknownChains > 0;
        std::size_t body = 1;
        // "#define f(x)" and "#define f (x)" differ by the blank.
        if (parts.size() > 1 && textOf(_source.text, parts[1]) == "(" &&
            parts[1].begin == parts[0].end)
        {
            macro.functionLike = true;
            for (body = 2; body < parts.size() && textOf(_source.text, parts[body]) != ")"; ++body)
            {
                if (textOf(_source.text, parts[body]) != ",")
                {
                    macro.parameters.emplace_back(textOf(_source.text, parts[body]));
                }
            }
            body = std::min(body + 1, parts.size());
        }
        macro.body.assign(parts.begin() + static_cast<std::ptrdiff_t>(body), parts.end());
        _presence[macro.name] = _unknownChains ? Presence::Unknown : Presence::Defined;
        _source.macrosByName[macro.name].push_back(_source.macros.size());
        _source.macros.push_back(std::move(macro));
    }

    Presence presenceOf(std::string_view name) const
    {
        const auto found = _presence.find(std::string(name));
        if (found != _presence.end())
        {
            return found->second;
        }
        if (name == "__VERSION__" || name == "__LINE__" || name == "__FILE__")
        {
            return Presence::Defined;
        }
        const bool extension = name.substr(0, 3) == "GL_" && name != "GL_ES" &&
                               name != "GL_es_profile" && name != "GL_FRAGMENT_PRECISION_HIGH";
        return extension ? Presence::Unknown : Presence::Undefined;
    }

    GlslValue condition(const std::string& name, const GlslDirective& directive)
    {
        if (name != "if" && name != "elif")
        {
            const Presence presence = directive.parts.empty()
                                          ? Presence::Unknown
                                          : presenceOf(textOf(_source.text, directive.parts[0]));
            return {presence != Presence::Unknown,
                    (presence == Presence::Defined) == (name == "ifdef")};
        }
        return evaluate(resolve(directive));
    }

    /// The words of a condition with "defined" answered and macros replaced.
    Words resolve(const GlslDirective& directive)
    {
        Words words;
        const auto& parts = directive.parts;
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
            std::string_view word = textOf(_source.text, parts[i]);
            if (word == "defined" && i + 1 < parts.size())
            {
                const bool bracket = textOf(_source.text, parts[i + 1]) == "(";
                const std::size_t at = i + (bracket ? 2 : 1);
                word =
                    at < parts.size() ? answer(presenceOf(textOf(_source.text, parts[at]))) : "?";
                i = at + (bracket ? 1 : 0);
                words.push_back(word);
                continue;
            }
            words.push_back(word);
        }
        words = expandMacros(_source, _token, words);
        const std::string_view version = internVersion();
        for (std::string_view& word : words)
        {
            const char c = word.empty() ? '?' : word[0];
            if (word == "__VERSION__")
            {
                word = version;
            }
            else if (c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'))
            {
                word = presenceOf(word) == Presence::Undefined ? "0" : "?";
            }
        }
        return words;
    }

    static std::string_view answer(Presence presence)
    {
        return presence == Presence::Unknown ? "?" : presence == Presence::Defined ? "1" : "0";
    }

    std::string_view internVersion()
    {
        _versionText = std::to_string(_version);
        return _versionText;
    }

    void openChain(const std::string& name, const GlslDirective& directive)
    {
        Chain chain;
        chain.token = _token;
        chain.enclosingActive = active();
        chain.firstEnd = _kept.tokens.size();
        const GlslValue value =
            chain.enclosingActive ? condition(name, directive) : GlslValue{true, 0};
        _chains.push_back(chain);
        openBranch(value);
    }

    void openBranch(const GlslValue& value)
    {
        Chain& chain = _chains.back();
        chain.active = chain.enclosingActive && !chain.taken && (!value.known || value.value);
        chain.branch = Balances();
        if (!chain.active)
        {
            return;
        }
        ++chain.branches;
        chain.taken = value.known;
        if (!value.known && !chain.unknown)
        {
            chain.unknown = true;
            ++_unknownChains;
        }
    }

    void closeBranch()
    {
        Chain& chain = _chains.back();
        if (!chain.active)
        {
            return;
        }
        chain.unbalanced = chain.unbalanced || !chain.branch.closed();
        if (chain.branches == 1)
        {
            chain.first = chain.branch;
            chain.firstEnd = _kept.tokens.size();
        }
    }

    void nextBranch(const std::string& name, const GlslDirective& directive)
    {
        closeBranch();
        Chain& chain = _chains.back();
        if (chain.hasElse)
        {
            say(_token, "#" + name + " behind #else");
        }
        chain.hasElse = chain.hasElse || name == "else";
        const bool asked = name == "elif" && chain.enclosingActive && !chain.taken;
        openBranch(asked ? condition(name, directive) : GlslValue{true, 1});
    }

    void endif()
    {
        closeBranch();
        const Chain chain = _chains.back();
        _chains.pop_back();
        if (chain.unknown)
        {
            --_unknownChains;
        }
        if (chain.unbalanced && chain.branches > 1)
        {
            for (std::size_t i = chain.firstEnd; i < _kept.tokens.size(); ++i)
            {
                dropToken(_kept.tokens[i]);
            }
            _kept.tokens.resize(chain.firstEnd);
            _kept.conditional.resize(chain.firstEnd);
        }
        if (_chains.empty())
        {
            _source.conditionals.push_back(
                {chain.token, std::min(_token + 1, _source.tokens.size())});
            return;
        }
        // Balanced branches add nothing to the enclosing one.
        if (chain.unbalanced)
        {
            _chains.back().branch.add(chain.first);
        }
    }

    GlslSource& _source;
    int _version;
    std::size_t _token = 0;
    std::size_t _unknownChains = 0;
    std::vector<Chain> _chains;
    std::unordered_map<std::string, Presence> _presence;
    std::string _versionText;
    GlslActiveTokens _kept;
};

} // namespace

GlslActiveTokens preprocess(GlslSource& source, int version)
{
    return Preprocessor(source, version).run();
}

} // namespace osgMultiRender
