// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslMacroExpansion.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

// A text of a thousand lines needs some thousand words; macros that double each other exceed it.
constexpr std::size_t MaximumWords = 200000;
constexpr unsigned int MaximumDepth = 64;

} // namespace

bool isGlslName(std::string_view word)
{
    const char c = word.empty() ? '\0' : word[0];
    return c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// A stretch of words that is being read; macros are closed while their expansion is.
struct GlslMacroTable::Frame
{
    std::vector<GlslWord> words;
    std::size_t at = 0;
    std::string macro;
};

const GlslMacroTable::Macro* GlslMacroTable::find(const std::string& name) const
{
    const auto found = _macros.find(name);
    return found == _macros.end() ? nullptr : &found->second;
}

void GlslMacroTable::define(const std::string& name, const std::string& body)
{
    Macro macro;
    bool space = false;
    for (const GlslToken& token : tokenize(body))
    {
        if (!token.blank())
        {
            macro.body.push_back({std::string(textOf(body, token)), space, false});
        }
        space = token.blank();
    }
    _macros[name] = std::move(macro);
}

bool GlslMacroTable::define(std::string_view text, const std::vector<GlslToken>& parts)
{
    if (parts.empty() || !isGlslName(textOf(text, parts[0])))
    {
        return false;
    }
    Macro macro;
    std::size_t body = 1;
    // "#define f(x)" and "#define f (x)" differ by the blank.
    if (parts.size() > 1 && textOf(text, parts[1]) == "(" && parts[1].begin == parts[0].end)
    {
        macro.functionLike = true;
        for (body = 2; body < parts.size() && textOf(text, parts[body]) != ")"; ++body)
        {
            const std::string_view word = textOf(text, parts[body]);
            if (isGlslName(word))
            {
                macro.parameters.emplace_back(word);
            }
            else if (word != ",")
            {
                return false;
            }
        }
        if (body++ >= parts.size())
        {
            return false;
        }
    }
    for (std::size_t i = body; i < parts.size(); ++i)
    {
        macro.body.push_back(
            {std::string(textOf(text, parts[i])), parts[i].begin != parts[i - 1].end, false});
    }
    _macros[std::string(textOf(text, parts[0]))] = std::move(macro);
    return true;
}

bool GlslMacroTable::expand(std::vector<GlslWord> words, unsigned int line,
                            std::vector<GlslWord>& result)
{
    _line = line;
    _budget = MaximumWords;
    _depth = 0;
    return expandNested(std::move(words), result);
}

bool GlslMacroTable::expandNested(std::vector<GlslWord> words, std::vector<GlslWord>& result)
{
    if (++_depth > MaximumDepth)
    {
        return false;
    }
    std::vector<Frame> frames;
    frames.push_back({std::move(words), 0, ""});
    while (!frames.empty())
    {
        if (frames.back().at == frames.back().words.size())
        {
            frames.pop_back();
            continue;
        }
        GlslWord word = std::move(frames.back().words[frames.back().at++]);
        if (word.text == "__LINE__")
        {
            word.text = std::to_string(_line);
        }
        const Macro* macro = word.closed ? nullptr : find(word.text);
        if (macro && std::any_of(frames.begin(), frames.end(),
                                 [&](const Frame& frame) { return frame.macro == word.text; }))
        {
            word.closed = true;
            macro = nullptr;
        }
        std::vector<std::vector<GlslWord>> arguments;
        if (!macro || (macro->functionLike && !collectArguments(frames, arguments)))
        {
            if (_budget-- == 0)
            {
                return false;
            }
            result.push_back(std::move(word));
            continue;
        }
        Frame inner;
        inner.macro = word.text;
        if (!substitute(*macro, arguments, inner.words) || frames.size() > MaximumDepth)
        {
            return false;
        }
        if (!inner.words.empty())
        {
            inner.words.front().space = word.space;
        }
        frames.push_back(std::move(inner));
    }
    --_depth;
    return true;
}

/// Reads "( a, b )" at the cursor. False, with nothing read, where no complete list stands there.
bool GlslMacroTable::collectArguments(std::vector<Frame>& frames,
                                      std::vector<std::vector<GlslWord>>& arguments) const
{
    std::vector<std::size_t> at;
    for (const Frame& frame : frames)
    {
        at.push_back(frame.at);
    }
    std::size_t level = frames.size();
    int depth = 0;
    arguments.emplace_back();
    while (level > 0)
    {
        Frame& frame = frames[level - 1];
        if (at[level - 1] == frame.words.size())
        {
            --level;
            continue;
        }
        const GlslWord& word = frame.words[at[level - 1]++];
        if (depth == 0 && word.text != "(")
        {
            return false;
        }
        depth += word.text == "(" ? 1 : word.text == ")" ? -1 : 0;
        if (depth == 0)
        {
            for (std::size_t i = 0; i < frames.size(); ++i)
            {
                frames[i].at = i >= level ? frames[i].words.size() : at[i];
            }
            frames.resize(level);
            return true;
        }
        if (depth == 1 && word.text == ",")
        {
            arguments.emplace_back();
        }
        else if (depth > 1 || word.text != "(")
        {
            arguments.back().push_back(word);
        }
    }
    return false;
}

/// The body of a macro with its arguments in it, pasted where "##" stands.
bool GlslMacroTable::substitute(const Macro& macro, std::vector<std::vector<GlslWord>>& arguments,
                                std::vector<GlslWord>& result)
{
    if (macro.body.size() >= _budget)
    {
        return false;
    }
    _budget -= macro.body.size();
    arguments.resize(std::max(arguments.size(), macro.parameters.size()));
    bool paste = false;
    for (std::size_t i = 0; i < macro.body.size(); ++i)
    {
        const GlslWord& word = macro.body[i];
        if (word.text == "##" && i > 0)
        {
            paste = true;
            continue;
        }
        const bool beforePaste = i + 1 < macro.body.size() && macro.body[i + 1].text == "##";
        const auto parameter =
            std::find(macro.parameters.begin(), macro.parameters.end(), word.text);
        std::vector<GlslWord> words = {word};
        if (parameter != macro.parameters.end())
        {
            words = arguments[static_cast<std::size_t>(parameter - macro.parameters.begin())];
            if (!paste && !beforePaste)
            {
                std::vector<GlslWord> expanded;
                if (!expandNested(std::move(words), expanded))
                {
                    return false;
                }
                words = std::move(expanded);
            }
            if (!words.empty())
            {
                words.front().space = word.space;
            }
        }
        std::size_t first = 0;
        if (paste && !words.empty() && !result.empty())
        {
            result.back().text += words[0].text;
            result.back().closed = false;
            first = 1;
        }
        paste = false;
        if (words.size() >= _budget)
        {
            return false;
        }
        _budget -= words.size();
        result.insert(result.end(), words.begin() + static_cast<std::ptrdiff_t>(first),
                      words.end());
    }
    return true;
}

} // namespace osgMultiRender
