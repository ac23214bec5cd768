// SPDX-License-Identifier: MIT
#include <osgLabels/LabelFile.h>

#include <osgLabels/CsvRecords.h>
#include <osgLabels/TextFile.h>

#include <nlohmann/json.hpp>

#include <osgDB/FileNameUtils>
#include <osgDB/fstream>

#include <algorithm>
#include <cctype>
#include <vector>

namespace osgLabels
{

namespace
{

std::string lowered(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Adds entries, and keeps the first error as "<file>:<line>: <cause>".
struct Entries
{
    const std::string& path;
    TextByName texts;
    std::string error;

    void fail(std::size_t line, const std::string& cause)
    {
        if (error.empty())
            error = path + (line ? ":" + std::to_string(line) : std::string()) + ": " + cause;
    }
    void add(const std::string& name, const TableLabel& label, std::size_t line)
    {
        if (name.empty())
            fail(line, "the name is empty; give it one or take the line out");
        const auto [found, isNew] = texts.emplace(name, label);
        if (isNew || found->second == label)
            return;
        const bool isText = found->second.text != label.text;
        fail(line, "'" + name + "' has the " + (isText ? "text '" : "style '") +
                       (isText ? found->second.text : found->second.style) +
                       "' already; keep one of them");
    }
};

void readTable(const std::string& content, Entries& entries)
{
    bool isFirst = true;
    std::size_t columns = 2; // 3 with styles
    const auto take = [&](CsvRecord& record)
    {
        const std::vector<std::string>& fields = record.fields;
        const bool isHeading = isFirst && fields.size() >= 2 && lowered(fields[0]) == "name" &&
                               (lowered(fields[1]) == "text" || lowered(fields[1]) == "label");
        isFirst = false;
        if (isHeading && fields.size() == 3 && lowered(fields[2]) == "style")
            columns = 3;
        if (fields.size() != columns)
            entries.fail(record.line,
                         (columns == 2 ? "a line has two columns, name and text, this one has "
                                       : "a line has three columns, name, text and style, this one "
                                         "has ") +
                             std::to_string(fields.size()) + csvColumnRemedy(fields));
        else if (!isHeading)
            entries.add(fields[0], {fields[1], columns == 3 ? fields[2] : std::string()},
                        record.line);
        return entries.error.empty();
    };
    readCsv(content, take,
            [&](std::size_t line, const std::string& cause)
            {
                entries.fail(line, cause);
                return false;
            });
}

using Json = nlohmann::json;

/// False for what is no text.
bool textOf(const Json& value, std::string& text)
{
    if (value.is_string())
        text = value.get<std::string>();
    else if (value.is_number() || value.is_boolean())
        text = value.dump();
    else if (value.is_null())
        text.clear();
    else
        return false;
    return true;
}

void addList(const Json& list, Entries& entries)
{
    std::size_t index = 0;
    for (const Json& item : list)
    {
        std::string name;
        TableLabel label;
        if (!item.is_object() || !item.count("name") || !item.count("text") ||
            !textOf(item["name"], name) || !textOf(item["text"], label.text))
            entries.fail(0, "entry " + std::to_string(index) +
                                " of the list is no {\"name\": …, \"text\": …} of two strings");
        else if (item.count("style") && !textOf(item["style"], label.style))
            entries.fail(0,
                         "the style of '" + name + "' is a list or an object; it must be a string");
        entries.add(name, label, 0);
        ++index;
    }
}

void readJson(const std::string& content, Entries& entries)
{
    try
    {
        const Json root = Json::parse(content);
        if (root.is_array())
            return addList(root, entries);
        if (!root.is_object())
            return entries.fail(0, "neither an object {\"name\": \"text\"} nor a list of "
                                   "{\"name\": …, \"text\": …}");
        for (const auto& [name, value] : root.items())
        {
            std::string text;
            if (!textOf(value, text))
                entries.fail(0, "the text of '" + name +
                                    "' is a list or an object; it must be a string");
            entries.add(name, {text, {}}, 0);
        }
    }
    catch (const Json::parse_error& error)
    {
        const std::size_t at = std::min(error.byte, content.size());
        const auto lines =
            std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        const std::string what = error.what();
        const std::size_t cause = what.find(": ");
        entries.fail(static_cast<std::size_t>(lines) + 1,
                     "no JSON: " + what.substr(cause == std::string::npos ? 0 : cause + 2));
    }
}

} // namespace

bool readLabelFile(const std::string& path, TextByName& texts, std::string& error)
{
    const std::string extension = osgDB::getLowerCaseFileExtension(path);
    Entries entries{path, {}, {}};
    osgDB::ifstream file(path.c_str(), std::ios::binary);
    std::string content;
    if (const std::string cause = readTextFile(file, content); !cause.empty())
        entries.fail(0, cause);
    else if (extension == "csv")
        readTable(content, entries);
    else if (extension == "json")
        readJson(content, entries);
    else
        entries.fail(0, "a table of labels is a .csv or a .json file");
    error = entries.error;
    if (!error.empty())
        return false;
    texts = std::move(entries.texts);
    return true;
}

} // namespace osgLabels
