// SPDX-License-Identifier: MIT
#include "Arguments.h"

#include <examples/commandline/CommandLine.h>

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

Arguments::Arguments(std::vector<std::string> words, const OptionList& options)
{
    examples::CommandLine line("", "osgtilestore");
    line.set_help_flag(); // a subcommand's page is its own
    for (const Option& option : options)
        if (option.hasValue)
            line.add_option(option.name)->take_all()->type_name("value");
        else
            line.add_flag(option.name)->disable_flag_override();
    line.add_option("FILES", _files);
    try
    {
        std::reverse(words.begin(), words.end()); // as CLI11 wants them
        line.parse(words);
    }
    catch (const CLI::ParseError& error)
    {
        throw UsageError(line.describe(error) + "; see --help");
    }
    for (const Option& option : options)
        if (line.count(option.name) > 0)
            _values.emplace(option.name, line[option.name]->results());
}

std::optional<std::string> Arguments::find(const std::string& option) const
{
    const auto found = _values.find(option);
    return found == _values.end() ? std::nullopt : std::optional(found->second.back());
}

std::string Arguments::get(const std::string& option, const std::string& standard) const
{
    return find(option).value_or(standard);
}

std::vector<std::string> Arguments::all(const std::string& option) const
{
    const auto found = _values.find(option);
    return found == _values.end() ? std::vector<std::string>() : found->second;
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
