// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslEdit.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace osgMultiRender
{

namespace
{

using Kind = GlslUse::Kind;

/// Offsets at which lines begin, by the lexer's idea of a line end.
std::vector<std::size_t> lineStarts(std::string_view text)
{
    std::vector<std::size_t> starts = {0};
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const char c = text[i];
        if (c == '\n' || c == '\r')
        {
            const char next = i + 1 < text.size() ? text[i + 1] : c;
            i += next != c && (next == '\n' || next == '\r') ? 1 : 0;
            starts.push_back(i + 1);
        }
    }
    return starts;
}

/// The lines of a source as the compiler counts them: "#line" of the user moves them.
class LineNumbers
{
public:
    explicit LineNumbers(const GlslSource& source) : _starts(lineStarts(source.text))
    {
        for (const GlslDirective& directive : source.directives)
        {
            if (directive.name == "line" && directive.active && !directive.parts.empty())
            {
                add(source, directive);
            }
        }
    }

    std::size_t lineAt(std::size_t offset) const
    {
        return static_cast<std::size_t>(std::upper_bound(_starts.begin(), _starts.end(), offset) -
                                        _starts.begin());
    }

    /// "#line …" that gives the text from `offset` on its number again.
    std::string directive(std::size_t offset, int version) const
    {
        long long number = static_cast<long long>(lineAt(offset));
        std::string file;
        const auto behind =
            std::upper_bound(_jumps.begin(), _jumps.end(), offset,
                             [](std::size_t at, const Jump& jump) { return at < jump.offset; });
        if (behind != _jumps.begin())
        {
            number += std::prev(behind)->shift;
            file = std::prev(behind)->file;
        }
        // Below 330 the directive gives its own line the number, and the next one counts from it.
        number -= version < 330 ? 1 : 0;
        return "#line " + std::to_string(std::max(number, 0LL)) + file + "\n";
    }

private:
    struct Jump
    {
        std::size_t offset;
        long long shift;
        std::string file; ///< " 2", the number of the source string; or empty.
    };

    void add(const GlslSource& source, const GlslDirective& directive)
    {
        const std::size_t end = source.tokens[directive.token].end;
        const std::string_view word = textOf(source.text, directive.parts[0]);
        int number = 0;
        if (std::from_chars(word.data(), word.data() + word.size(), number).ec != std::errc())
        {
            return;
        }
        Jump jump;
        jump.offset = end;
        const auto next = static_cast<long long>(lineAt(end)) + 1;
        jump.shift = number + (source.version.number < 330 ? 1 : 0) - next;
        if (directive.parts.size() > 1 && directive.parts[1].kind == GlslToken::Kind::Number)
        {
            jump.file = " " + std::string(textOf(source.text, directive.parts[1]));
        }
        _jumps.push_back(std::move(jump));
    }

    std::vector<std::size_t> _starts;
    std::vector<Jump> _jumps;
};

bool isCondition(const std::string& name)
{
    return name == "if" || name == "elif" || name == "ifdef" || name == "ifndef";
}

} // namespace

GlslEdit::GlslEdit(const GlslSource& source) : _source(source) {}

/// True if the identifier means something global, or its place is not looked at.
bool GlslEdit::renamesHere(std::size_t token) const
{
    switch (_source.uses[token].kind)
    {
    case Kind::Global:
    case Kind::BlockMember:
    case Kind::Function:
    case Kind::Type:
    case Kind::BlockName:
    case Kind::Builtin:
    case Kind::Undeclared:
        return true;
    case Kind::Inactive:
        return token == 0 || _source.word(token - 1) != ".";
    default:
        return false;
    }
}

std::size_t GlslEdit::rename(const Names& names)
{
    std::set<std::string_view> inMacros;
    for (const GlslMacro& macro : _source.macros)
    {
        for (const GlslToken& part : macro.body)
        {
            inMacros.insert(textOf(_source.text, part));
        }
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < _source.tokens.size(); ++i)
    {
        const Kind kind = _source.uses[i].kind;
        const auto found = kind == Kind::None ? names.end() : names.find(_source.word(i));
        if (found == names.end())
        {
            continue;
        }
        const bool shadows = kind == Kind::Local || kind == Kind::Parameter;
        if (renamesHere(i) || (shadows && inMacros.count(_source.word(i))))
        {
            replace(_source.tokens[i].begin, _source.tokens[i].end, found->second);
            ++count;
        }
    }
    for (const GlslDirective& directive : _source.directives)
    {
        count += renameInDirective(directive, names, false);
    }
    return count;
}

