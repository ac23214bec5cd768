// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Geode>

/// The hills that a town lies in.
class Ground
{
public:
    /// Around the origin; `town` is the radius of the streets, metres.
    explicit Ground(double town) : _town(town) {}

    /// Above the sea, metres.
    double heightAt(double x, double y) const;

    /// The lowest within a rectangle, by its corners and middle.
    double lowestIn(const osg::Vec2d& low, const osg::Vec2d& high) const;

    /// To where the hills go, metres from the middle along x and y.
    double reach() const { return _town + 420.0; }

    /// One sheet, up to 20 cm below the surface that heightAt() says, as its cells are flat.
    osg::ref_ptr<osg::Geode> makeTerrain() const;

    /// A strip on the ground, 0.3 m above it, along x or y.
    osg::ref_ptr<osg::Geode> makeStreet(const osg::Vec2d& from, const osg::Vec2d& to,
                                        double width) const;

private:
    double _town;
};
