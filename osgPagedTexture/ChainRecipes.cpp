// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ChainRecipes.h>

#include <osgPagedTexture/MakeMipChain.h>
#include <osgPagedTexture/UploadQueue.h>

#include <cstdlib>

namespace osgPagedTexture
{

BlockFormat formatFor(int channels, bool translucent, bool isNormalMap, Compression compression,
                      const ContextAbilities& abilities)
{
    const bool compresses = compression != Compression::None;
    // Fixed-function texture environments take alpha from formats that are named after it alone,
    // so that two channels can't stand for grey and alpha.
    const bool isGrey = channels < 3 && !translucent;
    if (isNormalMap)
        return BlockFormat::RGBA8;
    const BlockFormat blocks = translucent ? BlockFormat::BC3 : BlockFormat::BC1;
    if (isGrey)
        return compresses && abilities.rgtc ? BlockFormat::BC4 : BlockFormat::R8;
    if (compression == Compression::Best && abilities.bptc)
        return BlockFormat::BC7;
    if (compresses && abilities.s3tc)
        return blocks;
    return BlockFormat::RGBA8; // Drivers keep RGB so, too.
}

std::shared_ptr<const ChainRecipe> recipeFor(BlockFormat format, bool isNormalMap,
                                             EncodeQuality quality)
{
    auto recipe = std::make_shared<ChainRecipe>();
    recipe->settings = formatName(format) + (isNormalMap ? " normals" : " colour") + " quality " +
                       std::to_string(int(quality));
    recipe->linearLight = !isNormalMap;
    const TexelUse use = isNormalMap ? TexelUse::NormalMap : TexelUse::Color;
    recipe->make = [=](Pixels pixels, int firstLevel, int width, int height)
    { return makeMipChain(std::move(pixels), firstLevel, width, height, use, format, quality); };
    return recipe;
}

std::string cacheFolder(const std::string& setting)
{
    if (setting == "off")
        return {};
    if (setting != "default")
        return setting;
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
        return std::string(folder) + "/osgPagedTexture";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::string(home) + "/.cache/osgPagedTexture";
    return {};
}

} // namespace osgPagedTexture
