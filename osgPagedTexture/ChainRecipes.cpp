// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ChainRecipes.h>

#include <osgPagedTexture/UploadQueue.h>

#include <algorithm>
#include <cstdlib>

#if __has_include(<osgPagedTexture/MakeMipChain.h>)
#include <osgPagedTexture/MakeMipChain.h>
#define OSGPAGEDTEXTURE_ENCODES 1
#else
#define OSGPAGEDTEXTURE_ENCODES 0
#endif

namespace osgPagedTexture
{

bool canMake(BlockFormat format)
{
    return OSGPAGEDTEXTURE_ENCODES || !isBlocked(format);
}

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
        return compresses && abilities.rgtc && canMake(BlockFormat::BC4) ? BlockFormat::BC4
                                                                         : BlockFormat::R8;
    if (compression == Compression::Best && abilities.bptc && canMake(BlockFormat::BC7))
        return BlockFormat::BC7;
    if (compresses && abilities.s3tc && canMake(blocks))
        return blocks;
    return BlockFormat::RGBA8; // Drivers keep RGB so, too.
}

#if OSGPAGEDTEXTURE_ENCODES

namespace
{

ChainSettings chainSettings(BlockFormat format, bool isNormalMap, PagedQuality quality)
{
    ChainSettings settings;
    settings.use = isNormalMap ? TextureUse::NormalMap : TextureUse::Color;
    settings.format = format;
    settings.quality = quality == PagedQuality::Fast   ? EncodeQuality::Fastest
                       : quality == PagedQuality::Best ? EncodeQuality::Best
                                                       : EncodeQuality::Normal;
    return settings;
}

} // namespace

std::shared_ptr<const ChainRecipe> recipeFor(BlockFormat format, bool isNormalMap,
                                             PagedQuality quality)
{
    auto recipe = std::make_shared<ChainRecipe>();
    recipe->settings = formatName(format) + (isNormalMap ? " normals" : " colour") + " quality " +
                       std::to_string(int(quality));
    recipe->linearLight = !isNormalMap;
    recipe->make = [settings = chainSettings(format, isNormalMap, quality)](
                       const Pixels& pixels, int firstLevel, int width, int height)
    { return makeMipChain(pixels, settings, width, height, firstLevel); };
    return recipe;
}

#else

namespace
{

int channelsOf(BlockFormat format)
{
    switch (format)
    {
    case BlockFormat::R8:
        return 1;
    case BlockFormat::RG8:
        return 2;
    case BlockFormat::RGB8:
        return 3;
    default:
        return 4;
    }
}

std::vector<std::uint8_t> converted(const Pixels& pixels, int channels)
{
    std::vector<std::uint8_t> bytes;
    const int from = pixels.channels;
    for (std::size_t i = 0; i < pixels.bytes.size(); i += std::size_t(from))
        for (int channel = 0; channel < channels; ++channel)
        {
            const bool isAlpha = channel == 3 || (channels == 2 && channel == 1);
            if (isAlpha)
                bytes.push_back(pixels.hasAlpha() ? pixels.bytes[i + std::size_t(from) - 1] : 255);
            else
                bytes.push_back(pixels.bytes[i + std::size_t(from < 3 ? 0 : channel)]);
        }
    return bytes;
}

Pixels halved(const Pixels& pixels, int width, int height)
{
    Pixels half(width, height, pixels.channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < pixels.channels; ++c)
            {
                const int x0 = std::min(2 * x, pixels.width - 1),
                          x1 = std::min(2 * x + 1, pixels.width - 1);
                const int y0 = std::min(2 * y, pixels.height - 1),
                          y1 = std::min(2 * y + 1, pixels.height - 1);
                const auto at = [&](int u, int v)
                { return int(pixels.row(v)[u * pixels.channels + c]); };
                half.row(y)[x * pixels.channels + c] =
                    std::uint8_t((at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1) + 2) / 4);
            }
    return half;
}

MipChain plainChain(Pixels pixels, BlockFormat format, int firstLevel, int fullWidth,
                    int fullHeight)
{
    MipChain chain;
    chain.format = format;
    chain.width = fullWidth;
    chain.height = fullHeight;
    chain.firstLevel = firstLevel;
    for (int level = firstLevel; level < levelCount(fullWidth, fullHeight); ++level)
    {
        if (level > firstLevel)
            pixels = halved(pixels, levelSide(fullWidth, level), levelSide(fullHeight, level));
        chain.levels.push_back(converted(pixels, channelsOf(format)));
    }
    return chain;
}

} // namespace

std::shared_ptr<const ChainRecipe> recipeFor(BlockFormat format, bool isNormalMap,
                                             PagedQuality quality)
{
    auto recipe = std::make_shared<ChainRecipe>();
    recipe->settings = formatName(format) + (isNormalMap ? " normals" : " colour") + " box";
    recipe->linearLight = !isNormalMap;
    recipe->make = [format](Pixels pixels, int firstLevel, int width, int height)
    { return plainChain(std::move(pixels), format, firstLevel, width, height); };
    return recipe;
}

#endif

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
