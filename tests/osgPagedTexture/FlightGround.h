// SPDX-License-Identifier: MIT
// A ground with a pattern that is larger than textures can be, and a path over it.
#pragma once

#include "VirtualScenes.h"

#include <cstdint>
#include <string>

namespace flight
{

constexpr double Ground = 1000.0; ///< Units of its side; its middle is the origin.
constexpr int Frames = 240;       ///< Of a round.

/// A packed store of `side` x `side` texels, its tiles as PNG. The same few hundred tiles stand for
/// all of a level: their bytes are as many and as different as those of photographs, and painting
/// them takes seconds, not minutes.
void buildGround(const std::string& path, std::int64_t side, int tileSide);

/// Gives one colour to all tiles on all levels that lie in a rectangle of texels of level 0, as a
/// photograph does that has been painted over.
void paintGround(const std::string& path, const osgPagedTexture::PixelRect& photograph,
                 osgPagedTexture::TileColor color);

/// 4 to 20 units above the ground, looking ahead and down, 16:9.
support::CameraSpec cameraAt(int frame);

} // namespace flight
