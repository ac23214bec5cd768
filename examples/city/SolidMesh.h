// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Geometry>

#include <vector>

/// Collects faces of closed bodies: flat, triangles, each counterclockwise from outside, and each
/// edge shared by two faces from end to end.
class SolidMesh
{
public:
    /// Place of a face in the picture of walls that has no window.
    static const osg::Vec2 Blank;

    SolidMesh();

    /// Convex. `windows`: how many fit along the first edge, and along the last; 0, 0 for none.
    void face(const std::vector<osg::Vec3>& corners, const osg::Vec3& color,
              const osg::Vec2& windows = osg::Vec2());

    void box(const osg::Vec3& low, const osg::Vec3& high, const osg::Vec3& walls,
             const osg::Vec3& roof, bool hasWindows);

    /// A prism over the cells of a grid that are filled, row by row from the smallest y. Filled
    /// cells must not touch at a corner alone.
    void prism(const std::vector<float>& xs, const std::vector<float>& ys,
               const std::vector<bool>& filled, float low, float high, const osg::Vec3& walls,
               const osg::Vec3& roof);

    /// A house with a ridge along x.
    void gabled(const osg::Vec3& low, const osg::Vec3& high, float ridge, const osg::Vec3& walls,
                const osg::Vec3& roof);

    /// Of `sides` around z, from the radii at the heights; a radius of 0 ends it in a point.
    void turned(const std::vector<osg::Vec2>& radiusAndHeight, int sides, const osg::Vec3& color);

    osg::BoundingBox getBox() const;

    /// What was collected.
    osg::ref_ptr<osg::Geometry> make() const;

private:
    void wall(const osg::Vec3& from, const osg::Vec3& to, float top, const osg::Vec3& color,
              bool hasWindows);

    osg::ref_ptr<osg::Vec3Array> _vertices, _normals;
    osg::ref_ptr<osg::Vec4ubArray> _colors;
    osg::ref_ptr<osg::Vec2Array> _texCoords;
    osg::ref_ptr<osg::DrawElementsUInt> _triangles;
};
