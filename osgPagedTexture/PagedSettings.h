// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockEncoder.h>

#include <cstdint>
#include <string>

namespace osgPagedTexture
{

/// How texels are kept in memory of the GPU.
enum class Compression
{
    Blocks, ///< BC1, BC3, BC4, BC5, where GL has them.
    Best,   ///< BC7 for colour where GL has it.
    None
};

/// What is drawn of the textures.
enum class PagedShow
{
    Picture,
    Levels ///< A colour for each resident level: white is the finest one.
};

/// All knobs of a PagedScene.
struct PagedSettings
{
    double gpuMegabytes = 256.0;     ///< Of texels in each context.
    double cpuMegabytes = 256.0;     ///< Of pictures and chains on their way.
    double uploadMilliseconds = 2.0; ///< Of a frame, CPU time of the draw thread.
    unsigned int previewSide = 32;   ///< Texels of what is shown first.
    double prefetchSeconds = 1.0;    ///< How far the motion of the eye is looked ahead.
    unsigned int threads = 0;        ///< Of workers; 0: one less than the machine has.
    Compression compression = Compression::Blocks;
    EncodeQuality quality = EncodeQuality::Normal;
    std::string cache = "default"; ///< Folder, "default" for the user's, "off".
    double cacheMegabytes = 4096.0;
    bool wait = false;     ///< Frames wait for what they need: for pictures, not for moving about.
    bool reload = true;    ///< Files that have changed are read again.
    bool degraded = false; ///< What can be read of damaged files is shown.
    bool freeze = false;   ///< Nothing comes and nothing goes.
    PagedShow show = PagedShow::Picture;
    bool graph = false; ///< Of uploads and memory, over the picture.
    bool keys = true;

    std::uint64_t gpuBytes() const { return std::uint64_t(gpuMegabytes * 1048576.0); }
    std::uint64_t cpuBytes() const { return std::uint64_t(cpuMegabytes * 1048576.0); }
};

} // namespace osgPagedTexture
