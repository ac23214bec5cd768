// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace osgLabels
{

/// Fields of a line of a table, or of several where a quoted field has line ends.
struct CsvRecord
{
    std::vector<std::string> fields;
    std::size_t line = 0; ///< On which it starts, from 1.
};

/// Reads RFC 4180, with line ends of any kind; spaces are part of a field, empty lines are none.
/// `take` gets each record, `fail` the line and cause of what is no record; either returns
/// whether to go on. After a misplaced quote the next line is read anew; what follows a quote that
/// is never closed belongs to it and is lost.
void readCsv(const std::string& content, const std::function<bool(CsvRecord& record)>& take,
             const std::function<bool(std::size_t line, const std::string& cause)>& fail);

/// What a line with `fields` may have done wrong where more or fewer are expected: a remedy that
/// begins with "; ".
std::string csvColumnRemedy(const std::vector<std::string>& fields);

/// A field as a message of one line quotes it: 'text', its line ends as spaces, its end left out
/// where it is long.
std::string quotedCsvField(const std::string& field);

} // namespace osgLabels
