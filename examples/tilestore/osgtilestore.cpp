// SPDX-License-Identifier: MIT
#include "Subcommand.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>

namespace tilestore
{

namespace
{

constexpr char Help[] =
    R"(osgtilestore SUBCOMMAND [options] ...
Makes, changes and looks at tile stores: pyramids of small pictures that a virtual texture shows.

%SUBCOMMANDS%
  osgtilestore SUBCOMMAND --help   tells more of one of them
  --json                           each of them: what it found or did as JSON on standard output

Exit status: 0 all is well, 1 something failed (standard error says what), 2 wrong options.
)";

const Subcommand* const Subcommands[] = {
    &MaskCommand,       &LayoutCommand,    &BuildCommand,  &MergeCommand,   &AtlasCommand,
    &UpdateCommand,     &InfoCommand,      &VerifyCommand, &ExtractCommand, &CompactCommand,
    &NeighboursCommand, &ReferenceCommand, &BlendCommand};

std::string helpText()
{
    std::string list;
    for (const Subcommand* each : Subcommands)
    {
        std::string name = each->name;
        name.resize(std::max<std::size_t>(name.size(), 11), ' ');
        list += "  " + name + " " + each->summary + "\n";
    }
    std::string text = Help;
    const std::string mark = "%SUBCOMMANDS%\n";
    return text.replace(text.find(mark), mark.size(), list + "\n");
}

const Subcommand* findSubcommand(const std::string& name)
{
    for (const Subcommand* each : Subcommands)
        if (name == each->name)
            return each;
    return nullptr;
}

int fail(const std::string& who, const std::string& message, int status)
{
    std::fprintf(stderr, "osgtilestore%s: %s\n", who.c_str(), message.c_str());
    return status;
}

int runSubcommand(const Subcommand& command, const std::vector<std::string>& words)
{
    const std::string who = std::string(" ") + command.name;
    try
    {
        OptionList options = command.options;
        options.push_back({"--json", false});
        options.push_back({"--help", false});
        const Arguments arguments(words, options);
        if (arguments.has("--help"))
            return std::fputs(command.help, stdout) < 0;
        return command.run(arguments);
    }
    catch (const UsageError& error)
    {
        return fail(who, error.what(), 2);
    }
    catch (const std::bad_alloc&)
    {
        return fail(who, "not enough memory", 1);
    }
    catch (const std::exception& error)
    {
        return fail(who, error.what(), 1);
    }
}

int run(const std::vector<std::string>& words)
{
    if (words.empty())
        return fail("", "no subcommand is named; see --help", 2);
    if (words[0] == "--help" || words[0] == "-h")
        return std::fputs(helpText().c_str(), stdout) < 0;
    const Subcommand* command = findSubcommand(words[0]);
    if (!command)
        return fail("", "'" + words[0] + "' is no subcommand; see --help", 2);
    return runSubcommand(*command, {words.begin() + 1, words.end()});
}

/// What is printed may go to a full disk.
int flushOutput(int status)
{
    errno = 0;
    const bool good = std::cout.flush().good() && std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (good)
        return status;
    const std::string cause = errno ? std::strerror(errno) : "the disk may be full";
    return fail("", "standard output cannot be written: " + cause, std::max(status, 1));
}

} // namespace

std::string grouped(std::uint64_t number)
{
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3;)
        digits.insert(at -= 3, 1, ',');
    return digits;
}

std::string byteText(std::uint64_t bytes)
{
    const char* const units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    int unit = 0;
    while (unit < 4 && std::ldexp(double(bytes), -10 * unit) >= 1024.0)
        ++unit;
    char text[32];
    std::snprintf(text, sizeof text, unit ? "%.1f %s" : "%.0f %s",
                  std::ldexp(double(bytes), -10 * unit), units[unit]);
    return text;
}

void print(const Json& json)
{
    // File names need not be UTF-8.
    std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

} // namespace tilestore

int main(int argc, char** argv)
{
#ifdef SIGXFSZ
    std::signal(SIGXFSZ, SIG_IGN); // writing fails instead, with a line that names the file
#endif
    return tilestore::flushOutput(tilestore::run({argv + 1, argv + argc}));
}
