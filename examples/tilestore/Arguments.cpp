// SPDX-License-Identifier: MIT
#include "Arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace tilestore
{

std::int64_t parseNumber(const std::string& text, const std::string& what, std::int64_t least,
                         std::int64_t most)
{
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    if (failure != std::errc() || stop != end || value < least || value > most)
        throw UsageError(what + " needs a whole number from " + std::to_string(least) + " to " +
                         std::to_string(most) + ", not '" + text + "'");
    return value;
}

std::uint64_t parseBytes(const std::string& text, const std::string& what)
{
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    const std::string unit(stop, end);
    const char* const units[] = {"", "KiB", "MiB", "GiB", "TiB"};
    for (int i = 0; i < 5 && failure == std::errc() && value > 0.0; ++i)
        if (unit == units[i] && std::ldexp(value, 10 * i) < 9e18)
            return static_cast<std::uint64_t>(std::ldexp(value, 10 * i));
    throw UsageError(what + " needs a size such as 1.5GiB, 200MiB or 1000000, not '" + text + "'");
}

Arguments::Arguments(const std::vector<std::string>& words, const OptionList& options)
{
    bool onlyFiles = false;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const std::string& word = words[i];
        if (onlyFiles || word.size() < 2 || word[0] != '-')
        {
            _files.push_back(word);
            continue;
        }
        if (word == "--")
        {
            onlyFiles = true;
            continue;
        }
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        const auto option = std::find_if(options.begin(), options.end(),
                                         [&](const Option& each) { return name == each.name; });
        if (option == options.end())
            throw UsageError("'" + name + "' is no option; see --help");
        if (option->hasValue && equals == std::string::npos && i + 1 == words.size())
            throw UsageError(name + " needs a value; see --help");
        if (!option->hasValue && equals != std::string::npos)
            throw UsageError(name + " takes no value; see --help");
        _values.emplace(name, !option->hasValue             ? std::string()
                              : equals == std::string::npos ? words[++i]
                                                            : word.substr(equals + 1));
    }
}

std::optional<std::string> Arguments::find(const std::string& option) const
{
    const auto [first, last] = _values.equal_range(option);
    return first == last ? std::nullopt : std::optional(std::prev(last)->second);
}

std::string Arguments::get(const std::string& option, const std::string& standard) const
{
    return find(option).value_or(standard);
}

std::vector<std::string> Arguments::all(const std::string& option) const
{
    std::vector<std::string> values;
    const auto [first, last] = _values.equal_range(option);
    for (auto value = first; value != last; ++value)
        values.push_back(value->second);
    return values;
}

std::int64_t Arguments::number(const std::string& option, std::int64_t standard, std::int64_t least,
                               std::int64_t most) const
{
    const auto text = find(option);
    return text ? parseNumber(*text, option, least, most) : standard;
}

std::uint64_t Arguments::bytes(const std::string& option, std::uint64_t standard) const
{
    const auto text = find(option);
    return text ? parseBytes(*text, option) : standard;
}

std::vector<std::int64_t> Arguments::numbers(const std::string& option, std::size_t least,
                                             std::size_t most) const
{
    std::vector<std::int64_t> numbers;
    if (!has(option))
        return numbers;
    const std::string text = get(option, "");
    for (std::size_t start = 0; start <= text.size();)
    {
        const std::size_t comma = std::min(text.find(',', start), text.size());
        numbers.push_back(parseNumber(text.substr(start, comma - start), option,
                                      std::numeric_limits<std::int64_t>::min(),
                                      std::numeric_limits<std::int64_t>::max()));
        start = comma + 1;
    }
    if (numbers.size() < least || numbers.size() > most)
        throw UsageError(option + " needs " + std::to_string(least) +
                         (most > least ? " or " + std::to_string(most) : "") +
                         " numbers with commas between, not '" + text + "'");
    return numbers;
}

const std::vector<std::string>& Arguments::files(std::size_t least, std::size_t most,
                                                 const std::string& what) const
{
    if (_files.size() < least)
        throw UsageError("needs " + what + "; see --help");
    if (_files.size() > most)
        throw UsageError("'" + _files[most] + "' is one name too many, it needs " + what +
                         "; see --help");
    return _files;
}

} // namespace tilestore
