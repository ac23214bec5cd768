// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslSource.h>

#include <osgMultiRender/GlslParser.h>

#include <algorithm>

namespace osgMultiRender
{

bool GlslSpecifiers::has(std::string_view word) const
{
    return std::any_of(qualifiers.begin(), qualifiers.end(),
                       [&](const GlslQualifier& qualifier) { return qualifier.word == word; });
}

std::string GlslSource::spell(const GlslRange& range) const
{
    std::string result;
    bool gap = false;
    for (std::size_t i = range.first; i < std::min(range.last, tokens.size()); ++i)
    {
        const bool blank = tokens[i].blank() || tokens[i].kind == GlslToken::Kind::Directive;
        if (!blank)
        {
            result += gap && !result.empty() ? " " : "";
            result += word(i);
        }
        gap = blank;
    }
    return result;
}

const GlslDeclaration* GlslSource::findGlobal(std::string_view name) const
{
    for (const GlslDeclaration& declaration : declarations)
    {
        const bool global = declaration.kind == GlslDeclaration::Kind::Global ||
                            declaration.kind == GlslDeclaration::Kind::BlockMember;
        if (global && declaration.name == name)
        {
            return &declaration;
        }
    }
    return nullptr;
}

const GlslFunction* GlslSource::findFunction(std::string_view name) const
{
    for (const GlslFunction& function : functions)
    {
        if (function.name == name)
        {
            return &function;
        }
    }
    return nullptr;
}

const GlslMacro* GlslSource::findMacro(std::string_view name, std::size_t token) const
{
    const auto found = macrosByName.find(std::string(name));
    if (found == macrosByName.end())
    {
        return nullptr;
    }
    const auto& list = found->second;
    const auto behind = std::upper_bound(list.begin(), list.end(), token,
                                         [this](std::size_t at, std::size_t index)
                                         { return at < macros[index].token; });
    if (behind == list.begin())
    {
        return nullptr;
    }
    const GlslMacro& macro = macros[*std::prev(behind)];
    return macro.undefined > token ? &macro : nullptr;
}

GlslSource parseGlsl(std::string text, int version)
{
    GlslSource source;
    source.text = std::move(text);
    source.tokens = tokenize(source.text);
    source.version = readVersion(source.text, source.tokens);
    source.tokens = tokenize(source.text, source.version.number);
    source.uses.resize(source.tokens.size());
    const GlslActiveTokens active = preprocess(source, version ? version : source.version.number);
    source.firstCode = active.tokens.empty() ? source.tokens.size() : active.tokens.front();
    source.firstCodeConditional = !active.tokens.empty() && active.conditional.front();
    GlslParser(source, active).run();
    std::stable_sort(source.messages.begin(), source.messages.end(),
                     [](const GlslMessage& a, const GlslMessage& b) {
                         return std::make_pair(a.line, a.column) < std::make_pair(b.line, b.column);
                     });
    return source;
}

const char* toString(GlslVersion::Profile profile)
{
    switch (profile)
    {
    case GlslVersion::Profile::Core:
        return "core";
    case GlslVersion::Profile::Compatibility:
        return "compatibility";
    case GlslVersion::Profile::Es:
        return "es";
    default:
        return "";
    }
}

} // namespace osgMultiRender
