// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslExpand.h>

#include <osgMultiRender/GlslCondition.h>
#include <osgMultiRender/GlslMacroExpansion.h>
#include <osgMultiRender/GlslPreprocessor.h>
#include <osgMultiRender/GlslWrap.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

constexpr std::size_t MaximumErrors = 8;
constexpr std::size_t MaximumText = 16u << 20;
// In tokens. A bound, so that looking for the end of each "f(f(f(…" stays linear.
constexpr std::size_t LongestArguments = 4096;

bool isLetter(char c)
{
    return c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
}

/// True where two words would be read as one, or as a comment, without a blank.
bool needsBlank(char left, char right)
{
    constexpr std::string_view joining = "+-*/%<>=!&|^.";
    const auto joins = [&](char c) { return joining.find(c) != std::string_view::npos; };
    return (isLetter(left) && isLetter(right)) || (joins(left) && joins(right)) ||
           (isLetter(left) && right == '.') || (left == '.' && isLetter(right));
}

/// The desktop version that has what a version of GLSL ES has.
GlslVersion desktopVersion(const GlslVersion& version)
{
    if (version.profile != GlslVersion::Profile::Es)
    {
        return version;
    }
    GlslVersion desktop;
    desktop.number = version.number < 300 ? 120 : version.number < 310 ? 330 : 430;
    desktop.profile = GlslVersion::Profile::Compatibility;
    desktop.profile = desktop.number < 150 ? GlslVersion::Profile::None : desktop.profile;
    return desktop;
}

class Expander
{
public:
    Expander(const std::string& text, const std::map<std::string, std::string>& defines)
        : _text(text), _tokens(tokenize(text))
    {
        _result.version = readVersion(text, _tokens);
        const GlslVersion& version = _result.version;
        _macros.define("__VERSION__", std::to_string(version.number));
        _macros.define("__FILE__", "0");
        if (version.number >= 150 && version.profile != GlslVersion::Profile::Es)
        {
            const bool compatible = version.profile == GlslVersion::Profile::Compatibility;
            _macros.define(compatible ? "GL_compatibility_profile" : "GL_core_profile", "1");
        }
        for (const auto& [name, body] : defines)
        {
            _macros.define(name, body);
        }
    }

    GlslExpanded run()
    {
        for (_at = 0; _at < _tokens.size() && _result.text.size() < MaximumText; ++_at)
        {
            token(_tokens[_at]);
        }
        if (_at < _tokens.size())
        {
            say(_tokens[_at], "the text grows beyond 16 MiB");
        }
        if (!_chains.empty())
        {
            say(_chains.back().opened, "#if without #endif");
        }
        _result.version = desktopVersion(_result.version);
        return std::move(_result);
    }

private:
    struct Chain
    {
        GlslToken opened;
        bool enclosing = true, active = true, taken = false, hasElse = false;
    };

    bool active() const { return _chains.empty() || _chains.back().active; }

    void say(const GlslToken& at, const std::string& message)
    {
        if (_result.errors.size() < MaximumErrors)
        {
            _result.errors.push_back({at.line, at.column, message});
        }
    }

    void token(const GlslToken& token)
    {
        if (token.kind == GlslToken::Kind::Directive)
        {
            directive(token);
            lineEnds(_at);
        }
        else if (token.kind == GlslToken::Kind::Whitespace)
        {
            blanks(token);
        }
        else if (!active())
        {
            lineEnds(_at);
        }
        else if (token.kind == GlslToken::Kind::Comment)
        {
            comment(token);
        }
        else if (isMacro(token))
        {
            macroUse();
        }
        else
        {
            _result.text += textOf(_text, token);
        }
    }

    /// Keywords can be macros: "#define highp".
    bool isMacro(const GlslToken& token) const
    {
        const std::string_view word = textOf(_text, token);
        return (token.kind == GlslToken::Kind::Identifier ||
                token.kind == GlslToken::Kind::Keyword) &&
               (word == "__LINE__" || _macros.find(std::string(word)));
    }

    /// The line ends within a token, and nothing else of it.
    void lineEnds(std::size_t index)
    {
        const unsigned int next =
            index + 1 < _tokens.size() ? _tokens[index + 1].line : _tokens[index].line;
        _result.text.append(next - _tokens[index].line, '\n');
    }

