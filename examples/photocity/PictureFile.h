// SPDX-License-Identifier: MIT
#pragma once

#include "Picture.h"
#include "Sources.h"

#include <string>
#include <vector>

/// A picture as JPEG. Most are baseline with halved chroma, some full, some progressive.
/// `everyRows`: paints 32 rows of so many only, to see how many bytes a pixel has; 1 for all.
/// Throws std::runtime_error.
std::vector<std::uint8_t> encodeJpeg(const Picture& picture, const std::vector<Source>& sources,
                                     int quality, int everyRows = 1);

/// Writes a fence, a tree or a normal map as PNG. Throws std::runtime_error.
void writePng(const Picture& picture, const std::vector<Source>& sources, const std::string& file);
