// SPDX-License-Identifier: MIT
#include "ChainSamples.h"

#include <osgPagedTexture/ChainLoader.h>

#include <random>

using namespace osgPagedTexture;

MipChain sampleChain(BlockFormat format, int width, int height, int firstLevel, unsigned int seed)
{
    std::mt19937 random(seed);
    MipChain chain{format, width, height, firstLevel, {}};
    for (int level = firstLevel; level < levelCount(width, height); ++level)
    {
        std::vector<std::uint8_t> bytes(
            levelBytes(format, levelSide(width, level), levelSide(height, level)));
        for (std::uint8_t& byte : bytes)
        {
            byte = static_cast<std::uint8_t>(random());
        }
        chain.levels.push_back(std::move(bytes));
    }
    return chain;
}

MipChain plainChain(Pixels pixels, int firstLevel, int fullWidth, int fullHeight)
{
    const BlockFormat formats[] = {BlockFormat::R8, BlockFormat::RG8, BlockFormat::RGB8,
                                   BlockFormat::RGBA8};
    MipChain chain{formats[pixels.channels - 1], fullWidth, fullHeight, firstLevel, {}};
    const int channels = pixels.channels;
    for (int level = firstLevel;; ++level)
    {
        chain.levels.push_back(pixels.bytes);
        if (level + 1 >= levelCount(fullWidth, fullHeight))
        {
            return chain;
        }
        Pixels half(levelSide(fullWidth, level + 1), levelSide(fullHeight, level + 1), channels);
        for (int y = 0; y < half.height; ++y)
        {
            for (int i = 0; i < half.width * channels; ++i)
            {
                const int x = std::min(i / channels * 2, pixels.width - 1);
                half.row(y)[i] =
                    pixels.row(std::min(2 * y, pixels.height - 1))[x * channels + i % channels];
            }
        }
        pixels = half;
    }
}

std::shared_ptr<ChainRecipe> plainRecipe()
{
    const auto recipe = std::make_shared<ChainRecipe>();
    recipe->settings = "plain";
    recipe->make = plainChain;
    return recipe;
}

namespace osgPagedTexture
{

bool operator==(const MipChain& a, const MipChain& b)
{
    return a.format == b.format && a.width == b.width && a.height == b.height &&
           a.firstLevel == b.firstLevel && a.levels == b.levels;
}

} // namespace osgPagedTexture
