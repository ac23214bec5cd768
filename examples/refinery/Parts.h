// SPDX-License-Identifier: MIT
#pragma once

#include "Refinery.h"

#include <osg/Vec3d>

#include <random>
#include <string>
#include <vector>

/// Makes single objects and simple groups of them, until enough are made.
class Parts
{
public:
    Parts(const RefinerySettings& settings, const AddPrimitive& add);

    /// Whether as many are made as were asked for; what comes then is left out.
    bool isDone() const { return _left == 0; }

    /// From `low` to `high`.
    double random(double low, double high);
    /// From 0 to count - 1.
    int choice(int count);

    void box(const osg::Vec3d& low, const osg::Vec3d& high, const std::string& name);
    /// A bar with a square section from a to b.
    void bar(const osg::Vec3d& a, const osg::Vec3d& b, double width, const std::string& name);
    void cylinder(const osg::Vec3d& a, const osg::Vec3d& b, double radius, const std::string& name);
    void sphere(const osg::Vec3d& center, double radius, const std::string& name);
    /// From its flat side at `base` along `axis`.
    void dish(const osg::Vec3d& base, const osg::Vec3d& axis, double radius, double height,
              const std::string& name);
    void snout(const osg::Vec3d& a, const osg::Vec3d& b, double radiusA, double radiusB,
               const std::string& name);
    /// Upside down: its top is at `top`.
    void hopper(const osg::Vec3d& top, double half, double height, const std::string& name);
    void ring(const osg::Vec3d& center, const osg::Vec3d& axis, double radius, double tube,
              const std::string& name);
    /// A horizontal quad, which has no name.
    void ground(const osg::Vec3d& center, double halfX, double halfY);
    /// A pipe through `points`, with an elbow at each inner one. Spools are named after the line.
    void route(const std::vector<osg::Vec3d>& points, double radius, const std::string& line);

    osg::Vec4ub color{255, 255, 255, 255}; ///< Of what comes next.

private:
    void put(osgLabels::Shape shape, const osg::Vec3d& size, const osg::Vec3d& position,
             const osg::Quat& rotation, const std::string& name);
    void elbow(const osg::Vec3d& corner, const osg::Vec3d& in, const osg::Vec3d& out, double bend,
               double radius, const std::string& name);

    const AddPrimitive& _add;
    unsigned int _left;
    std::mt19937 _engine;
};
