// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/MapLabel.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace osgLabels
{

/// Reads map labels from a table: RFC 4180, UTF-8, decimal points whatever the locale.
///
/// Columns are x, y, z, text, priority, style, feature; the last three may be missing or empty, and
/// further ones are ignored. A first line that names x, y, z and text is a heading and may put the
/// columns in another order. A line that is wrong is left out with one warning, "<file>:<line>:
/// cause; remedy", after 20 of them one that counts the rest; `file` is only named.
OSGLABELS_EXPORT std::vector<MapLabel> readMapLabels(std::istream& in, const std::string& file,
                                                     std::vector<std::string>& warnings);

} // namespace osgLabels
