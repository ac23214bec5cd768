// SPDX-License-Identifier: MIT
#pragma once

#include <support/HeadlessViewer.h>

#include <osg/Group>
#include <osg/Matrixd>
#include <osg/Vec3>
#include <osg/Vec4>

#include <cstdint>
#include <string>
#include <vector>

/// A random small scene: a heap of triangles, one light, one camera. The same for a seed on every
/// machine.
struct SoupScene
{
    struct Triangle
    {
        osg::Vec3 corner[3];
        unsigned int drawable = 0;
    };

    std::vector<Triangle> triangles;
    std::vector<osg::Matrixd> matrices; ///< Of each drawable.
    osg::Vec4 light;                    ///< Position in world coordinates; its number is 0.
    osg::Vec3 direction{0, 0, -1};      ///< Of a spot.
    float cutoffDegrees = 180.0f;
    support::CameraSpec camera;

    explicit SoupScene(std::uint32_t seed);

    osg::ref_ptr<osg::Group> createNode() const;

    /// All numbers, so that a failure can be looked at.
    std::string describe() const;
};
