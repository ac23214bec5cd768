// SPDX-License-Identifier: MIT
#include <osgLabels/LabelFile.h>

#include <csv.h>
#include <nlohmann/json.hpp>

#include <osgDB/FileNameUtils>
#include <osgDB/fstream>

#include <algorithm>
#include <cctype>
#include <iterator>
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

/// Fields of one record at a time, as libcsv reports them.
struct CsvReader
{
    Entries& entries;
    std::vector<std::string> fields;
    std::size_t line = 0; ///< On which the record starts.
    bool isFirst = true;
    std::size_t columns = 2; ///< 3 with styles.

    static void field(void* data, std::size_t size, void* self)
    {
        static_cast<CsvReader*>(self)->fields.emplace_back(static_cast<const char*>(data), size);
    }
    static void record(int, void* self) { static_cast<CsvReader*>(self)->endRecord(); }

    void endRecord()
    {
        const bool isHeading = isFirst && fields.size() >= 2 && lowered(fields[0]) == "name" &&
                               (lowered(fields[1]) == "text" || lowered(fields[1]) == "label");
        isFirst = false;
        if (isHeading && fields.size() == 3 && lowered(fields[2]) == "style")
            columns = 3;
        if (fields.size() != columns)
        {
            const bool isOther =
                fields.size() == 1 && fields[0].find_first_of(";\t") != std::string::npos;
            entries.fail(line,
                         (columns == 2 ? "a line has two columns, name and text, this one has "
                                       : "a line has three columns, name, text and style, this one "
                                         "has ") +
                             std::to_string(fields.size()) +
                             (isOther ? "; separate them by a comma"
                                      : "; quote a text that has a comma: \"a,b\""));
        }
        else if (!isHeading)
            entries.add(fields[0], {fields[1], columns == 3 ? fields[2] : std::string()}, line);
        fields.clear();
        line = 0;
    }
};

void readCsv(const std::string& content, Entries& entries)
{
    csv_parser parser;
    csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI);
    csv_set_space_func(&parser, [](unsigned char) { return 0; }); // spaces are part of a field
    CsvReader reader{entries, {}};
    std::size_t line = 1;
    // Line by line, so that the number of each is known.
    for (std::size_t at = 0; at < content.size() && entries.error.empty(); ++line)
    {
        const std::size_t end = std::min(content.find('\n', at), content.size() - 1) + 1;
        if (!reader.line && content.find_first_not_of("\r\n", at) < end)
            reader.line = line;
        if (csv_parse(&parser, content.data() + at, end - at, CsvReader::field, CsvReader::record,
                      &reader) != end - at)
            entries.fail(line, "a quote inside of a field; double it, and quote the field: "
                               "\"say \"\"so\"\"\"");
        at = end;
    }
    if (entries.error.empty() && csv_fini(&parser, CsvReader::field, CsvReader::record, &reader))
        entries.fail(reader.line, "a quote is opened and never closed; close it");
    csv_free(&parser);
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
    const std::string content{std::istreambuf_iterator<char>(file),
                              std::istreambuf_iterator<char>()};
    // A folder opens, too, and then reads nothing and is bad.
    if (!file.is_open() || file.bad())
        entries.fail(0, "cannot be read; does it exist?");
    else if (content.compare(0, 2, "\xff\xfe") == 0 || content.compare(0, 2, "\xfe\xff") == 0)
        entries.fail(0, "is UTF-16; save it as UTF-8");
    else if (const std::size_t mark = content.compare(0, 3, "\xef\xbb\xbf") == 0 ? 3 : 0;
             extension == "csv")
        readCsv(content.substr(mark), entries);
    else if (extension == "json")
        readJson(content.substr(mark), entries);
    else
        entries.fail(0, "a table of labels is a .csv or a .json file");
    error = entries.error;
    if (!error.empty())
        return false;
    texts = std::move(entries.texts);
    return true;
}

} // namespace osgLabels
