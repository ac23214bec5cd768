// SPDX-License-Identifier: MIT
#include "Painter.h"
#include "PictureFile.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{

using Pixels = std::vector<std::uint8_t>;

double lightness(std::uint32_t pixel)
{
    return (0.3 * (pixel & 0xff) + 0.59 * (pixel >> 8 & 0xff) + 0.11 * (pixel >> 16 & 0xff)) / 255;
}

/// Bars between two rails, upright over the whole picture so that it repeats.
double fenceAlpha(double x, double y)
{
    const double bar = std::abs(std::fmod(x * 12.0, 1.0) - 0.5);
    const bool rail = (y > 0.08 && y < 0.13) || (y > 0.85 && y < 0.9);
    return bar < 0.12 || rail ? 1.0 : 0.0;
}

/// A round crown with a ragged edge on a trunk; x and y from the lower left.
double treeAlpha(double x, double y, std::uint32_t seed)
{
    const double across = x - 0.5, up = y - 0.62, angle = std::atan2(up, across);
    const double phase = seed % 628 * 0.01;
    const double edge = 0.3 + 0.03 * std::sin(7.0 * angle + phase) +
                        0.025 * std::sin(17.0 * angle - 2.0 * phase) +
                        0.02 * std::sin(41.0 * angle);
    const bool trunk = std::abs(across) < 0.03 && y < 0.5;
    return std::hypot(across, up) < edge || trunk ? 1.0 : 0.0;
}

Pixels paintCutOut(const Picture& picture, const Painter& painter)
{
    Pixels pixels;
    const bool tree = picture.use == PictureUse::Tree;
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.columns; ++x)
        {
            const double s = (x + 0.5) / picture.columns, t = 1.0 - (y + 0.5) / picture.rows;
            const double light = 0.35 + 0.6 * lightness(painter.sample(x, y));
            const bool leaves = tree && std::hypot(s - 0.5, t - 0.62) < 0.4;
            const double color[] = {leaves ? 70.0 : 110.0, leaves ? 140.0 : 85.0,
                                    leaves ? 50.0 : 60.0};
            for (const double channel : color)
                pixels.push_back(std::uint8_t(channel * light));
            const double alpha = tree ? treeAlpha(s, t, picture.seed) : fenceAlpha(s, t);
            pixels.push_back(std::uint8_t(255.0 * alpha));
        }
    return pixels;
}

/// Of the photograph's lightness as heights. Green points up in the picture.
Pixels paintNormals(const Picture& picture, const Painter& painter)
{
    Pixels pixels;
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.columns; ++x)
        {
            const auto height = [&](int i, int j)
            {
                return lightness(painter.sample(std::clamp(x + i, 0, picture.columns - 1),
                                                std::clamp(y + j, 0, picture.rows - 1)));
            };
            const double normal[] = {4.0 * (height(-1, 0) - height(1, 0)),
                                     4.0 * (height(0, 1) - height(0, -1)), 1.0};
            const double length = std::hypot(normal[0], normal[1], normal[2]);
            for (const double axis : normal)
                pixels.push_back(std::uint8_t(std::lround(127.5 + 127.5 * axis / length)));
        }
    return pixels;
}

} // namespace

void writePng(const Picture& picture, const std::vector<Source>& sources, const std::string& file)
{
    const Painter painter(picture, sources);
    const bool normals = picture.use == PictureUse::NormalMap;
    const Pixels pixels = normals ? paintNormals(picture, painter) : paintCutOut(picture, painter);
    const auto out = OIIO::ImageOutput::create(file);
    OIIO::ImageSpec spec(picture.columns, picture.rows, normals ? 3 : 4, OIIO::TypeDesc::UINT8);
    // Colours are not multiplied by an alpha of 0 and 1 that only cuts out.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!out || !out->open(file, spec) || !out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) ||
        !out->close())
        throw std::runtime_error("cannot write '" + file +
                                 "': " + (out ? out->geterror() : OIIO::geterror()));
}
