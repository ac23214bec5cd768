// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MaskMargin.h>

#include <algorithm>
#include <limits>

namespace osgPagedTexture
{

namespace
{

/// Rows of bytes that are `stride` apart, from one edge to the other: a column of a picture is a
/// line too. Several lines side by side are done at once, which is what keeps columns fast.
class Lines
{
public:
    Lines(std::size_t count, std::size_t length, std::size_t step, std::size_t stride)
        : _length(length), _step(step), _stride(stride), _since(count)
    {
    }

    void grow(std::uint8_t* bytes, std::int64_t margin, bool repeats)
    {
        // Each sweep marks what lies at most the margin behind a used pixel, against the sweep's
        // direction used pixels are those of the mask as it was: 255; what is added is 1.
        sweep(bytes, margin, repeats, false);
        sweep(bytes, margin, repeats, true);
    }

private:
    void sweep(std::uint8_t* bytes, std::int64_t margin, bool repeats, bool backwards)
    {
        constexpr std::int64_t Never = std::numeric_limits<std::int64_t>::max() / 2;
        std::fill(_since.begin(), _since.end(), Never);
        // The second turn knows what the end of the line reaches over the edge.
        for (int turn = repeats ? 0 : 1; turn < 2; ++turn)
        {
            for (std::size_t i = 0; i < _length; ++i)
            {
                std::uint8_t* row = bytes + (backwards ? _length - 1 - i : i) * _step;
                for (std::size_t line = 0; line < _since.size(); ++line)
                {
                    std::uint8_t& pixel = row[line * _stride];
                    std::int64_t& since = _since[line];
                    since = pixel == 255 ? 0 : since + 1;
                    if (pixel == 0 && since <= margin)
                        pixel = 1;
                }
            }
        }
    }

    const std::size_t _length, _step, _stride;
    std::vector<std::int64_t> _since;
};

void whiten(std::uint8_t* bytes, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i)
        if (bytes[i] != 0)
            bytes[i] = 255;
}

} // namespace

void growMask(Pixels& mask, int margin, bool repeatsX, bool repeatsY)
{
    if (margin <= 0 || mask.empty())
        return;
    const auto width = std::size_t(mask.width), height = std::size_t(mask.height);
    Lines row(1, width, 1, 1);
    for (std::size_t y = 0; y < height; ++y)
    {
        row.grow(mask.bytes.data() + y * width, margin, repeatsX);
        whiten(mask.bytes.data() + y * width, width);
    }
    Lines columns(width, height, width, 1);
    columns.grow(mask.bytes.data(), margin, repeatsY);
    whiten(mask.bytes.data(), mask.bytes.size());
}

} // namespace osgPagedTexture
