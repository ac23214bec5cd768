// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/MipChain.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// The file of a chain: a DDS texture whose level 0 is the chain's finest, as other programs read
/// it (OSG 3.6.5's own all but BC7), and after its last level a checksum for each level. Rows lie
/// as in memory: the first one is the bottom of the picture, as OpenGL takes it (programs that
/// follow Direct3D show it upside down). What DDS has no place for stands in the reserved words of
/// its header.
///
///     "DDS " | header | DX10 header (BC7 only) | finest level ... 1x1 | checksum of each level
struct ChainFileLayout
{
    BlockFormat format = BlockFormat::RGBA8;
    int width = 0; ///< Of level 0 of the texture.
    int height = 0;
    int firstLevel = 0;
    ContentHash key;
    std::uint64_t tableChecksum = 0; ///< Of the checksums of the levels and of the header.

    int levels() const { return levelCount(width, height) - firstLevel; }
    std::size_t headerBytes() const;
    std::uint64_t fileBytes() const;
    std::uint64_t levelOffset(int level) const;
    std::uint64_t tableOffset() const { return levelOffset(firstLevel + levels()); }
    std::string header() const;
    std::uint64_t checksumOf(const char* table) const; ///< What tableChecksum should be.
};

/// More than any header.
constexpr std::size_t MaxChainHeaderBytes = 148;

/// What stands before the pixels of a DDS texture without further levels.
std::string ddsHeader(BlockFormat format, int width, int height);

/// The layout that the first bytes of a file say, or nothing where one bit of them is not as
/// ChainFileLayout::header() writes it or the file has another length.
std::optional<ChainFileLayout> parseChainHeader(const std::string& head, std::uint64_t fileBytes);

/// A level's checksum, which also depends on the entry and the level that it belongs to.
std::uint64_t levelChecksum(const ContentHash& key, int level,
                            const std::vector<std::uint8_t>& bytes);

/// Takes the next bytes of a file; false where it can't, which ends the writing.
using WriteBytes = std::function<bool(const void* bytes, std::size_t count)>;

/// Gives the next bytes of a file; false where there are not as many.
using ReadBytes = std::function<bool(void* bytes, std::size_t count)>;

/// Writes the whole file in pieces, from its first byte to its last. False where `write` said so.
bool writeChainFile(const ContentHash& key, const MipChain& chain, const WriteBytes& write);

/// Reads the levels from `firstLevel` on. `read` gives the file's bytes from
/// layout.levelOffset(firstLevel) on. Nothing where they end too early or a checksum fails.
std::optional<MipChain> readChainTail(const ChainFileLayout& layout, int firstLevel,
                                      const ReadBytes& read);

} // namespace osgPagedTexture
