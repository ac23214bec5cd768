// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstdint>

namespace osgPagedTexture
{

/// How many bytes may go to the GPU now, so that a frame's uploads stay within their time. What the
/// last pieces took decides how large the next ones are; the first one is the smallest. Pieces that
/// turn out smaller than LeastPiece say what a call takes, not what its bytes do.
class OSGPAGEDTEXTURE_EXPORT UploadPace
{
public:
    /// Bytes; each piece has a cost of its own.
    static constexpr std::uint64_t LeastPiece = 16 << 10;
    /// So that one which meets pages that were never touched, or a busy driver, is soon over.
    static constexpr std::uint64_t LargestPiece = 256 << 10;

    /// Begins a frame that may take that many milliseconds.
    void begin(double milliseconds);

    /// Somebody else uploads in the same frame, which may take that many milliseconds in all.
    /// That one's first piece is granted, too.
    void widen(double milliseconds);

    /// Bytes of the next piece; 0: the frame has no time left. The first piece of a frame is at
    /// least LeastPiece, so that it goes on however short the time is.
    std::uint64_t piece() const;

    /// A piece took that long; 0 bytes: what else the frame's uploads did. Times that are not
    /// finite or not above 0 count as no time.
    void took(std::uint64_t bytes, double milliseconds);

    double getSpent() const { return _spent; } ///< Milliseconds in this frame.
    double getRate() const { return _rate; }   ///< Bytes a millisecond; 0: not measured yet.

private:
    double _rate = 0.0;
    double _call = 0.0; ///< Milliseconds of a piece of hardly any bytes.
    double _budget = 0.0;
    double _spent = 0.0;
    bool _isFirst = true;
};

} // namespace osgPagedTexture
