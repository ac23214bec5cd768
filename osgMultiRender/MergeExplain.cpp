// SPDX-License-Identifier: MIT
// Compilers' logs in terms of the renderings' own files.
#include <osgMultiRender/Merger.h>

#include <charconv>
#include <sstream>

namespace osgMultiRender
{

namespace
{

/// Reads a number at `at` and moves behind it; -1 if there is none.
long numberAt(const std::string& line, std::size_t& at)
{
    long value = -1;
    const char* const begin = line.data() + at;
    const auto read = std::from_chars(begin, line.data() + line.size(), value);
    if (read.ec != std::errc() || value < 0)
    {
        return -1;
    }
    at += static_cast<std::size_t>(read.ptr - begin);
    return value;
}

/// "3:12(5): error: x" (Mesa), "3(12) : error C1: x" (NVIDIA), "ERROR: 3:12: x" (AMD, glslang).
bool parse(const std::string& line, long& file, long& number, std::string& rest)
{
    std::size_t at = 0;
    std::string prefix;
    for (const char* severity : {"ERROR: ", "WARNING: "})
    {
        const std::string word = severity;
        if (line.compare(0, word.size(), word) == 0)
        {
            prefix = severity[0] == 'W' ? "warning: " : "";
            at = word.size();
        }
    }
    file = numberAt(line, at);
    if (file < 0 || at >= line.size() || (line[at] != ':' && line[at] != '('))
    {
        return false;
    }
    const bool bracket = line[at++] == '(';
    number = numberAt(line, at);
    if (number < 0 || (bracket && (at >= line.size() || line[at] != ')')))
    {
        return false;
    }
    at += bracket ? 1 : 0;
    if (!bracket && at < line.size() && line[at] == '(')
    {
        at = std::min(line.find(')', at), line.size() - 1) + 1;
    }
    at = std::min(line.find_first_not_of(" :", at), line.size());
    rest = prefix + line.substr(at);
    return true;
}

} // namespace

std::string Merged::explain(const std::string& log) const
{
    std::istringstream lines(log);
    std::string result;
    for (std::string line; std::getline(lines, line);)
    {
        long file = 0, number = 0;
        std::string rest;
        if (parse(line, file, number, rest) && static_cast<std::size_t>(file) < files.size())
        {
            result += files[static_cast<std::size_t>(file)].name + ":" + std::to_string(number) +
                      ": " + rest + "\n";
        }
        else if (line.find_first_not_of(" \t\r") != std::string::npos)
        {
            result += line + "\n";
        }
    }
    return result;
}

} // namespace osgMultiRender
