// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslToken.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>
#include <array>

namespace osgMultiRender
{

namespace
{

using Kind = GlslToken::Kind;

// Own classification: <cctype> depends on the locale.
bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}
bool isWord(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || isDigit(c);
}
bool isNewline(char c)
{
    return c == '\n' || c == '\r';
}
bool isBlank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || isNewline(c);
}

constexpr std::string_view OperatorCharacters = "+-*/%<>=!&|^~?:;,.()[]{}#";

std::size_t operatorLength(std::string_view rest)
{
    static constexpr std::array<std::string_view, 22> longer = {
        "<<=", ">>=", "++", "--", "<=", ">=", "==", "!=", "&&", "||", "^^",
        "+=",  "-=",  "*=", "/=", "%=", "&=", "|=", "^=", "<<", ">>", "##"};
    if (rest.size() < 2 || OperatorCharacters.find(rest[1]) == std::string_view::npos)
    {
        return 1;
    }
    for (std::string_view candidate : longer)
    {
        if (rest.substr(0, candidate.size()) == candidate)
        {
            return candidate.size();
        }
    }
    return 1;
}

class Lexer
{
public:
    Lexer(std::string_view text, std::size_t begin, std::size_t end, int version)
        : _text(text.substr(0, end)), _at(begin), _version(version)
    {
    }

    std::vector<GlslToken> run(unsigned int line, unsigned int column, bool inDirective)
    {
        _line = line;
        _column = column;
        bool lineStart = !inDirective;
        while (_at < _text.size())
        {
            GlslToken token;
            token.begin = _at;
            token.line = _line;
            token.column = _column;
            token.kind = scan(lineStart);
            token.end = _at;
            if (token.kind == Kind::Whitespace)
            {
                lineStart = (lineStart || endsLine(token)) && !inDirective;
            }
            else if (token.kind != Kind::Comment)
            {
                lineStart = false;
            }
            countLines(token);
            _tokens.push_back(token);
        }
        return std::move(_tokens);
    }

private:
    char peek(std::size_t ahead = 0) const
    {
        return _at + ahead < _text.size() ? _text[_at + ahead] : '\0';
    }

    /// Bytes of the line end at `position`: 2 for CRLF and LFCR.
    std::size_t newlineLength(std::size_t position) const
    {
        if (position >= _text.size() || !isNewline(_text[position]))
        {
            return 0;
        }
        const bool pair = position + 1 < _text.size() && isNewline(_text[position + 1]) &&
                          _text[position + 1] != _text[position];
        return pair ? 2 : 1;
    }

    /// Bytes of a backslash with the line end behind it, else 0.
    std::size_t continuationLength() const
    {
        const std::size_t newline = peek() == '\\' ? newlineLength(_at + 1) : 0;
        return newline ? newline + 1 : 0;
    }

    Kind scan(bool lineStart)
    {
        const char c = peek();
        if (isBlank(c) || continuationLength())
        {
            return scanBlanks();
        }
        if (c == '/' && (peek(1) == '/' || peek(1) == '*'))
        {
            skipComment();
            return Kind::Comment;
        }
        if (c == '#' && lineStart)
        {
            skipDirective();
            return Kind::Directive;
        }
        if (isDigit(c) || (c == '.' && isDigit(peek(1))))
        {
            return scanNumber();
        }
        if (isWord(c))
        {
            return scanWord();
        }
        if (OperatorCharacters.find(c) != std::string_view::npos)
        {
            _at += operatorLength(_text.substr(_at));
            return Kind::Operator;
        }
        return scanOther();
    }

    Kind scanBlanks()
    {
        while (_at < _text.size())
        {
            const std::size_t continuation = continuationLength();
            if (!continuation && !isBlank(peek()))
            {
                break;
            }
            _at += continuation ? continuation : 1;
        }
        return Kind::Whitespace;
    }

    void skipComment()
    {
        if (peek(1) == '*')
        {
            const std::size_t close = _text.find("*/", _at + 2);
            _at = close == std::string_view::npos ? _text.size() : close + 2;
            return;
        }
        while (_at < _text.size() && !isNewline(peek()))
        {
            const std::size_t continuation = continuationLength();
            _at += continuation ? continuation : 1;
        }
    }

    void skipDirective()
    {
        while (_at < _text.size() && !isNewline(peek()))
        {
            if (peek() == '/' && (peek(1) == '/' || peek(1) == '*'))
            {
                skipComment();
                continue;
            }
            const std::size_t continuation = continuationLength();
            _at += continuation ? continuation : 1;
        }
    }

    Kind scanNumber()
    {
        const bool hexadecimal = peek() == '0' && (peek(1) == 'x' || peek(1) == 'X');
        while (isWord(peek()) || peek() == '.')
        {
            const bool exponent = !hexadecimal && (peek() == 'e' || peek() == 'E');
            ++_at;
            if (exponent && (peek() == '+' || peek() == '-'))
            {
                ++_at;
            }
        }
        return Kind::Number;
    }

    Kind scanWord()
    {
        const std::size_t begin = _at;
        while (isWord(peek()))
        {
            ++_at;
        }
        const int since = reservedSince(_text.substr(begin, _at - begin));
        return since && since <= _version ? Kind::Keyword : Kind::Identifier;
    }

    Kind scanOther()
    {
        do
        {
            ++_at;
        } while (_at < _text.size() && !isBlank(peek()) && !isWord(peek()) && peek() != '\\' &&
                 OperatorCharacters.find(peek()) == std::string_view::npos);
        return Kind::Other;
    }

    /// True when a white space token holds a line end that is not continued.
    bool endsLine(const GlslToken& token) const
    {
        for (std::size_t i = token.begin; i < token.end; ++i)
        {
            if (_text[i] == '\\')
            {
                i += newlineLength(i + 1);
            }
            else if (isNewline(_text[i]))
            {
                return true;
            }
        }
        return false;
    }

    void countLines(const GlslToken& token)
    {
        const bool word = token.kind == Kind::Identifier || token.kind == Kind::Keyword ||
                          token.kind == Kind::Operator || token.kind == Kind::Number;
        if (word)
        {
            _column += static_cast<unsigned int>(token.end - token.begin);
            return;
        }
        for (std::size_t i = token.begin; i < token.end;)
        {
            const std::size_t newline = newlineLength(i);
            _line += newline ? 1 : 0;
            _column = newline ? 1 : _column + 1;
            i += newline ? newline : 1;
        }
    }

    std::string_view _text;
    std::size_t _at;
    int _version;
    unsigned int _line = 1;
    unsigned int _column = 1;
    std::vector<GlslToken> _tokens;
};

} // namespace

std::vector<GlslToken> tokenize(std::string_view text, int version)
{
    return Lexer(text, 0, text.size(), version).run(1, 1, false);
}

std::vector<GlslToken> tokenizeDirective(std::string_view text, const GlslToken& directive,
                                         int version)
{
    return Lexer(text, directive.begin, directive.end, version)
        .run(directive.line, directive.column, true);
}

} // namespace osgMultiRender
