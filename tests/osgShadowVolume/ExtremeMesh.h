// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Geode>
#include <osg/Vec3>

#include <vector>

/// Triangles one by one, for tests that are particular about them.
struct ExtremeMesh
{
    std::vector<osg::Vec3> corners; ///< Three a triangle.

    void triangle(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c);
    void quad(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, const osg::Vec3& d);
    void box(const osg::Vec3& low, const osg::Vec3& high);
    void sphere(const osg::Vec3& center, float radius, int segments = 24);
    /// Horizontal, around (0, 0, z).
    void plate(float half, float z);
    /// `count` triangles around a vertical edge from z = 0.4 to 1.8.
    void fan(unsigned int count);
    /// A wavy sheet of cells * cells quads over |x|, |y| < 1, about z = 1.
    void sheet(int cells);
    /// Around z = 1, of `segments` quads with one half turn in all.
    void moebius(int segments);
    /// Turns each nth triangle over, from the first.
    void flip(std::size_t n);
    /// Adds a copy of each nth triangle.
    void duplicate(std::size_t n);
    void transform(const osg::Matrixd& matrix);

    osg::ref_ptr<osg::Geode> createNode() const;
};
