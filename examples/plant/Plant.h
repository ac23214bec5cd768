// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Group>

#include <cstdint>

/// What a plant is made of.
struct PlantSettings
{
    unsigned int objects = 1000; ///< Pipes, beams, valves and tanks, without the floor.
    std::uint32_t seed = 1;      ///< The same seed gives the same plant on every machine.
    bool lights = true;          ///< LightSources 0 to 7: a sun, four points, three spots.
};

/// An industrial plant: rows of pipe racks with tanks between them, on a floor.
///
/// Each object is a MatrixTransform with a name of its own ("Pipe 0042") over a mesh that objects
/// of its kind share. Units are metres, z is up, the middle of the floor is the origin. Most meshes
/// are closed, the tanks' ladders are open sheets; many matrices scale differently along the axes.
osg::ref_ptr<osg::Group> makePlant(const PlantSettings& settings = PlantSettings());
