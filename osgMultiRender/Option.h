// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace osgMultiRender
{

/// One setting of a kit as text, as pseudo-loaders, files and keys say it. `Owner` is what has it.
template <class Owner> struct Option
{
    std::string name;   ///< "shadows".
    std::string values; ///< What may be said: "volumes|map|off", "<0..1>", "auto|<#rrggbb>".
    std::string help;   ///< One sentence.
    /// Sets it; returns "", or why the text is wrong, and then sets nothing.
    std::function<std::string(Owner&, const std::string& text)> parse;
    /// The text that parse() would take for the value that the owner has.
    std::function<std::string(const Owner&)> format;
};

/// The whole text as a number, in any locale.
template <class Number> bool parseNumber(const std::string& text, Number& number)
{
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end;
}

/// The shortest text that parses to the same number.
template <class Number> std::string formatNumber(Number number)
{
    char buffer[32];
    return std::string(buffer, std::to_chars(buffer, buffer + sizeof(buffer), number).ptr);
}

/// A finite number from `low` to `high`, which may be infinite. `get` and `set` are called with the
/// owner.
template <class Owner, class Number, class Get, class Set>
Option<Owner> numberOption(const char* name, const char* help, Number low, Number high, Get get,
                           Set set)
{
    const bool limited = std::isfinite(double(high));
    const std::string range =
        limited ? formatNumber(low) + " to " + formatNumber(high) : "at least " + formatNumber(low);
    const auto parse = [=](Owner& owner, const std::string& text) -> std::string
    {
        Number number{};
        if (!parseNumber(text, number) || !std::isfinite(double(number)) || number < low ||
            number > high)
            return "'" + text + "' is not a " + (std::is_integral_v<Number> ? "whole " : "") +
                   "number " + (limited ? "from " : "of ") + range;
        std::invoke(set, owner, number);
        return {};
    };
    return {name, limited ? "<" + formatNumber(low) + ".." + formatNumber(high) + ">" : "<number>",
            help, parse,
            [=](const Owner& owner) { return formatNumber(Number(std::invoke(get, owner))); }};
}

/// One of named values: `words` have a name and a value. `alias` is another word for one of them.
template <class Owner, class Words, class Get, class Set>
Option<Owner> wordOption(const char* name, const char* help, const Words& words, Get get, Set set,
                         std::pair<std::string, std::string> alias = {})
{
    std::string values, list;
    for (const auto& each : words)
    {
        values += (values.empty() ? "" : "|") + std::string(each.name);
        list += (list.empty() ? "" : ", ") + std::string(each.name);
    }
    const auto parse = [=](Owner& owner, const std::string& text) -> std::string
    {
        const std::string& word = !alias.first.empty() && text == alias.first ? alias.second : text;
        for (const auto& each : words)
            if (word == each.name)
            {
                std::invoke(set, owner, each.value);
                return {};
            }
        return "'" + text + "' is none of " + list;
    };
    const auto format = [=](const Owner& owner) -> std::string
    {
        for (const auto& each : words)
            if (std::invoke(get, owner) == each.value)
                return each.name;
        return "?";
    };
    return {name, values, help, parse, format};
}

/// Sets one of `options` by its name. Returns false and fills `error` with one line that says what
/// may be said.
template <class Owner>
bool setOption(const std::vector<Option<Owner>>& options, Owner& owner, const std::string& name,
               const std::string& text, std::string& error)
{
    std::string known;
    for (const Option<Owner>& option : options)
    {
        if (option.name == name)
        {
            const std::string cause = option.parse(owner, text);
            if (!cause.empty())
                error = "setting '" + name + "=" + text + "': " + cause;
            return cause.empty();
        }
        known += (known.empty() ? "" : ", ") + option.name + "=" + option.values;
    }
    error = "setting '" + name + "=" + text + "' is not known; there are " + known;
    return false;
}

} // namespace osgMultiRender
