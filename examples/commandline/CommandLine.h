// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace examples
{

/// A number from `low` to `high`; NaN is none.
template <class Number> CLI::Validator between(Number low, Number high)
{
    const auto check = [low, high](const std::string& text) -> std::string
    {
        Number value{};
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
            return {};
        std::ostringstream message;
        message << "needs a " << (std::is_integral_v<Number> ? "whole " : "") << "number from "
                << low << " to " << high << ", not '" << text << "'";
        return message.str();
    };
    return CLI::Validator(check, std::string());
}

/// A tool's command line: CLI11, with the tools' way to say things.
class CommandLine : public CLI::App
{
public:
    CommandLine(const std::string& description, const std::string& name)
        : CLI::App(description, name)
    {
        get_formatter()->column_width(24);
        get_formatter()->label("REQUIRED", "");
        set_help_flag("-h,--help", "this text");
    }

    /// A number with its default in the help.
    template <class Number>
    CLI::Option* addNumber(const std::string& name, Number& value, Number low, Number high,
                           const std::string& description)
    {
        return add_option(name, value, description)
            ->capture_default_str()
            ->check(between(low, high))
            ->type_name("N");
    }

    /// The file that is written.
    CLI::Option* addFile(std::string& file, const std::string& endings)
    {
        return add_option("FILE", file, "its ending says the format: " + endings)
            ->type_name("")
            ->required();
    }

    /// One of several words.
    template <class Value>
    CLI::Option* addChoice(const std::string& name, Value& value,
                           const std::vector<std::pair<std::string, Value>>& choices,
                           const std::string& description)
    {
        std::string words;
        for (const auto& choice : choices)
            words += (words.empty() ? "" : "|") + choice.first;
        const auto take = [&value, choices, words, name](const std::string& text)
        {
            for (const auto& choice : choices)
                if (choice.first == text)
                {
                    value = choice.second;
                    return;
                }
            throw CLI::ValidationError(name, "needs one of " + words + ", not '" + text + "'");
        };
        return add_option_function<std::string>(name, take, description)->type_name(words);
    }

    /// Returns the status to end with, or nothing to go on: help was asked for and is printed, or
    /// an argument is wrong and is named.
    std::optional<int> read(int argc, char** argv, int failure = 1)
    {
        try
        {
            parse(argc, argv);
        }
        catch (const CLI::CallForHelp&)
        {
            return std::fputs(help().c_str(), stdout) < 0;
        }
        catch (const CLI::ParseError& error)
        {
            std::fprintf(stderr, "%s: %s; see --help\n", get_name().c_str(),
                         describe(error).c_str());
            return failure;
        }
        return std::nullopt;
    }

    /// What is wrong, without the end of the line. An option that there is none of is the cause
    /// when its value is too many or taken for something else, too.
    std::string describe(const CLI::ParseError& error) const
    {
        const std::vector<std::string> extras = remaining(true);
        for (const std::string& extra : extras)
            if (extra.size() > 1 && extra.front() == '-')
                return "unknown option '" + extra + "'";
        if (dynamic_cast<const CLI::ExtrasError*>(&error) && !extras.empty())
            return "'" + extras.front() + "' is one argument too many";
        return error.what();
    }
};

} // namespace examples
