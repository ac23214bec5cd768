// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace support
{

/// Files of some kinds (".frag") in a folder and all below it, in order; none where it is not
/// there.
inline std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& kinds)
{
    std::vector<std::filesystem::path> files;
    std::error_code error;
    std::filesystem::recursive_directory_iterator entry(folder, error), end;
    for (; !error && entry != end; entry.increment(error))
        if (std::count(kinds.begin(), kinds.end(), entry->path().extension().string()) > 0)
            files.push_back(entry->path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace support
