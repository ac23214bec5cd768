// SPDX-License-Identifier: MIT
#pragma once

#include "Picture.h"

#include <osg/AnimationPath>
#include <osg/Group>

#include <vector>

struct TownSettings
{
    unsigned int textures = 200; ///< JPEG files, exactly.
    std::uint32_t seed = 1;
    std::string folder; ///< Of the pictures, as the model is to name it, without a slash.
};

struct Town
{
    osg::ref_ptr<osg::Group> scene;
    std::vector<Picture> pictures; ///< Their sizes are not chosen.
    double halfSide = 0.0;         ///< Metres: it fills the square from -halfSide to halfSide.
};

/// A town of square blocks along straight streets; metres, z up, streets at x and y of 40 + 80 n.
///
/// Every facade, roof, square and street has a picture of its own, until there are as many as were
/// asked for: what is built then takes those that are there again. Images have a file name and no
/// pixels. Some facades repeat a picture; fences repeat, too, and like trees have an alpha
/// channel. A few facades have a normal map in texture unit 1, whose mode is off, for shaders.
Town makeTown(const TownSettings& settings);

/// Low through the streets, above the roofs, and jumps from place to place; about a minute.
osg::ref_ptr<osg::AnimationPath> makeFlight(const Town& town, std::uint32_t seed);
