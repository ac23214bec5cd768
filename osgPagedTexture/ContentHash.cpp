// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ContentHash.h>

#include <cstdio>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace osgPagedTexture
{

std::string ContentHash::text() const
{
    char digits[33];
    std::snprintf(digits, sizeof(digits), "%016llx%016llx", static_cast<unsigned long long>(high),
                  static_cast<unsigned long long>(low));
    return digits;
}

ContentHash hashBytes(const void* bytes, std::size_t count)
{
    const XXH128_hash_t hash = XXH3_128bits(bytes, count);
    return {hash.high64, hash.low64};
}

struct ContentHasher::State : XXH3_state_t
{
};

ContentHasher::ContentHasher() : _state(std::make_unique<State>())
{
    XXH3_128bits_reset(_state.get());
}

ContentHasher::~ContentHasher() = default;

void ContentHasher::add(const void* bytes, std::size_t count)
{
    XXH3_128bits_update(_state.get(), bytes, count);
}

ContentHash ContentHasher::get() const
{
    const XXH128_hash_t hash = XXH3_128bits_digest(_state.get());
    return {hash.high64, hash.low64};
}

std::uint64_t checksum(const void* bytes, std::size_t count, std::uint64_t seed)
{
    return XXH3_64bits_withSeed(bytes, count, seed);
}

} // namespace osgPagedTexture
