// SPDX-License-Identifier: MIT
#include <osgPagedTexture/StoreOverview.h>

#include <osgPagedTexture/SeamSamples.h>
#include <osgPagedTexture/TileExtract.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

int finestLevelBelow(const TileGrid& grid, int longestSide)
{
    int level = 0;
    while (level + 1 < grid.getLevels() &&
           std::max(grid.getWidth(level), grid.getHeight(level)) > longestSide)
        ++level;
    return level;
}

Pixels readLevel(const TileReader& reader, int level)
{
    const TileGrid& grid = reader.getSettings().grid;
    Pixels pixels(int(grid.getWidth(level)), int(grid.getHeight(level)), 3);
    int row = pixels.height;
    readRegion(reader, level, {0, 0, pixels.width, pixels.height}, ExtractSettings(),
               [&](const std::uint8_t* bytes)
               { std::memcpy(pixels.row(--row), bytes, std::size_t(pixels.width) * 3); });
    return pixels;
}

} // namespace

osg::ref_ptr<osg::Image> readOverview(const TileReader& reader, int longestSide)
{
    const TileGrid& grid = reader.getSettings().grid;
    const int level = finestLevelBelow(grid, longestSide);
    const Pixels pixels = readLevel(reader, level);
    // A level's sides are rounded up, so that its last column may be half of one: the picture is
    // laid over it anew, at the scale of level 0.
    const double width = std::ldexp(double(grid.getWidth()), -level);
    const double height = std::ldexp(double(grid.getHeight()), -level);
    const double shrink = std::min(1.0, longestSide / std::max(width, height));
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(std::max(1, int(width * shrink)), std::max(1, int(height * shrink)), 1,
                         GL_RGB, GL_UNSIGNED_BYTE, 1);
    unsigned char* pixel = image->data();
    for (int y = 0; y < image->t(); ++y)
    {
        for (int x = 0; x < image->s(); ++x)
        {
            // From the top, where the level's rows begin.
            const glm::dvec2 place((x + 0.5) / image->s() * width,
                                   pixels.height - (1.0 - (y + 0.5) / image->t()) * height);
            const glm::vec3 color = lookUp(pixels, place);
            for (int channel = 0; channel < 3; ++channel)
                *pixel++ = static_cast<unsigned char>(color[channel] + 0.5f);
        }
    }
    return image;
}

} // namespace osgPagedTexture
