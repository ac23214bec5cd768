// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ChainLoader.h>

#include <cstddef>
#include <cstdint>

namespace osgPagedTexture
{

/// Of the uploads of a context.
struct UploadStatistics
{
    std::uint64_t bytes = 0; ///< On the GPU now, of all textures, those in the making too.
    std::uint64_t peakBytes = 0;
    std::uint64_t uploaded = 0;     ///< So far.
    std::uint64_t lastUploaded = 0; ///< In the last frame.
    double lastMilliseconds = 0.0;  ///< CPU time of the last frame's uploads.
    std::size_t madeAside = 0;      ///< Textures whose memory was made outside of the frame.
    std::size_t waiting = 0;        ///< Jobs.
    std::uint64_t waitingBytes = 0; ///< Of their chains.
};

/// Of a PagedScene.
struct PagerStatistics
{
    std::size_t textures = 0;
    std::size_t inView = 0;
    std::size_t resident = 0; ///< In the first context.
    std::size_t failed = 0;
    std::size_t considered = 0; ///< In the last frame: in view, about to be, there, on their way.
    std::size_t changing = 0;   ///< That are not what they should be.
    bool isWhole = false;       ///< All fit at full size, nothing is paged.
    double bias = 0.0;          ///< See ResidencyPlan.
    double neededTexels = 0.0;  ///< That what was in view in the last frame uses.
    double missingTexels = 0.0; ///< Of them, those that are not there.
    std::uint64_t plannedBytes = 0;
    std::uint64_t wholeBytes = 0; ///< Of all of them at full size.
    double planMilliseconds = 0.0;
    double prefetchMilliseconds = 0.0; ///< Of the last view that looked ahead.
    UploadStatistics upload;           ///< Of the context that has most.
    ChainLoader::Statistics loader;
};

} // namespace osgPagedTexture
