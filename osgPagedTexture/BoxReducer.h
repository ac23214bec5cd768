// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace osgPagedTexture
{

/// Makes a picture smaller while its rows come in, so that the whole is never held: each texel is
/// the mean over its area, colours weighted by alpha.
class OSGPAGEDTEXTURE_EXPORT BoxReducer
{
public:
    struct Shape
    {
        int width = 0; ///< Pixels of a row that comes in.
        int channels = 0;
        double extentX = 0.0; ///< Columns that are spread over all texels, at most width.
        double extentY = 0.0; ///< Rows likewise; later rows count for nothing.
        int targetWidth = 0;
        int targetHeight = 0;
        bool linearLight = true; ///< Averages light, not sRGB code values.
    };
    /// `sink` gets each finished row with its index, from 0 on.
    using Sink = std::function<void(const std::uint8_t* row, int y)>;
    BoxReducer(const Shape& shape, Sink sink);

    void add(const std::uint8_t* row);

private:
    void reduceRow(const std::uint8_t* row);
    void finishTexelRow();

    struct Span
    {
        int first;
        std::vector<float> weights; ///< Add up to 1.
    };
    Shape _shape;
    Sink _sink;
    bool _alpha;
    std::vector<Span> _spans;
    std::vector<float> _line, _row, _sum; ///< Source row, the same at target width, their sum.
    std::vector<std::uint8_t> _finished;
    int _rowsAdded = 0;
    int _texelRow = 0;
};

} // namespace osgPagedTexture
