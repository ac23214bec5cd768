// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

/// What a picture is of, which decides how it is painted and written.
enum class PictureUse
{
    Facade,
    Roof,
    Ground,
    Street,
    Fence,    ///< PNG with alpha.
    Tree,     ///< PNG with alpha.
    NormalMap ///< PNG.
};

/// A picture file that the model names.
struct Picture
{
    std::string file; ///< As the model names it: relative, with slashes.
    PictureUse use = PictureUse::Facade;
    double width = 1.0, height = 1.0; ///< Metres that one copy of it covers.
    bool grey = false;
    std::uint32_t seed = 1;
    int columns = 0, rows = 0; ///< Pixels.

    bool isJpeg() const { return use < PictureUse::Fence; }
    double getPixels() const { return double(columns) * rows; }
};
