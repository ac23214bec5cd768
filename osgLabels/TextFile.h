// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>

namespace osgLabels
{

/// Reads all of a stream, UTF-8, without its byte order mark. Returns what is wrong, to follow the
/// file's name, or an empty text.
std::string readTextFile(std::istream& in, std::string& content);

} // namespace osgLabels
