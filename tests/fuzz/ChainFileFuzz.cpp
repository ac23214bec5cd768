// SPDX-License-Identifier: MIT
// Any bytes as an entry of the disk cache: what is taken is bit for bit what is written. The first
// byte picks the level that is read; an odd one makes a whole entry of the bytes and damages it.
#include "fuzz/ChainFileText.h"
#include "fuzz/Require.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

using namespace osgPagedTexture;

namespace
{

std::optional<MipChain> readFile(const std::string& file, int level, ContentHash& key)
{
    const auto layout = parseChainHeader(file.substr(0, MaxChainHeaderBytes), file.size());
    if (!layout)
    {
        return {};
    }
    key = layout->key;
    const int first =
        std::clamp(level, layout->firstLevel, layout->firstLevel + layout->levels() - 1);
    std::size_t at = layout->levelOffset(first);
    return readChainTail(*layout, first,
                         [&](void* bytes, std::size_t count)
                         {
                             require(at + count <= file.size(), "levels lie in the file");
                             std::memcpy(bytes, file.data() + at, count);
                             at += count;
                             return true;
                         });
}

void checkAnyBytes(const std::string& file, int level)
{
    ContentHash key;
    if (readFile(file, level, key))
    {
        const auto whole = readFile(file, 0, key);
        require(!whole || chainFileText(key, *whole) == file, "what is taken is what is written");
    }
}

/// A chain whose shape and texels are of the bytes.
MipChain chainOf(const std::string& bytes)
{
    const auto byteAt = [&](std::size_t at)
    { return at < bytes.size() ? static_cast<std::uint8_t>(bytes[at]) : 0; };
    MipChain chain;
    chain.format = static_cast<BlockFormat>(byteAt(0) % 9);
    chain.width = 1 + byteAt(1) % 40;
    chain.height = 1 + byteAt(2) % 40;
    chain.firstLevel = byteAt(3) % levelCount(chain.width, chain.height);
    std::size_t at = 4;
    for (int level = chain.firstLevel; level < levelCount(chain.width, chain.height); ++level)
    {
        chain.levels.emplace_back(levelBytes(chain.format, levelSide(chain.width, level),
                                             levelSide(chain.height, level)));
        for (std::uint8_t& texel : chain.levels.back())
        {
            texel = byteAt(at++);
        }
    }
    return chain;
}

void checkDamage(const std::string& bytes)
{
    const MipChain chain = chainOf(bytes);
    const ContentHash key = hashText(bytes);
    const std::string file = chainFileText(key, chain);
    ContentHash found;
    const auto whole = readFile(file, 0, found);
    require(whole && whole->levels == chain.levels && found == key, "a whole file is read");
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data(), std::min<std::size_t>(bytes.size(), 4));
    std::string damaged = file;
    damaged[number % file.size()] =
        static_cast<char>(damaged[number % file.size()] ^ (1 << number % 8));
    require(!readFile(damaged, 0, found), "a flipped bit is seen");
    require(!readFile(file.substr(0, number % file.size()), 0, found), "a cut is seen");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size)
    {
        const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
        data[0] % 2 ? checkDamage(bytes) : checkAnyBytes(bytes, data[0] / 2 % 8);
    }
    return 0;
}
