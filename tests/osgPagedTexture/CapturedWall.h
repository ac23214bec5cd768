// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

/// A bent wall of 4 x 3 units that four cameras have photographed, two by two, each with another
/// exposure and with darker corners: a model as a scanner makes it. Every triangle shows the
/// photograph of the nearest camera, so that seams run through the wall's middle.
class CapturedWall
{
public:
    /// `columns` x `rows` cells of two triangles; photographs of `width` x `height` pixels.
    CapturedWall(int columns, int rows, int width, int height, bool sameExposure = false);

    /// Writes wall.obj, wall.mtl and camera1.png to camera4.png; returns the model's path.
    std::string write(const std::string& folder, const std::string& extension = ".png") const;

    static constexpr int Cameras = 4;

    /// What the camera sees of a point of space, 0 to 1 from the bottom left.
    static glm::dvec2 project(int camera, const glm::dvec3& point);
    /// The wall's point at a place of its plan.
    static glm::dvec3 pointAt(double x, double y);

    osgPagedTexture::Pixels photograph(int camera) const;

private:
    const int _columns, _rows, _width, _height;
    const bool _sameExposure;
};
