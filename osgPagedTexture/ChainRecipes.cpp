// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ChainRecipes.h>

#include <osgPagedTexture/MakeMipChain.h>
#include <osgPagedTexture/UploadQueue.h>

#include <cstdlib>

namespace osgPagedTexture
{

BlockFormat formatFor(int channels, bool translucent, TextureUse use, Compression compression,
                      const ContextAbilities& abilities)
{
    const bool compresses = compression != Compression::None;
    if (use == TextureUse::NormalsXY)
        return compresses && abilities.rgtc ? BlockFormat::BC5 : BlockFormat::RG8;
    // Fixed-function texture environments take alpha from formats that are named after it alone,
    // so that two channels can't stand for grey and alpha.
    const bool isGrey = channels < 3 && !translucent;
    if (isGrey)
        return compresses && abilities.rgtc ? BlockFormat::BC4 : BlockFormat::R8;
    // Where alpha is a number like any other, no block may drop the colours that it hides.
    if (use != TextureUse::Color && translucent)
        return BlockFormat::RGBA8;
    const bool isBest = compression == Compression::Best || use == TextureUse::Normals;
    if (compresses && isBest && abilities.bptc)
        return BlockFormat::BC7;
    if (compresses && abilities.s3tc && use != TextureUse::Normals)
        return translucent ? BlockFormat::BC3 : BlockFormat::BC1;
    return BlockFormat::RGBA8; // Drivers keep RGB so, too.
}

std::shared_ptr<const ChainRecipe> recipeFor(BlockFormat format, TextureUse use,
                                             EncodeQuality quality)
{
    constexpr const char* names[] = {" colour", " data", " normals", " normals"};
    constexpr TexelUse texels[] = {TexelUse::Color, TexelUse::Data, TexelUse::NormalMap,
                                   TexelUse::NormalMap};
    const TexelUse texel = texels[int(use)];
    auto recipe = std::make_shared<ChainRecipe>();
    recipe->settings =
        formatName(format) + names[int(use)] + " quality " + std::to_string(int(quality));
    recipe->linearLight = use == TextureUse::Color;
    recipe->make = [=](Pixels pixels, int firstLevel, int width, int height)
    { return makeMipChain(std::move(pixels), firstLevel, width, height, texel, format, quality); };
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
