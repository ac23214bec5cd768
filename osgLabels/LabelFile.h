// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <string>
#include <unordered_map>

namespace osgLabels
{

/// Name of an object → its text.
using TextByName = std::unordered_map<std::string, std::string>;

/// Reads a table of texts, UTF-8.
///
/// `.csv`: RFC 4180, two columns, name and text; a first line "name,text" is a heading. `.json`: an
/// object {"name": "text"}, or a list of objects with "name" and "text"; numbers and truth values
/// are texts as they are written, null is no text. A name that is there twice must have the same
/// text. False with one line in `error`, naming file and line, cause and remedy, and `texts`
/// untouched.
OSGLABELS_EXPORT bool readLabelFile(const std::string& path, TextByName& texts, std::string& error);

} // namespace osgLabels
