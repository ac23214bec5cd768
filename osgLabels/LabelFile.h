// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <string>
#include <unordered_map>

namespace osgLabels
{

/// What a table has for an object.
struct TableLabel
{
    std::string text;
    std::string style; ///< Name of a LabelStyle; empty where the table says none.

    bool operator==(const TableLabel& other) const
    {
        return text == other.text && style == other.style;
    }
};

/// By the object's name.
using TextByName = std::unordered_map<std::string, TableLabel>;

/// Reads a table of texts, UTF-8.
///
/// `.csv`: RFC 4180, two columns, name and text; a first line "name,text" is a heading. Below the
/// heading "name,text,style" each line has a third column, the name of a style. `.json`: an
/// object {"name": "text"}, or a list of objects with "name", "text" and, where wanted, "style";
/// numbers and truth values are texts as they are written, null is no text. A name that is there
/// twice must have the same text and style. False with one line in `error`, naming file and line,
/// cause and remedy, and `texts` untouched.
OSGLABELS_EXPORT bool readLabelFile(const std::string& path, TextByName& texts, std::string& error);

} // namespace osgLabels
