// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PhotoSurface.h>

#include <glm/vec2.hpp>

#include <cmath>
#include <random>
#include <vector>

/// A grid of columns x rows cells over the photograph, whose inner points are moved about; two
/// triangles a cell, each kept with the probability `share`.
inline osgPagedTexture::PhotoSurface jitteredGrid(int columns, int rows, double share,
                                                  unsigned int seed = 1)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<glm::vec2> points;
    for (int y = 0; y <= rows; ++y)
    {
        for (int x = 0; x <= columns; ++x)
        {
            const double moveX = x == 0 || x == columns ? 0.0 : 0.8 * uniform(random) - 0.4;
            const double moveY = y == 0 || y == rows ? 0.0 : 0.8 * uniform(random) - 0.4;
            points.emplace_back(float((x + moveX) / columns), float((y + moveY) / rows));
        }
    }
    osgPagedTexture::PhotoSurface surface;
    const auto add = [&](int a, int b, int c)
    {
        if (uniform(random) < share)
            for (int i : {a, b, c})
                surface.coordinates.push_back(points[std::size_t(i)]);
    };
    for (int y = 0; y < rows; ++y)
    {
        for (int x = 0; x < columns; ++x)
        {
            const int corner = y * (columns + 1) + x;
            add(corner, corner + 1, corner + columns + 2);
            add(corner, corner + columns + 2, corner + columns + 1);
        }
    }
    return surface;
}

inline osgPagedTexture::Photo photoOf(int width, int height, osgPagedTexture::PhotoSurface surface)
{
    osgPagedTexture::Photo photo;
    photo.name = "photograph.jpg";
    photo.width = width;
    photo.height = height;
    photo.surfaces.push_back(std::move(surface));
    return photo;
}
