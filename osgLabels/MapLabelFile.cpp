// SPDX-License-Identifier: MIT
#include <osgLabels/MapLabelFile.h>

#include <osgLabels/CsvRecords.h>
#include <osgLabels/TextFile.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace osgLabels
{

namespace
{

constexpr std::size_t MostWarnings = 20;

enum Column
{
    X,
    Y,
    Z,
    Text,
    Priority,
    Style,
    Feature,
    ColumnCount
};

constexpr std::array<const char*, ColumnCount> Names = {"x",        "y",     "z",      "text",
                                                        "priority", "style", "feature"};

std::string trimmed(const std::string& text)
{
    const std::size_t first = text.find_first_not_of(" \t");
    return first == std::string::npos
               ? std::string()
               : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A name as headings may write it.
std::string plain(const std::string& text)
{
    std::string result = trimmed(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// What is wrong, or an empty text. The locale has no say in std::from_chars.
std::string readNumber(const std::string& column, const std::string& field, double& value)
{
    const std::string text = trimmed(field);
    const char* first = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-');
    const char* const last = text.data() + text.size();
    const auto [end, failure] = std::from_chars(first, last, value);
    const std::string what = column + " is " + quotedCsvField(text);
    if (failure == std::errc::result_out_of_range && end == last)
        return what + ", beyond what a double holds; scale it";
    if (failure != std::errc() || end != last)
    {
        const bool hasComma = text.find(',') != std::string::npos;
        return what + ", which is no number" + (hasComma ? "; write a decimal point" : "");
    }
    if (!std::isfinite(value))
        return what + "; it must be finite";
    return {};
}

/// Labels out of the records of a file.
class Table
{
public:
    Table(const std::string& file, std::vector<std::string>& warnings)
        : _file(file), _warnings(warnings)
    {
        for (std::size_t i = 0; i < _places.size(); ++i)
            _places[i] = i;
    }

    void add(CsvRecord& record)
    {
        const bool isHeading = _isFirst && readHeading(record.fields);
        _isFirst = false;
        if (isHeading)
            return;
        const std::size_t needed =
            1 + *std::max_element(_places.begin(), _places.begin() + Priority);
        if (record.fields.size() < needed)
            return warn(record.line, "a label needs " + std::to_string(needed) +
                                         " columns, x, y, z and text, this line has " +
                                         std::to_string(record.fields.size()) +
                                         csvColumnRemedy(record.fields));
        MapLabel label;
        std::string fault;
        for (int axis = 0; axis < 3 && fault.empty(); ++axis)
            fault = readNumber(Names[axis], record.fields[_places[axis]], label.anchor[axis]);
        const std::string priority = take(record, Priority);
        if (fault.empty() && !trimmed(priority).empty())
            fault = readNumber(Names[Priority], priority, label.priority);
        if (!fault.empty())
            return warn(record.line, fault);
        label.text = take(record, Text);
        label.style = trimmed(take(record, Style));
        label.feature = take(record, Feature);
        labels.push_back(std::move(label));
    }

    void warn(std::size_t line, const std::string& cause)
    {
        if (++_wrong <= MostWarnings)
            _warnings.push_back(_file + (line ? ":" + std::to_string(line) : std::string()) + ": " +
                                cause);
    }

    void finish()
    {
        if (_wrong > MostWarnings)
            _warnings.push_back(_file + ": " + std::to_string(_wrong - MostWarnings) +
                                " more lines are wrong");
    }

    std::vector<MapLabel> labels;

private:
    /// False, and columns stay where they are, for a line that does not name them all.
    bool readHeading(const std::vector<std::string>& fields)
    {
        std::array<std::size_t, ColumnCount> places;
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            const auto found =
                std::find_if(fields.begin(), fields.end(),
                             [&](const std::string& field) { return plain(field) == Names[i]; });
            if (found == fields.end() && i < Priority)
                return false;
            places[i] =
                found == fields.end() ? std::string::npos : std::size_t(found - fields.begin());
        }
        _places = places;
        return true;
    }

    std::string take(CsvRecord& record, Column column)
    {
        const std::size_t place = _places[column];
        return place < record.fields.size() ? std::move(record.fields[place]) : std::string();
    }

    const std::string& _file;
    std::vector<std::string>& _warnings;
    std::array<std::size_t, ColumnCount> _places;
    std::size_t _wrong = 0;
    bool _isFirst = true;
};

} // namespace

std::vector<MapLabel> readMapLabels(std::istream& in, const std::string& file,
                                    std::vector<std::string>& warnings)
{
    Table table(file, warnings);
    std::string content;
    if (const std::string fault = readTextFile(in, content); !fault.empty())
        table.warn(0, fault);
    else
        readCsv(
            content,
            [&](CsvRecord& record)
            {
                table.add(record);
                return true;
            },
            [&](std::size_t line, const std::string& cause)
            {
                table.warn(line, cause);
                return true;
            });
    table.finish();
    return std::move(table.labels);
}

} // namespace osgLabels