std::size_t GlslEdit::renameWords(const Names& names)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < _source.tokens.size(); ++i)
    {
        const Kind kind = _source.uses[i].kind;
        if (kind == Kind::None || kind == Kind::Macro || kind == Kind::LayoutName)
        {
            continue;
        }
        const auto found = names.find(_source.word(i));
        if (found != names.end())
        {
            replace(_source.tokens[i].begin, _source.tokens[i].end, found->second);
            ++count;
        }
    }
    for (const GlslDirective& directive : _source.directives)
    {
        count += renameInDirective(directive, names, true);
    }
    return count;
}

std::size_t GlslEdit::renameInDirective(const GlslDirective& directive, const Names& names,
                                        bool everyRole)
{
    const auto& parts = directive.parts;
    std::set<std::string_view> kept;
    std::size_t first = 0;
    if (directive.name == "define" && !parts.empty())
    {
        first = 1;
        if (parts.size() > 1 && parts[1].begin == parts[0].end &&
            textOf(_source.text, parts[1]) == "(")
        {
            for (first = 2; first < parts.size() && textOf(_source.text, parts[first]) != ")";
                 ++first)
            {
                kept.insert(textOf(_source.text, parts[first]));
            }
        }
    }
    else if (!isCondition(directive.name))
    {
        return 0;
    }
    std::size_t count = 0;
    for (std::size_t i = first; i < parts.size(); ++i)
    {
        const std::string_view word = textOf(_source.text, parts[i]);
        const auto found = names.find(word);
        const bool member = i > first && textOf(_source.text, parts[i - 1]) == ".";
        if (found == names.end() || kept.count(word) || (member && !everyRole) ||
            _source.macrosByName.count(std::string(word)))
        {
            continue;
        }
        replace(parts[i].begin, parts[i].end, found->second);
        ++count;
    }
    return count;
}

void GlslEdit::blank(const GlslRange& range)
{
    for (std::size_t i = range.first; i < std::min(range.last, _source.tokens.size()); ++i)
    {
        const GlslToken& token = _source.tokens[i];
        if (!token.blank() && token.kind != GlslToken::Kind::Directive)
        {
            replace(token.begin, token.end, "");
        }
    }
}

void GlslEdit::removeQualifiers(const GlslSpecifiers& specifiers,
                                const std::vector<std::string>& words)
{
    for (const GlslQualifier& qualifier : specifiers.qualifiers)
    {
        if (std::find(words.begin(), words.end(), qualifier.word) != words.end())
        {
            blank(qualifier.range);
        }
    }
}

void GlslEdit::setQualifiers(const GlslSpecifiers& specifiers, const std::string& text)
{
    for (const GlslQualifier& qualifier : specifiers.qualifiers)
    {
        blank(qualifier.range);
    }
    if (!text.empty())
    {
        insertBefore(specifiers.statement.first, text + " ");
    }
}

void GlslEdit::insertBefore(std::size_t token, const std::string& text)
{
    const std::size_t at =
        token < _source.tokens.size() ? _source.tokens[token].begin : _source.text.size();
    replace(at, at, text);
}

void GlslEdit::replace(std::size_t begin, std::size_t end, const std::string& text)
{
    _changes.push_back({begin, end, text});
}

std::string GlslEdit::getText(int version) const
{
    std::vector<Change> changes = _changes;
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b)
                     {
                         // Insertions come before what replaces the bytes behind them.
                         return std::make_pair(a.begin, a.end != a.begin) <
                                std::make_pair(b.begin, b.end != b.begin);
                     });
    const LineNumbers lines(_source);
    const int effective = version ? version : _source.version.number;
    std::string result;
    result.reserve(_source.text.size() + 256);
    std::size_t at = 0;
    for (const Change& change : changes)
    {
        if (change.begin < at)
        {
            continue;
        }
        result.append(_source.text, at, change.begin - at);
        result += change.text;
        at = change.end;
        const std::size_t removed = lines.lineAt(change.end) - lines.lineAt(change.begin);
        if (removed + 1 != lineStarts(change.text).size())
        {
            result += result.empty() || result.back() == '\n' ? "" : "\n";
            result += lines.directive(change.end, effective);
        }
    }
    return result.append(_source.text, at, std::string::npos);
}

} // namespace osgMultiRender
