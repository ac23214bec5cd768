// SPDX-License-Identifier: MIT
// Any bytes as a layout of photographs: one error of one line, or a layout that is written and read
// again as it is.
#include "fuzz/Require.h"

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/TileStore.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include <unistd.h>

using namespace osgPagedTexture;

namespace
{

/// In memory, since it is written for each input.
std::string fileInMemory()
{
    return "/dev/shm/AtlasLayoutFuzz." + std::to_string(getpid());
}

void write(const std::string& path, const std::uint8_t* data, std::size_t size)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    require(file && std::fwrite(data, 1, size, file) == size && std::fclose(file) == 0,
            "the input can be written");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string path = fileInMemory();
    write(path, data, size);
    AtlasLayout layout;
    try
    {
        layout = readAtlasLayout(path);
    }
    catch (const TileStoreError& error)
    {
        const std::string line = error.what();
        require(!line.empty() && line.find('\n') == std::string::npos, "an error is one line");
        std::filesystem::remove(path);
        return 0;
    }
    const double share = layout.getOccupiedShare();
    require(share >= 0.0 && share <= 1.0, "photographs lie in the atlas, beside each other");
    writeAtlasLayout(path, layout);
    const AtlasLayout again = readAtlasLayout(path);
    require(again.getContentHash() == layout.getContentHash() &&
                again.photos.size() == layout.photos.size(),
            "what is written is read");
    std::filesystem::remove(path);
    return 0;
}
