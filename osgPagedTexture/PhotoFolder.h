// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>

#include <functional>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Files below a folder whose names end as pictures' do, relative to it with '/', sorted. Hidden
/// files and folders are passed over. Throws TileStoreError where the folder cannot be read.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> findPhotos(const std::string& folder);

struct DescribedPhotos
{
    std::vector<AtlasPhoto> photos; ///< In the order of their paths in the list.
    struct Failure
    {
        std::string path;
        std::string cause; ///< One line.
    };
    std::vector<Failure> failures; ///< Those that are no readable pictures.
};

/// describePhoto() of each, on all cores. `progress` is told how many are done.
OSGPAGEDTEXTURE_EXPORT DescribedPhotos describePhotos(
    const std::string& folder, const std::vector<std::string>& paths, unsigned int threads = 0,
    const std::function<void(std::uint64_t done, std::uint64_t total)>& progress = {});

} // namespace osgPagedTexture
