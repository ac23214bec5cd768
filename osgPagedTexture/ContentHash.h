// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace osgPagedTexture
{

/// 128 bits that stand for bytes (XXH3, the same on every machine). Not against forgery.
struct ContentHash
{
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    bool operator==(const ContentHash& other) const
    {
        return high == other.high && low == other.low;
    }
    bool operator!=(const ContentHash& other) const { return !(*this == other); }
    bool operator<(const ContentHash& other) const
    {
        return high != other.high ? high < other.high : low < other.low;
    }
    /// 32 hexadecimal digits.
    OSGPAGEDTEXTURE_EXPORT std::string text() const;
};

OSGPAGEDTEXTURE_EXPORT ContentHash hashBytes(const void* bytes, std::size_t count);

/// The same of bytes that come in pieces.
class OSGPAGEDTEXTURE_EXPORT ContentHasher
{
public:
    ContentHasher();
    ~ContentHasher();
    ContentHasher(const ContentHasher&) = delete;
    ContentHasher& operator=(const ContentHasher&) = delete;

    void add(const void* bytes, std::size_t count);
    ContentHash get() const;

private:
    struct State;
    std::unique_ptr<State> _state;
};

inline ContentHash hashText(const std::string& text)
{
    return hashBytes(text.data(), text.size());
}

/// 64 bits of the same, with a seed.
OSGPAGEDTEXTURE_EXPORT std::uint64_t checksum(const void* bytes, std::size_t count,
                                              std::uint64_t seed = 0);

} // namespace osgPagedTexture
