// SPDX-License-Identifier: MIT
#pragma once

#include "Report.h"

#include <string>
#include <vector>

namespace osgrender
{

/// One render in the page.
struct GalleryEntry
{
    std::string title;
    std::string place;   ///< Where the script has it.
    std::string picture; ///< File that a browser shows; empty: none was written.
    std::string error;   ///< Empty unless it failed.
    Report report;
};

/// Writes an HTML page with each picture, its times and its plan beside it. The page needs no
/// script and names the pictures relative to itself.
bool writeGalleryPage(const std::string& file, const std::vector<GalleryEntry>& entries,
                      std::string& error);

} // namespace osgrender
