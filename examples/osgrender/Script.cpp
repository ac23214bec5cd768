// SPDX-License-Identifier: MIT
#include "Script.h"

#include <osgDB/fstream>

#include <cstdlib>

namespace osgrender
{

namespace
{

/// Reads "${NAME}" at `at`, moves `at` to its last character and appends the value.
std::string expand(const std::string& line, std::size_t& at,
                   const std::map<std::string, std::string>& definitions, std::string& word)
{
    const std::size_t end = line.find('}', at);
    if (end == std::string::npos)
        return "'${' without '}'";
    const std::string name = line.substr(at + 2, end - at - 2);
    at = end;
    const auto defined = definitions.find(name);
    const char* variable = defined == definitions.end() ? std::getenv(name.c_str()) : nullptr;
    if (defined != definitions.end())
        word += defined->second;
    else if (variable)
        word += variable;
    else
        return "${" + name + "} is neither defined with -D nor in the environment";
    return std::string();
}

} // namespace

std::string splitWords(const std::string& line,
                       const std::map<std::string, std::string>& definitions,
                       std::vector<std::string>& words)
{
    std::string word, error;
    bool inWord = false;
    char quote = '\0';
    for (std::size_t i = 0; i < line.size() && error.empty(); ++i)
    {
        const char c = line[i];
        const bool space = c == ' ' || c == '\t' || c == '\r';
        if (!quote && !inWord && c == '#')
            break;
        if (!quote && space)
        {
            if (inWord)
                words.push_back(word);
            word.clear();
            inWord = false;
            continue;
        }
        inWord = true;
        if (quote ? c == quote : (c == '\'' || c == '"'))
            quote = quote ? '\0' : c;
        else if (quote != '\'' && c == '\\' && i + 1 < line.size())
            word += line[++i];
        else if (quote != '\'' && c == '$' && i + 1 < line.size() && line[i + 1] == '{')
            error = expand(line, i, definitions, word);
        else
            word += c;
    }
    if (error.empty() && quote)
        error = std::string("the quote ") + quote + " is not closed";
    if (inWord)
        words.push_back(word);
    return error;
}

bool readScript(const std::string& file, const std::map<std::string, std::string>& definitions,
                std::vector<ScriptLine>& lines, std::string& error)
{
    osgDB::ifstream stream(file.c_str());
    std::string text, next;
    int number = 0;
    // A folder opens and fails at the first read.
    if (!stream || (stream.peek(), stream.bad()))
    {
        error = "script '" + file + "' can't be read";
        return false;
    }
    while (std::getline(stream, text))
    {
        ScriptLine line;
        line.place = file + ":" + std::to_string(++number);
        while (!text.empty() && text.back() == '\\' && std::getline(stream, next))
        {
            text.back() = ' ';
            text += next;
            ++number;
        }
        line.error = splitWords(text, definitions, line.words);
        if (!line.words.empty() || !line.error.empty())
            lines.push_back(line);
    }
    if (lines.empty())
        error = "script '" + file + "' holds no render";
    return error.empty();
}

} // namespace osgrender