    /// White space with plain line ends; continued lines are lines.
    void blanks(const GlslToken& token)
    {
        std::string_view text = textOf(_text, token);
        for (std::size_t i = 0; i < text.size(); ++i)
        {
            const char c = text[i];
            if (c == '\n' || c == '\r')
            {
                const char next = i + 1 < text.size() ? text[i + 1] : c;
                i += next != c && (next == '\n' || next == '\r') ? 1 : 0;
                _result.text += '\n';
            }
            else if (c != '\\' && active())
            {
                _result.text += c == '\t' || c == ' ' ? c : ' ';
            }
        }
    }

    void comment(const GlslToken& token)
    {
        const std::string_view text = textOf(_text, token);
        if (text[1] == '*' && (text.size() < 4 || text.substr(text.size() - 2) != "*/"))
        {
            say(token, "the comment is not closed");
            return;
        }
        for (std::size_t i = 0; i < text.size(); ++i)
        {
            const char c = text[i];
            if (c == '\n' || c == '\r')
            {
                const char next = i + 1 < text.size() ? text[i + 1] : c;
                i += next != c && (next == '\n' || next == '\r') ? 1 : 0;
                // Not every compiler continues comments.
                _result.text += text[1] == '/' ? "\n//" : "\n";
            }
            else
            {
                // A backslash before a line end would continue the line.
                _result.text += c == '\0' || c == '\\' ? ' ' : c;
            }
        }
    }

    /// The name of a macro: takes what may be its arguments, puts the expansion in place.
    void macroUse()
    {
        const std::size_t first = _at;
        std::vector<GlslWord> words = {{std::string(textOf(_text, _tokens[_at])), false, false}};
        const GlslMacroTable::Macro* macro = _macros.find(words[0].text);
        // An expansion may end in the name of a function-like macro whose arguments follow.
        const std::size_t last = macro ? endOfArguments(_at, words) : _at;
        std::vector<GlslWord> expanded;
        if (!_macros.expand(words, _tokens[first].line, expanded))
        {
            say(_tokens[first], "the macro '" + words[0].text + "' expands without end");
            return;
        }
        for (const GlslWord& word : expanded)
        {
            const char before = _result.text.empty() ? ' ' : _result.text.back();
            const bool blank = word.space || (!word.text.empty() && needsBlank(before, word.text[0]));
            _result.text += blank && before != ' ' ? " " : "";
            _result.text += word.text;
        }
        const unsigned int line =
            last + 1 < _tokens.size() ? _tokens[last + 1].line : _tokens[last].line;
        _result.text.append(line - _tokens[first].line, '\n');
        if (last + 1 < _tokens.size() && !_result.text.empty())
        {
            const char next = _text[_tokens[last + 1].begin];
            _result.text += needsBlank(_result.text.back(), next) ? " " : "";
        }
        _at = last;
    }

    /// Adds the words of "( … )" behind a name, if they stand there; the last token's index.
    std::size_t endOfArguments(std::size_t name, std::vector<GlslWord>& words) const
    {
        std::vector<GlslWord> added;
        int depth = 0;
        bool space = false;
        const std::size_t end = std::min(_tokens.size(), name + LongestArguments);
        for (std::size_t i = name + 1; i < end; ++i)
        {
            const GlslToken& token = _tokens[i];
            if (token.kind == GlslToken::Kind::Directive)
            {
                return name;
            }
            if (token.blank())
            {
                space = true;
                continue;
            }
            const std::string_view text = textOf(_text, token);
            if (depth == 0 && text != "(")
            {
                return name;
            }
            added.push_back({std::string(text), space, false});
            space = false;
            depth += text == "(" ? 1 : text == ")" ? -1 : 0;
            if (depth == 0)
            {
                words.insert(words.end(), added.begin(), added.end());
                return i;
            }
        }
        return name;
    }

    void directive(const GlslToken& token)
    {
        const GlslDirective read = readDirective(_text, token, _at, _result.version.number);
        const std::string& name = read.name;
        if (name == "if" || name == "ifdef" || name == "ifndef")
        {
            Chain chain;
            chain.opened = token;
            chain.enclosing = active();
            _chains.push_back(chain);
            openBranch(chain.enclosing && condition(read));
        }
        else if (name == "elif" || name == "else" || name == "endif")
        {
            nextBranch(read, token);
        }
        else if (active())
        {
            statement(read, token);
        }
    }

