// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// A photograph that others are cut from, 0xXXBBGGRR a pixel, from the top.
struct Source
{
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;
};

/// Photographs of a folder and those below it, JPEG before other formats, reduced to at most 2560
/// pixels a side. Which ones depends on the seed where there are more than `most`. Throws
/// std::runtime_error for a folder that cannot be read.
std::vector<Source> readSources(const std::vector<std::string>& folders, unsigned int most,
                                std::uint32_t seed);

/// Where distributions put background pictures; those folders that exist.
std::vector<std::string> systemPhotoFolders();

/// Pictures that need no photograph: stone, plaster, grass by fractal noise.
std::vector<Source> makeSources(std::uint32_t seed);
