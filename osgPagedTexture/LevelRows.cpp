// SPDX-License-Identifier: MIT
#include <osgPagedTexture/LevelRows.h>

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace osgPagedTexture
{

LevelRows::Bytes LevelRows::allocate(std::size_t count)
{
    void* bytes = nullptr;
#ifdef __linux__
    constexpr std::size_t pageBytes = 2 << 20;
    if (count >= 2 * pageBytes)
    {
        const std::size_t rounded = (count + pageBytes - 1) / pageBytes * pageBytes;
        bytes = std::aligned_alloc(pageBytes, rounded);
        if (bytes)
        {
            ::madvise(bytes, rounded, MADV_HUGEPAGE); // a hint: where it is refused all works, too
        }
    }
#endif
    bytes = bytes ? bytes : std::malloc(count);
    if (!bytes)
    {
        throw std::bad_alloc();
    }
    return Bytes(static_cast<std::uint8_t*>(bytes), std::free);
}

} // namespace osgPagedTexture
