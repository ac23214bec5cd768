// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// A picture in memory, 8 bits a channel, rows packed without padding. Row 0 is the bottom (t = 0),
/// as in osg::Image: readers turn files that store the top row first.
struct Pixels
{
    int width = 0;
    int height = 0;
    int channels =
        0; ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; colours as sRGB, alpha not multiplied in.
    std::vector<std::uint8_t> bytes; ///< width * height * channels.

    Pixels() = default;
    Pixels(int newWidth, int newHeight, int newChannels)
        : width(newWidth), height(newHeight), channels(newChannels),
          bytes(std::size_t(newWidth) * newHeight * newChannels)
    {
    }

    bool empty() const { return bytes.empty(); }
    bool hasAlpha() const { return channels == 2 || channels == 4; }
    const std::uint8_t* row(int y) const
    {
        return bytes.data() + std::size_t(y) * width * channels;
    }
    std::uint8_t* row(int y) { return bytes.data() + std::size_t(y) * width * channels; }
};

} // namespace osgPagedTexture
