// SPDX-License-Identifier: MIT
#pragma once

#include "PlacedShapes.h"

#include <osgLabels/Placement.h>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <random>
#include <vector>

/// Random points of labelled shapes, seen by random cameras, and where the text lies there.
namespace placement
{

/// A camera that looks at the origin from somewhere.
struct Camera
{
    Camera(const glm::dvec3& from, const glm::dvec3& worldUp);

    osgLabels::PlacementView view() const;

    /// What a point of a surface moves by for a step on the screen, to the first order.
    glm::dvec3 slide(const glm::dvec3& point, const glm::dvec3& normal,
                     const glm::dvec3& step) const;

    /// On the screen, whatever its scale.
    glm::dvec2 project(const glm::dvec3& point) const;

    glm::dvec3 eye, up, right, above;
};

struct Sample
{
    glm::dvec3 point, normal;
    bool curved; ///< Not of a flat end.
};

/// A random point of the surface; of the shape itself where that is round.
class Sampler
{
public:
    /// The mesh must outlive it.
    explicit Sampler(const ShapeMesh& mesh);

    Sample operator()(std::mt19937& random) const;

private:
    glm::dvec3 corner(std::size_t i) const { return _mesh.points[_mesh.indices[i]]; }
    glm::dvec3 cross(std::size_t i) const;

    const ShapeMesh& _mesh;
    std::vector<double> _sums;
};

/// What the text is like there; `pixel` is the step on the screen that counts as one.
osgLabels::LabelPlace placeAt(const ShapeMesh& mesh, const Sample& sample, const Camera& camera,
                              float width, double pixel = 1e-3);

/// Moves a sample over the surface to another place of its label. False where the surface ends
/// before, or the label.
bool walk(const ShapeMesh& mesh, Sample& sample, const Camera& camera, float width,
          const glm::dvec2& target);

/// From 2.5 to 6 times the mesh's size away.
Camera randomCamera(std::mt19937& random, const ShapeMesh& mesh);

/// Whether the sample is seen at more than that sine of an angle.
bool faces(const Camera& camera, const Sample& sample, double least = 0.05);

/// The largest and smallest length on the surface of one em.
glm::dvec2 lengthsOfEm(const Sample& sample, const Camera& camera,
                       const osgLabels::LabelPlace& place);

/// Calls what(shape, sample, camera, width, place) for points that lie on text, on each of the
/// placed shapes for texts of three widths; none for one of them is a failure.
template <class What> void forText(int samples, const What& what)
{
    std::mt19937 random(3);
    for (const PlacedShape& shape : placedShapes())
        for (const float width : {1.0f, shape.width, 25.0f})
        {
            const Sampler sampler(shape.mesh);
            int found = 0;
            for (int i = 0; i != samples; ++i)
            {
                const Camera camera = randomCamera(random, shape.mesh);
                const Sample sample = sampler(random);
                if (!faces(camera, sample))
                    continue;
                const osgLabels::LabelPlace place = placeAt(shape.mesh, sample, camera, width);
                if (!place.inside)
                    continue;
                ++found;
                what(shape, sample, camera, width, place);
            }
            EXPECT_GT(found, 0) << shape.name << " has no text of " << width << " em";
        }
}

} // namespace placement
