// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/JpegDecoder.h>
#include <osgPagedTexture/TileGrid.h>

#include <memory>
#include <string>

namespace osgPagedTexture
{

/// Cuts JPEG files out of one without decoding and encoding it again: the blocks of coefficients
/// are copied, so that nothing is lost. Holds the coefficients of the whole picture. Any thread.
class JpegCutter
{
public:
    /// `decoder` has read its header, and becomes ready to give rows as start() makes it: file and
    /// blocks are gone through once for both. Null where the picture is of a kind that cannot be
    /// cut, and `decoder` is as before. Throws ImageError.
    static std::shared_ptr<JpegCutter> open(std::shared_ptr<JpegDecoder> decoder,
                                            const std::string& name);

    /// Whether this part of the picture begins and ends between blocks.
    bool canCut(const PixelRect& part) const;
    /// The part as a JPEG file. Throws TileStoreError.
    std::string cut(const PixelRect& part) const;

private:
    JpegCutter(std::shared_ptr<JpegDecoder> decoder, jvirt_barray_ptr* coefficients)
        : _decoder(std::move(decoder)), _coefficients(coefficients)
    {
    }
    const std::shared_ptr<JpegDecoder> _decoder;
    jvirt_barray_ptr* const _coefficients;
};

} // namespace osgPagedTexture
