// SPDX-License-Identifier: MIT
// Directives one by one; GlslPreprocessor.cpp follows them through a text.
#include <osgMultiRender/GlslPreprocessor.h>

#include <algorithm>
#include <charconv>

namespace osgMultiRender
{

namespace
{

using Words = std::vector<std::string_view>;

constexpr std::size_t MaximumExpansion = 256;

GlslVersion versionOf(const std::string& text, const GlslDirective& directive)
{
    GlslVersion version;
    if (!directive.parts.empty())
    {
        const std::string_view number = textOf(text, directive.parts[0]);
        std::from_chars(number.data(), number.data() + number.size(), version.number);
    }
    const std::string_view profile =
        directive.parts.size() > 1 ? textOf(text, directive.parts[1]) : std::string_view();
    if (profile == "es" || version.number == 100)
    {
        version.profile = GlslVersion::Profile::Es;
    }
    else if (profile == "core")
    {
        version.profile = GlslVersion::Profile::Core;
    }
    else if (profile == "compatibility")
    {
        version.profile = GlslVersion::Profile::Compatibility;
    }
    return version;
}

} // namespace

GlslDirective readDirective(const std::string& text, const GlslToken& token, std::size_t index,
                            int version)
{
    GlslDirective directive;
    directive.token = index;
    for (const GlslToken& part : tokenizeDirective(text, token, version))
    {
        if (!part.blank())
        {
            directive.parts.push_back(part);
        }
    }
    auto& parts = directive.parts;
    std::size_t head = 1;
    if (parts.size() > 1)
    {
        directive.name = textOf(text, parts[1]);
        head = 2;
    }
    parts.erase(parts.begin(),
                parts.begin() + static_cast<std::ptrdiff_t>(std::min(head, parts.size())));
    return directive;
}

Words expandMacros(const GlslSource& source, std::size_t token, const Words& words)
{
    Words result;
    Words pending(words.rbegin(), words.rend());
    std::size_t budget = MaximumExpansion;
    while (!pending.empty())
    {
        const std::string_view word = pending.back();
        pending.pop_back();
        const GlslMacro* macro = source.findMacro(word, token);
        if (!macro)
        {
            result.push_back(word);
            continue;
        }
        if (macro->functionLike || macro->conditional || macro->body.size() >= budget)
        {
            return {"?"};
        }
        budget -= macro->body.size() + 1;
        for (auto part = macro->body.rbegin(); part != macro->body.rend(); ++part)
        {
            pending.push_back(textOf(source.text, *part));
        }
    }
    return result;
}

GlslVersion readVersion(const std::string& text, const std::vector<GlslToken>& tokens)
{
    // Anywhere: OSG moves it to the front.
    for (std::size_t i = 0; i < tokens.size(); ++i)
    {
        if (tokens[i].kind == GlslToken::Kind::Directive)
        {
            const GlslDirective directive = readDirective(text, tokens[i], i, 110);
            if (directive.name == "version")
            {
                return versionOf(text, directive);
            }
        }
    }
    return {};
}

} // namespace osgMultiRender
