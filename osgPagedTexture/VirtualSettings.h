// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/BlockEncoder.h>
#include <osgPagedTexture/PagedSettings.h>

#include <cstdint>
#include <string>

namespace osgPagedTexture
{

/// What is drawn of virtual textures.
enum class VirtualShow
{
    Picture,
    Levels, ///< A colour for the level that each pixel has: white is the finest one.
    Pages   ///< Borders of pages over the picture, in the colours of their levels.
};

/// All knobs of a VirtualScene.
struct VirtualSettings
{
    std::string store;               ///< Of all textures in unit 0; "": each one's own.
    double gpuMegabytes = 128.0;     ///< Of pages in each context.
    double cpuMegabytes = 256.0;     ///< Of pages in memory.
    double uploadMilliseconds = 2.0; ///< Of a frame, CPU time of the draw thread.
    unsigned int threads = 0;        ///< Of workers; 0: one less than the machine has.
    Compression compression = Compression::Blocks;
    EncodeQuality quality = EncodeQuality::Normal;
    unsigned int anisotropy = 0; ///< Taps along a footprint; 0: as each texture says, 16 at most.
    unsigned int feedback = 8;   ///< Pixels of a side that one pixel of the feedback stands for.
    double fadeSeconds = 0.25;   ///< In which a new page fades in.
    bool wait = false;           ///< Frames wait for their pages: for pictures.
    bool watch = true;           ///< Stores that change are read again.
    bool freeze = false;         ///< No page comes or goes.
    VirtualShow show = VirtualShow::Picture;
    bool graph = false; ///< Statistics, said once a second.
    bool keys = true;

    std::uint64_t gpuBytes() const { return std::uint64_t(gpuMegabytes * 1048576.0); }
    std::uint64_t cpuBytes() const { return std::uint64_t(cpuMegabytes * 1048576.0); }
};

} // namespace osgPagedTexture
