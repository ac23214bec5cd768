// SPDX-License-Identifier: MIT
#include "FlightGround.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace flight
{

using namespace osgPagedTexture;

namespace
{

/// A pattern whose detail ends at the texels of a level.
Pixels patternTile(const PixelRect& rect, int level, double side)
{
    Pixels tile(int(rect.width), int(rect.height), 3);
    const double scale = std::ldexp(1.0, level);
    for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x)
        {
            const double u = (double(rect.x) + x + 0.5) * scale / side;
            const double v = (double(rect.y) + y + 0.5) * scale / side;
            double sum[3] = {};
            // Each octave is left out where it is finer than two texels of the level.
            for (double wave = 8.0; wave * scale < side / 4.0; wave *= 2.7)
                for (int c = 0; c < 3; ++c)
                    sum[c] += std::sin(wave * 6.28 * (u + 0.3 * c) + std::sin(wave * 4.1 * v)) *
                              std::cos(wave * 6.1 * v + c);
            for (int c = 0; c < 3; ++c)
                tile.row(tile.height - 1 - y)[3 * x + c] =
                    std::uint8_t(std::clamp(127.5 + 26.0 * sum[c], 0.0, 255.0));
        }
    return tile;
}

} // namespace

void buildGround(const std::string& path, std::int64_t side, int tileSide)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(side, side, tileSide, 4);
    TilePackWriter::Options options;
    options.durable = false;
    TilePackWriter writer(path, settings, options);
    for (int level = 0; level < settings.grid.getLevels(); ++level)
    {
        std::map<std::pair<int, int>, std::string> painted;
        for (std::int64_t y = 0; y < settings.grid.getRows(level); ++y)
            for (std::int64_t x = 0; x < settings.grid.getColumns(level); ++x)
            {
                std::string& bytes = painted[{int(x % 16), int(y % 16)}];
                if (bytes.empty())
                    bytes = virtuals::encodePng(patternTile(
                        settings.grid.getPixels({level, x % 16, y % 16}), level, double(side)));
                writer.put({level, x, y}, TileData::encoded(bytes));
            }
    }
    writer.commit();
}

void paintGround(const std::string& path, const PixelRect& photograph, TileColor color)
{
    TilePackWriter::Options options;
    options.durable = false;
    TilePackWriter writer(path, options);
    const TileGrid grid = TilePackReader(path).getSettings().grid;
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        const std::int64_t side = std::int64_t(grid.getPayload()) << level;
        for (std::int64_t y = (photograph.y + side - 1) / side;
             (y + 1) * side <= photograph.y + photograph.height; ++y)
            for (std::int64_t x = (photograph.x + side - 1) / side;
                 (x + 1) * side <= photograph.x + photograph.width; ++x)
                writer.put({level, x, y}, TileData::uniform(color));
    }
    writer.commit();
}

support::CameraSpec cameraAt(int frame)
{
    const double t = 2.0 * 3.14159265 * frame / Frames;
    const osg::Vec3d eye(300.0 * std::cos(t), 300.0 * std::sin(2.0 * t),
                         12.0 + 8.0 * std::cos(3 * t));
    const osg::Vec3d ahead(-300.0 * std::sin(t), 600.0 * std::cos(2.0 * t), 0.0);
    return support::CameraSpec::perspective(eye, eye + ahead * 0.1 - osg::Vec3d(0, 0, 10.0),
                                            {0.0, 0.0, 1.0}, 55.0, 16.0 / 9.0, 0.5, 3000.0);
}

} // namespace flight
