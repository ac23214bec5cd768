// SPDX-License-Identifier: MIT
#pragma once

#include "ShapeMeshes.h"

#include <osg/Geometry>

#include <string>
#include <vector>

/// A shape as it is labelled, and its mesh.
struct PlacedShape
{
    std::string name;
    ShapeMesh mesh;
    float width; ///< Of its text, in em.
};

/// Every shape, long and short, with texts of several lengths.
std::vector<PlacedShape> placedShapes();

/// Flat-shaded triangles, one color.
osg::ref_ptr<osg::Geometry> geometryOf(const ShapeMesh& mesh);
