// SPDX-License-Identifier: MIT
#pragma once

#include "Arguments.h"

#include <osgPagedTexture/TilePack.h>

namespace tilestore
{

/// What --wait and --no-sync say.
inline osgPagedTexture::TilePackWriter::Options packOptionsOf(const Arguments& arguments)
{
    osgPagedTexture::TilePackWriter::Options options;
    options.waitSeconds = double(arguments.number("--wait", 0, 0, 86400));
    options.durable = !arguments.has("--no-sync");
    return options;
}

} // namespace tilestore
