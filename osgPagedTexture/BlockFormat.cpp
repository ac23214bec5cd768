// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockFormat.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

struct Layout
{
    const char* name;
    int bytes;
    bool blocked;
};

const Layout& layoutOf(BlockFormat format)
{
    static const Layout layouts[] = {{"R8", 1, false},    {"RG8", 2, false}, {"RGB8", 3, false},
                                     {"RGBA8", 4, false}, {"BC1", 8, true},  {"BC3", 16, true},
                                     {"BC4", 8, true},    {"BC5", 16, true}, {"BC7", 16, true}};
    return layouts[static_cast<int>(format)];
}

} // namespace

bool isBlocked(BlockFormat format)
{
    return layoutOf(format).blocked;
}

int unitBytes(BlockFormat format)
{
    return layoutOf(format).bytes;
}

std::string formatName(BlockFormat format)
{
    return layoutOf(format).name;
}

int levelSide(int side, int level)
{
    return level > 30 ? 1 : std::max(1, side >> level);
}

int levelCount(int width, int height)
{
    int levels = 1;
    for (int side = std::max(width, height); side > 1; side >>= 1)
        ++levels;
    return levels;
}

std::uint64_t levelBytes(BlockFormat format, int width, int height)
{
    const Layout& layout = layoutOf(format);
    if (!layout.blocked)
        return std::uint64_t(width) * height * layout.bytes;
    return std::uint64_t((width + 3) / 4) * ((height + 3) / 4) * layout.bytes;
}

std::uint64_t chainBytes(BlockFormat format, int width, int height, int firstLevel)
{
    std::uint64_t bytes = 0;
    for (int level = firstLevel; level < levelCount(width, height); ++level)
        bytes += levelBytes(format, levelSide(width, level), levelSide(height, level));
    return bytes;
}

} // namespace osgPagedTexture
