// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/KeyPoints.h>

#include <random>
#include <string>
#include <vector>

/// Key points of one kind, and places from which to look at them.
struct KeySet
{
    std::string name;
    std::vector<glm::dvec3> points;
    glm::dvec3 center{0.0}; ///< Where a viewer would be.
    double radius = 1.0;    ///< Of the surroundings in which fragments lie.

    glm::dvec3 place(std::mt19937& random) const;
};

glm::dvec3 randomIn(std::mt19937& random, double radius);

/// What a hierarchy may stumble over: none, one, all equal, in a plane, on a line, ties, clusters
/// with a far outlier, far from the origin, not numbers.
std::vector<KeySet> makeKeySets(std::size_t count, unsigned int seed);

constexpr osgMultiRender::KeyMode AllKeyModes[] = {osgMultiRender::KeyMode::Points,
                                                   osgMultiRender::KeyMode::Polyline,
                                                   osgMultiRender::KeyMode::PolylineLoop};

/// Looks at every segment that the definition names; nothing of the kit's own.
double bruteDistance(const std::vector<glm::dvec3>& points, osgMultiRender::KeyMode mode,
                     const glm::dvec3& place);
