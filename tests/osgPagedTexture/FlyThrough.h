// SPDX-License-Identifier: MIT
#pragma once

#include <osg/AnimationPath>

#include <string>
#include <vector>

/// A flight through a model in this process.
struct FlyThrough
{
    std::string model; ///< As osgDB reads it, with the suffix of a pseudo-loader.
    osg::ref_ptr<osg::AnimationPath> path;
    int width = 800, height = 600; ///< Pixels.
    int frames = 600;              ///< Along the path, at even steps of its time.
    double restSeconds = 1.0;      ///< A picture that is the same for so long is at rest...
    double mostSeconds = 120.0;    ///< ...or after so long.
    std::string pictures; ///< Start of the names of the pictures at rest; none where empty.

    /// The columns of what run() gives.
    static const std::vector<std::string>& columns();

    /// Throws std::runtime_error where there is no context or the model cannot be read.
    std::vector<double> run() const;
};
