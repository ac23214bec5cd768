// SPDX-License-Identifier: MIT
#include "Refinery.h"

#include "ProcessUnit.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr double Road = 10.0; ///< Between plots, along y; racks run through along x.
constexpr unsigned int ObjectsAPlot = 1150;

} // namespace

void makeRefinery(const RefinerySettings& settings, const AddPrimitive& add)
{
    Parts parts(settings, add);
    Tags tags;
    const double plots = std::ceil(double(settings.objects) / ObjectsAPlot);
    // As many along x as make the whole about a square.
    const unsigned int columns =
        std::max(1u, unsigned(std::lround(
                         std::sqrt(plots * (ProcessUnit::Depth + Road) / ProcessUnit::Length))));
    const double rows = std::ceil(plots / columns);
    const osg::Vec3d middle(0.5 * columns * ProcessUnit::Length,
                            0.5 * rows * (ProcessUnit::Depth + Road), 0.0);
    parts.color.set(96, 104, 84, 255);
    parts.ground({0.0, 0.0, -0.5}, middle.x() + 2.0 * Road, middle.y() + 2.0 * Road);
    for (unsigned int i = 0; !parts.isDone(); ++i)
    {
        const osg::Vec3d corner(i % columns * ProcessUnit::Length,
                                i / columns * (ProcessUnit::Depth + Road), 0.0);
        tags.startUnit(i + 1);
        ProcessUnit(parts, tags, corner - middle).make(i + 1);
    }
}

void makeQuads(const RefinerySettings& settings, const AddPrimitive& add)
{
    Parts parts(settings, add);
    const double side = std::cbrt(double(std::max(settings.objects, 1u))) * 4.0;
    for (unsigned int i = 0; i < settings.objects; ++i)
    {
        osgLabels::Primitive quad;
        quad.shape = osgLabels::Shape::Quad;
        quad.size.x() = float(parts.random(0.3, 3.0));
        quad.size.y() = float(parts.random(0.15, 0.8));
        quad.size.z() = 0.0f;
        for (int axis = 0; axis < 3; ++axis)
            quad.position[axis] = parts.random(-0.5, 0.5) * side;
        quad.rotation.makeRotate(0.5 * osg::PI, osg::Vec3d(1.0, 0.0, 0.0));
        for (int channel = 0; channel < 3; ++channel)
            quad.color[channel] = static_cast<unsigned char>(90 + parts.choice(150));
        quad.name = "Quad " + std::to_string(i);
        add(quad);
    }
}
