// SPDX-License-Identifier: MIT
// The rows of a table of settings that are members of one struct, and all of them as one text. Not
// installed.
#pragma once

#include <osgMultiRender/Option.h>
#include <osgMultiRender/PseudoLoader.h>

#include <string>
#include <vector>

namespace osgMultiRender
{

template <class Settings, class Value> auto setterOf(Value Settings::*member)
{
    return [member](Settings& settings, const Value& value) { settings.*member = value; };
}

template <class Settings, class Number>
Option<Settings> number(const char* name, Number Settings::*member, Number low, Number high,
                        const char* help)
{
    return numberOption<Settings>(name, help, low, high, member, setterOf(member));
}

template <class Value> struct OptionWord
{
    const char* name;
    Value value;
};

template <class Value, class Settings>
Option<Settings> choice(const char* name, Value Settings::*member,
                        const std::vector<OptionWord<Value>>& words, const char* help)
{
    return wordOption<Settings>(name, help, words, member, setterOf(member));
}

template <class Settings>
Option<Settings> flag(const char* name, bool Settings::*member, const char* help)
{
    return choice<bool>(name, member, {{"on", true}, {"off", false}}, help);
}

/// As parseSettings() takes it for one word.
inline std::string quoted(const std::string& value)
{
    std::string text = "'";
    for (const char c : value)
        text += c == '\'' ? std::string("'\"'\"'") : std::string(1, c);
    return text + "'";
}

/// All that differ from the defaults.
template <class Settings>
std::string formatOptions(const std::vector<Option<Settings>>& options, const Settings& settings)
{
    const Settings defaults;
    std::string all;
    for (const Option<Settings>& option : options)
    {
        const std::string value = option.format(settings);
        if (value != option.format(defaults))
            all += (all.empty() ? "" : ",") + option.name + "=" + quoted(value);
    }
    return all;
}

/// Returns a line for each that is unknown or wrong, which does not count.
template <class Settings>
std::vector<std::string> parseOptions(const std::vector<Option<Settings>>& options,
                                      Settings& settings, const std::string& text)
{
    osgMultiRender::Settings parsed;
    std::string error;
    if (!parseSettings(text, parsed, error))
        return {error};
    std::vector<std::string> errors;
    for (const auto& [name, value] : parsed)
        if (!osgMultiRender::setOption(options, settings, name, value, error))
            errors.push_back(error);
    return errors;
}

} // namespace osgMultiRender
