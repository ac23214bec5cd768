// SPDX-License-Identifier: MIT
// Rows of the tables of this kit's settings. Not installed.
#pragma once

#include <osgPagedTexture/BlockEncoder.h>
#include <osgPagedTexture/PagedSettings.h>

#include <osgMultiRender/OptionText.h>

#include <vector>

namespace osgPagedTexture
{

using osgMultiRender::choice;
using osgMultiRender::flag;
using osgMultiRender::number;

template <class Settings> osgMultiRender::Option<Settings> threadsOption()
{
    return number("threads", &Settings::threads, 0u, 256u,
                  "Threads that read and encode; 0: one less than the machine has");
}

template <class Settings> osgMultiRender::Option<Settings> compressionOption(const char* help)
{
    return choice<Compression>(
        "compression", &Settings::compression,
        {{"blocks", Compression::Blocks}, {"best", Compression::Best}, {"none", Compression::None}},
        help);
}

template <class Settings> osgMultiRender::Option<Settings> qualityOption()
{
    return choice<EncodeQuality>("quality", &Settings::quality,
                                 {{"fast", EncodeQuality::Fast},
                                  {"normal", EncodeQuality::Normal},
                                  {"fine", EncodeQuality::Fine},
                                  {"best", EncodeQuality::Best}},
                                 "How much time compression takes for a better picture");
}

} // namespace osgPagedTexture
