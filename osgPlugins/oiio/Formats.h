// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

namespace osgKitsOiio
{

/// OpenImageIO's name of a format by lower case extension without its dot, e.g. jp2 -> jpeg2000.
using ExtensionMap = std::map<std::string, std::string>;

/// The extensions of the formats that the installed OpenImageIO reads.
/// Its test formats, which read any name as a picture, are left out.
ExtensionMap readableExtensions();

/// The same, of one extension; empty when OpenImageIO was built without it.
ExtensionMap readableExtensions(const std::string& extension);

/// The usual extension of a format, e.g. jpeg2000 -> jp2; the name itself where it is unknown.
std::string usualExtension(const std::string& format);

/// Whether OpenImageIO writes this format (its own name of it).
bool isWritable(const std::string& format);

/// The formats that a stream can be tried for, those that are told by their first bytes first.
std::vector<std::string> formatsReadFromMemory();

} // namespace osgKitsOiio
