// SPDX-License-Identifier: MIT
#include <osgLabels/MapClasses.h>

#include <osg/ValueObject>

#include <algorithm>

namespace osgLabels
{

namespace
{

const char* const actionNames[] = {"hide", "outline", "recolor", "fade", "ignore"};

/// std::regex recurses once a character: a name may not exhaust the stack.
constexpr std::size_t longestMatched = 1024;

/// Cuts at commas that stand in no bracket of a regular expression.
std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> parts{""};
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const char c = text[i];
        if (c == '\\' && i + 1 < text.size())
        {
            parts.back() += {c, text[++i]};
            continue;
        }
        depth += (c == '(' || c == '[' || c == '{') - (c == ')' || c == ']' || c == '}');
        if (c == ',' && depth <= 0)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

} // namespace

bool MapClasses::parse(const std::string& text, std::string& error)
{
    std::vector<Rule> rules;
    for (const std::string& part : text.empty() ? std::vector<std::string>() : split(text))
    {
        const std::size_t colon = part.rfind(':');
        const std::string name = colon == std::string::npos ? "" : part.substr(colon + 1);
        const auto* action = std::find(std::begin(actionNames), std::end(actionNames), name);
        if (colon == std::string::npos || colon == 0 || action == std::end(actionNames))
        {
            error = "'" + part + "' is no <regular expression>:hide|outline|recolor|fade|ignore";
            return false;
        }
        try
        {
            rules.push_back({std::regex(part.substr(0, colon)),
                             MapAction(unsigned(action - std::begin(actionNames)))});
        }
        catch (const std::regex_error& cause)
        {
            error = "'" + part.substr(0, colon) + "' is no regular expression: " + cause.what();
            return false;
        }
    }
    _rules = std::move(rules);
    return true;
}

std::optional<MapAction> MapClasses::find(const std::string& name) const
{
    if (name.empty())
        return std::nullopt;
    const auto end =
        name.begin() + static_cast<std::ptrdiff_t>(std::min(name.size(), longestMatched));
    for (const Rule& rule : _rules)
        if (std::regex_search(name.begin(), end, rule.pattern))
            return rule.action;
    return std::nullopt;
}

std::optional<MapAction> MapClasses::actionOf(const osg::NodePath& path) const
{
    if (_rules.empty())
        return std::nullopt;
    for (auto node = path.rbegin(); node != path.rend(); ++node)
    {
        std::string name;
        if (!(*node)->getUserDataContainer() || !(*node)->getUserValue("labelClass", name))
            name = (*node)->getName();
        if (const std::optional<MapAction> action = find(name))
            return action;
    }
    return std::nullopt;
}

} // namespace osgLabels
