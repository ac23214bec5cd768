// SPDX-License-Identifier: MIT
#pragma once

#include "Subcommand.h"

#include <osgPagedTexture/TileBuilder.h>

#include <string>
#include <vector>

namespace tilestore
{

enum class Output
{
    Pack,
    LibVT,
    DeepZoom
};

/// What `build` is to do, from a configuration file and options.
struct BuildConfig
{
    std::string photos; ///< A folder, or empty where there is a layout.
    std::string layout; ///< That is there already, or that is written.
    bool makeLayout = true;
    std::string store;
    Output output = Output::Pack;
    osgPagedTexture::TileBuildSettings settings;
    int padding = -1;          ///< Less than 0: what the tiles need.
    std::int64_t maxWidth = 0; ///< Of a layout that is made; 0: about square.
    std::string atlas;         ///< A picture that is written as well; empty: none.
    std::int64_t atlasSide = 65500;
    bool updatable = true;
    bool durable = true;
    bool channelsGiven = false, backgroundGiven = false;
};

/// The options of `build` besides --help and --json.
OptionList buildOptions();

/// Throws UsageError for options, std::runtime_error for a file that cannot be used.
BuildConfig readBuildConfig(const Arguments& arguments);

} // namespace tilestore
