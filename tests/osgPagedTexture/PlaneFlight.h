// SPDX-License-Identifier: MIT
// What a camera over a plane, on which a virtual texture lies, asks for: a feedback pass without
// graphics.
#pragma once

#include <osgPagedTexture/VirtualPages.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace osgPagedTexture
{

/// Over the plane of 1 x 1, looking down at an angle.
struct PlaneCamera
{
    double x = 0.5, y = 0.5; ///< On the plane, y from the top as the pages'.
    double height = 0.1;
    double heading = 0.0; ///< Radians.
    double down = 0.6;    ///< Radians below the horizon.
};

/// A camera's way: turns over the whole plane, between 0.01 and 0.25 high.
inline PlaneCamera cameraAt(double seconds)
{
    const auto place = [](double time)
    { return std::pair(0.5 + 0.4 * std::cos(0.31 * time), 0.5 + 0.4 * std::sin(0.47 * time)); };
    const auto [x, y] = place(seconds);
    const auto [nextX, nextY] = place(seconds + 0.01);
    return {x, y, 0.13 - 0.12 * std::cos(0.9 * seconds), std::atan2(nextY - y, nextX - x), 0.6};
}

class PlaneView
{
public:
    static constexpr int Width = 1920;
    static constexpr int Height = 1080;

    PlaneView(const TileGrid& grid, double anisotropy) : _grid(grid), _anisotropy(anisotropy) {}

    /// The page that a pixel wants, with its level's fraction; none where it shows no plane.
    struct Want
    {
        PageKey page;
        double level = 0.0;
    };
    std::optional<Want> at(const PlaneCamera& camera, double pixelX, double pixelY) const
    {
        const auto here = hit(camera, pixelX, pixelY);
        const auto right = hit(camera, pixelX + 1.0, pixelY);
        const auto below = hit(camera, pixelX, pixelY + 1.0);
        if (!here || !right || !below || here->first < 0.0 || here->first >= 1.0 ||
            here->second < 0.0 || here->second >= 1.0)
        {
            return {};
        }
        const auto size = [&](const std::pair<double, double>& other)
        {
            return std::hypot((other.first - here->first) * double(_grid.getWidth()),
                              (other.second - here->second) * double(_grid.getHeight()));
        };
        const double large = std::max(size(*right), size(*below));
        const double small = std::min(size(*right), size(*below));
        Want want;
        want.level = std::max(0.0, std::log2(std::max(small, large / _anisotropy)));
        want.page.level = std::min(int(want.level), pageLevels(_grid) - 1);
        const double texels = std::exp2(want.page.level) * _grid.getPayload();
        want.page.x = std::int32_t(here->first * double(_grid.getWidth()) / texels);
        want.page.y = std::int32_t(here->second * double(_grid.getHeight()) / texels);
        return want;
    }

    /// What a feedback picture of 1/reduction the size sees, another pixel of each cell each time.
    std::vector<PageNeed> feedback(const PlaneCamera& camera, int reduction,
                                   std::mt19937& random) const
    {
        const double right = random() % unsigned(reduction) + 0.5;
        const double below = random() % unsigned(reduction) + 0.5;
        std::vector<PageKey> pages;
        for (int y = 0; y < Height / reduction; ++y)
        {
            for (int x = 0; x < Width / reduction; ++x)
            {
                if (const auto want = at(camera, x * reduction + right, y * reduction + below))
                {
                    pages.push_back(want->page);
                }
            }
        }
        return countPages(pages);
    }

private:
    std::optional<std::pair<double, double>> hit(const PlaneCamera& camera, double pixelX,
                                                 double pixelY) const
    {
        const double halfAngle = 0.5;
        const double scale = 2.0 * std::tan(halfAngle) / Width;
        const double right = (pixelX - Width / 2.0) * scale;
        const double up = (Height / 2.0 - pixelY) * scale;
        const double forward = std::cos(camera.down) + up * std::sin(camera.down);
        const double fall = std::sin(camera.down) - up * std::cos(camera.down);
        if (fall <= 1e-6)
        {
            return {};
        }
        const double ahead = forward * camera.height / fall;
        const double aside = right * camera.height / fall;
        const double cosine = std::cos(camera.heading), sine = std::sin(camera.heading);
        return std::pair(camera.x + ahead * cosine - aside * sine,
                         camera.y + ahead * sine + aside * cosine);
    }

    TileGrid _grid;
    double _anisotropy;
};

} // namespace osgPagedTexture