    void openBranch(bool holds)
    {
        Chain& chain = _chains.back();
        chain.active = chain.enclosing && !chain.taken && holds;
        chain.taken = chain.taken || chain.active;
    }

    void nextBranch(const GlslDirective& read, const GlslToken& token)
    {
        if (_chains.empty() || (_chains.back().hasElse && read.name != "endif"))
        {
            say(token, "#" + read.name + (_chains.empty() ? " without #if" : " behind #else"));
            return;
        }
        if (read.name == "endif")
        {
            _chains.pop_back();
            return;
        }
        Chain& chain = _chains.back();
        chain.hasElse = read.name == "else";
        const bool asked = chain.enclosing && !chain.taken;
        openBranch(asked && (chain.hasElse || condition(read)));
    }

    void statement(const GlslDirective& read, const GlslToken& token)
    {
        const auto part = [&](std::size_t i)
        { return i < read.parts.size() ? std::string(textOf(_text, read.parts[i])) : ""; };
        if (read.name == "define")
        {
            if (!_macros.define(_text, read.parts))
            {
                say(token, "the #define is malformed");
            }
        }
        else if (read.name == "undef")
        {
            _macros.undefine(part(0));
        }
        else if (read.name == "extension")
        {
            _result.extensions.push_back({part(0), part(2), token.line});
        }
        else if (read.name == "pragma")
        {
            const bool invariant = part(0) == "STDGL" && part(1) == "invariant";
            _result.invariantAll = _result.invariantAll || invariant;
        }
        else if (read.name == "error")
        {
            std::string message;
            for (const GlslToken& one : read.parts)
            {
                message += " " + std::string(textOf(_text, one));
            }
            say(token, "#error" + message);
        }
        else if (read.name == "version")
        {
            // It stays: it says which words are keywords.
            _result.text += "#version " + toString(desktopVersion(_result.version));
        }
        else if (read.name == "line")
        {
            const std::string number = part(0);
            if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos)
            {
                _result.text += "#line " + number.substr(0, 9);
            }
        }
        else if (!read.name.empty())
        {
            say(token, "#" + read.name + " is not known");
        }
    }

    bool condition(const GlslDirective& read)
    {
        std::vector<GlslWord> words;
        for (const GlslToken& part : read.parts)
        {
            words.push_back({std::string(textOf(_text, part)), false, false});
        }
        if (read.name == "ifdef" || read.name == "ifndef")
        {
            const bool defined = !words.empty() && _macros.find(words[0].text);
            return defined == (read.name == "ifdef");
        }
        std::vector<GlslWord> asked, expanded;
        for (std::size_t i = 0; i < words.size(); ++i)
        {
            if (words[i].text != "defined")
            {
                asked.push_back(words[i]);
                continue;
            }
            const bool bracket = i + 1 < words.size() && words[i + 1].text == "(";
            i += bracket ? 2 : 1;
            const bool defined = i < words.size() && _macros.find(words[i].text);
            i += bracket ? 1 : 0;
            asked.push_back({defined ? "1" : "0", false, false});
        }
        const GlslToken& at = _tokens[read.token];
        const bool ok = _macros.expand(asked, at.line, expanded);
        std::vector<std::string_view> terms;
        for (const GlslWord& word : expanded)
        {
            terms.push_back(isGlslName(word.text) ? "0" : std::string_view(word.text));
        }
        const GlslValue value = ok ? evaluate(terms) : GlslValue{};
        if (!value.known)
        {
            say(at, "the condition of #" + read.name + " has no value");
        }
        return value.known && value.value != 0;
    }

    const std::string& _text;
    std::vector<GlslToken> _tokens;
    std::size_t _at = 0;
    std::vector<Chain> _chains;
    GlslMacroTable _macros;
    GlslExpanded _result;
};

} // namespace

GlslExpanded expandGlsl(const std::string& text, const std::map<std::string, std::string>& defines)
{
    return Expander(text, defines).run();
}

} // namespace osgMultiRender
