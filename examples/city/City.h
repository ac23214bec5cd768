// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/MapLabel.h>

#include <osg/MatrixTransform>

#include <cstdint>
#include <vector>

/// What is made.
struct CitySettings
{
    unsigned int buildings = 500; ///< Exactly so many.
    unsigned int trees = 1000;    ///< Exactly so many.
    std::uint32_t seed = 1;       ///< The same seed gives the same town on every machine.
    double origin = 0.0;          ///< Metres: the x and y of the middle of the town.
};

struct City
{
    osg::ref_ptr<osg::MatrixTransform> scene;
    std::vector<osgLabels::MapLabel> labels; ///< World coordinates, the most important first.
};

/// A town in hills, metres, z up: streets around blocks of houses, towers in the middle, parks.
///
/// Every building is one closed, consistently wound mesh below a transform of its own that is named
/// "Building 17", "Town Hall" for number 0; so are trees, "tree-4", but for those of crossed
/// quads with an alpha test, which are open. "Terrain" is one sheet, each street another. The
/// groups "Buildings", "Trees", "Ground" and "Streets" have the user value labelClass: building,
/// tree, terrain, street. Labels are anchored at the top centre of their building's box, which lies
/// in the open over a courtyard.
City makeCity(const CitySettings& settings);
