// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ExifOrientation.h>

#include <cstring>

namespace osgPagedTexture
{

namespace
{

/// Numbers of a TIFF header; bytes past the end count as 0.
struct TiffBytes
{
    const std::string& text;
    std::size_t start;
    bool bigEndian;

    std::uint32_t get(std::size_t at, int count) const
    {
        std::uint32_t value = 0;
        for (int i = 0; i < count; ++i)
        {
            const std::size_t from = start + at + (bigEndian ? i : count - 1 - i);
            value = value << 8 | (from < text.size() ? static_cast<unsigned char>(text[from]) : 0);
        }
        return value;
    }
};

} // namespace

int exifOrientation(const std::string& segment)
{
    constexpr std::size_t head = 6;
    if (segment.size() < head + 8 || segment.compare(0, head, std::string("Exif\0\0", head)) != 0)
    {
        return 1;
    }
    const TiffBytes bytes{segment, head, segment[head] == 'M'};
    const std::size_t directory = bytes.get(4, 4);
    if (directory > segment.size())
    {
        return 1;
    }
    constexpr std::uint32_t orientationTag = 0x0112;
    constexpr std::uint32_t shortType = 3;
    const std::uint32_t entries = bytes.get(directory, 2);
    for (std::uint32_t i = 0; i < entries; ++i)
    {
        const std::size_t entry = directory + 2 + 12 * std::size_t(i);
        if (head + entry + 12 > segment.size())
        {
            break;
        }
        if (bytes.get(entry, 2) == orientationTag && bytes.get(entry + 2, 2) == shortType)
        {
            const std::uint32_t value = bytes.get(entry + 8, 2);
            return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
        }
    }
    return 1;
}

Placement placementOf(int storedWidth, int storedHeight, int orientation)
{
    // EXIF 2.3, tag 0x0112: stored columns run along the shown x, or y where transposed, and are
    // mirrored where it says so; likewise the rows.
    const bool columnsMirrored =
        orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool rowsMirrored =
        orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    Placement placement;
    placement.width = isTransposed(orientation) ? storedHeight : storedWidth;
    placement.height = isTransposed(orientation) ? storedWidth : storedHeight;
    const std::ptrdiff_t down = -static_cast<std::ptrdiff_t>(placement.width);
    placement.offset = -down * (placement.height - 1);
    placement.pixelStep = isTransposed(orientation) ? down : 1;
    placement.rowStep = isTransposed(orientation) ? 1 : down;
    if (columnsMirrored)
    {
        placement.offset += placement.pixelStep * (storedWidth - 1);
        placement.pixelStep = -placement.pixelStep;
    }
    if (rowsMirrored)
    {
        placement.offset += placement.rowStep * (storedHeight - 1);
        placement.rowStep = -placement.rowStep;
    }
    return placement;
}

void placeRow(const std::uint8_t* row, int storedWidth, int y, const Placement& placement,
              Pixels& pixels)
{
    const int channels = pixels.channels;
    std::uint8_t* target =
        pixels.bytes.data() + (placement.offset + placement.rowStep * y) * channels;
    if (placement.pixelStep == 1)
    {
        std::memcpy(target, row, std::size_t(storedWidth) * channels);
        return;
    }
    const std::ptrdiff_t step = placement.pixelStep * channels;
    for (int x = 0; x < storedWidth; ++x, row += channels)
    {
        std::memcpy(target + step * x, row, channels);
    }
}

} // namespace osgPagedTexture
