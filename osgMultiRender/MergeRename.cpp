// SPDX-License-Identifier: MIT
#include <osgMultiRender/MergeRename.h>

#include <osgMultiRender/GlslVocabulary.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

/// Whether a word of a comment is meant as a name: "lightDir", "wave_2", "fade()", "'n'".
bool looksLikeName(std::string_view text, std::size_t begin, std::size_t end)
{
    const char before = begin > 0 ? text[begin - 1] : ' ';
    const char behind = end < text.size() ? text[end] : ' ';
    const std::string_view quotes = "'`\"";
    if (behind == '(' || (before == behind && quotes.find(before) != std::string_view::npos))
    {
        return true;
    }
    return std::any_of(text.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
                       text.begin() + static_cast<std::ptrdiff_t>(end),
                       [](char c)
                       { return c == '_' || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

} // namespace

const MergeEntity* MergeRename::find(std::string_view name) const
{
    const auto found = _stage.entities.find(std::string(name));
    return found == _stage.entities.end() ? nullptr : &found->second;
}

const std::string* MergeRename::of(std::size_t token) const
{
    using Use = GlslUse::Kind;
    const Use kind = _source.uses[token].kind;
    const auto inMap = [&](const std::map<std::string, std::string>& map) -> const std::string*
    {
        const auto found = map.find(std::string(_source.word(token)));
        return found == map.end() ? nullptr : &found->second;
    };
    switch (kind)
    {
    case Use::Global:
    case Use::BlockMember:
    case Use::Type:
    case Use::BlockName:
    case Use::Function:
    {
        const MergeEntity* entity = find(_source.word(token));
        if (!entity)
        {
            return inMap(_stage.builtins);
        }
        return kind == Use::Function && !callsOwn(token) ? nullptr : &entity->merged;
    }
    case Use::Builtin:
        return inMap(_stage.builtins);
    case Use::Local:
    case Use::Parameter:
    case Use::Member:
        return inMap(_stage.reserved);
    default:
        return nullptr;
    }
}

/// Whether a use of a function's name means the rendering's own overloads, and not those of
/// a built-in function of the same name.
bool MergeRename::callsOwn(std::size_t token) const
{
    const std::string_view word = _source.word(token);
    if (!builtinFunctionSince(word) || builtinFunctionSince(word) > _source.version.number)
    {
        return true;
    }
    const std::size_t open = skipBlanks(token + 1);
    if (open >= _source.tokens.size() || _source.word(open) != "(")
    {
        return true;
    }
    std::size_t count = 0;
    int depth = 0;
    for (std::size_t i = open; i < _source.tokens.size(); ++i)
    {
        const std::string_view text = _source.word(i);
        depth += text == "(" || text == "[" || text == "{"   ? 1
                 : text == ")" || text == "]" || text == "}" ? -1
                                                             : 0;
        if (depth == 0)
        {
            break;
        }
        const bool starts = i > open && count == 0 && !_source.tokens[i].blank();
        count += starts || (text == "," && depth == 1) ? 1 : 0;
    }
    return std::any_of(_source.functions.begin(), _source.functions.end(),
                       [&](const GlslFunction& function)
                       {
                           return function.name == word && (function.nameToken == token ||
                                                            function.parameters.size() == count);
                       });
}

std::size_t MergeRename::skipBlanks(std::size_t i) const
{
    while (i < _source.tokens.size() && _source.tokens[i].blank())
    {
        ++i;
    }
    return i;
}

std::string MergeRename::textOf(const GlslRange& range) const
{
    std::string text;
    for (std::size_t i = range.first; i < range.last; ++i)
    {
        const std::string* other = of(i);
        text += _source.tokens[i].blank() ? " " : other ? *other : std::string(_source.word(i));
    }
    return text;
}

/// Comments follow the new names.
void MergeRename::renameComment(const GlslToken& token, GlslEdit& edit) const
{
    const std::string_view text = osgMultiRender::textOf(_source.text, token);
    const auto letter = [](char c) {
        return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               (c >= '0' && c <= '9');
    };
    for (std::size_t at = 2; at < text.size();)
    {
        std::size_t end = at;
        while (end < text.size() && letter(text[end]))
        {
            ++end;
        }
        const MergeEntity* entity = end > at ? find(text.substr(at, end - at)) : nullptr;
        if (entity && looksLikeName(text, at, end))
        {
            edit.replace(token.begin + at, token.begin + end, entity->merged);
        }
        at = std::max(end, at + 1);
    }
}

void MergeRename::apply(GlslEdit& edit) const
{
    for (std::size_t i = 0; i < _source.tokens.size(); ++i)
    {
        if (_source.tokens[i].kind == GlslToken::Kind::Comment)
        {
            renameComment(_source.tokens[i], edit);
            continue;
        }
        const std::string* other = of(i);
        if (other)
        {
            edit.replace(_source.tokens[i].begin, _source.tokens[i].end, *other);
        }
    }
}

} // namespace osgMultiRender
