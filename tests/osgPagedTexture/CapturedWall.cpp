// SPDX-License-Identifier: MIT
#include "CapturedWall.h"

#include <osgPagedTexture/PictureFile.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

using namespace osgPagedTexture;

namespace
{

/// Two by two before the wall.
glm::dvec3 eyeOf(int camera)
{
    return {camera % 2 == 0 ? 1.0 : 3.0, camera / 2 == 0 ? 0.8 : 2.2, 4.0};
}

constexpr double Focal = 1.2; ///< Widths of the photograph.
constexpr double Aspect = 1.25;

/// Paint: bricks of several colours with some grain.
glm::dvec3 paintAt(double x, double y)
{
    const double row = std::floor(y / 0.12);
    const double shifted = x + (std::fmod(row, 2.0) == 0.0 ? 0.0 : 0.15);
    const double column = std::floor(shifted / 0.3);
    const double joint = std::min({shifted - column * 0.3, (column + 1.0) * 0.3 - shifted,
                                   y - row * 0.12, (row + 1.0) * 0.12 - y});
    if (joint < 0.008)
        return {190, 185, 175};
    const double tone = 0.5 + 0.5 * std::sin(12.9898 * column + 78.233 * row);
    const double grain = 6.0 * std::sin(90.0 * x) * std::sin(83.0 * y);
    return glm::dvec3(110 + 50 * tone, 80 + 25 * tone, 65 + 10 * tone) + grain;
}

/// Where a camera's ray meets the wall: the wall is flat enough for going there in steps.
glm::dvec3 meet(int camera, const glm::dvec2& image)
{
    const glm::dvec3 eye = eyeOf(camera);
    const glm::dvec3 ray((image.x - 0.5) / Focal, (image.y - 0.5) / (Focal * Aspect), -1.0);
    double z = 0.0;
    for (int i = 0; i < 30; ++i)
    {
        const glm::dvec3 at = eye + ray * (eye.z - z);
        z = CapturedWall::pointAt(at.x, at.y).z;
    }
    return eye + ray * (eye.z - z);
}

} // namespace

CapturedWall::CapturedWall(int columns, int rows, int width, int height, bool sameExposure)
    : _columns(columns), _rows(rows), _width(width), _height(height), _sameExposure(sameExposure)
{
}

glm::dvec3 CapturedWall::pointAt(double x, double y)
{
    return {x, y, 0.3 * std::sin(2.0 * x) * std::cos(1.7 * y)};
}

glm::dvec2 CapturedWall::project(int camera, const glm::dvec3& point)
{
    const glm::dvec3 from = point - eyeOf(camera);
    return {0.5 + Focal * from.x / -from.z, 0.5 + Focal * Aspect * from.y / -from.z};
}

Pixels CapturedWall::photograph(int camera) const
{
    const glm::dvec3 gains[Cameras] = {
        {1.0, 1.0, 1.0}, {0.82, 0.85, 0.9}, {1.12, 1.05, 1.0}, {0.93, 1.0, 1.1}};
    const glm::dvec3 gain = _sameExposure ? glm::dvec3(1.0) : gains[camera];
    Pixels pixels(_width, _height, 3);
    for (int y = 0; y < _height; ++y)
    {
        for (int x = 0; x < _width; ++x)
        {
            const glm::dvec2 image((x + 0.5) / _width, (y + 0.5) / _height);
            const glm::dvec3 point = meet(camera, image);
            const glm::dvec2 out = image - 0.5;
            const double dark = _sameExposure ? 0.0 : 0.35 * (out.x * out.x + out.y * out.y);
            const glm::dvec3 color = paintAt(point.x, point.y) * gain * (1.0 - dark);
            for (int c = 0; c < 3; ++c)
                pixels.row(y)[3 * x + c] =
                    static_cast<std::uint8_t>(std::clamp(color[c] + 0.5, 0.0, 255.0));
        }
    }
    return pixels;
}

std::string CapturedWall::write(const std::string& folder, const std::string& extension) const
{
    std::ofstream materials(folder + "/wall.mtl");
    for (int camera = 0; camera < Cameras; ++camera)
    {
        const std::string name = "camera" + std::to_string(camera + 1);
        writePictureFile(folder + "/" + name + extension, photograph(camera), 100);
        materials << "newmtl " << name << "\nKa 1 1 1\nKd 1 1 1\nmap_Kd " << name << extension
                  << "\n";
    }
    const std::string path = folder + "/wall.obj";
    std::ofstream model(path);
    model.precision(9);
    model << "mtllib wall.mtl\n";
    const auto at = [&](int x, int y) { return pointAt(4.0 * x / _columns, 3.0 * y / _rows); };
    for (int y = 0; y <= _rows; ++y)
        for (int x = 0; x <= _columns; ++x)
            model << "v " << at(x, y).x << " " << at(x, y).y << " " << at(x, y).z << "\n";
    for (int camera = 0; camera < Cameras; ++camera)
        for (int y = 0; y <= _rows; ++y)
            for (int x = 0; x <= _columns; ++x)
                model << "vt " << project(camera, at(x, y)).x << " " << project(camera, at(x, y)).y
                      << "\n";
    const int points = (_columns + 1) * (_rows + 1);
    for (int camera = 0; camera < Cameras; ++camera)
    {
        model << "usemtl camera" << camera + 1 << "\n";
        for (int y = 0; y < _rows; ++y)
        {
            for (int x = 0; x < _columns; ++x)
            {
                if ((2 * x >= _columns) + 2 * (2 * y >= _rows) != camera)
                    continue;
                const int a = y * (_columns + 1) + x + 1;
                const int corners[] = {a, a + 1, a + _columns + 2, a + _columns + 1};
                for (int first : {0, 2})
                {
                    model << "f";
                    for (int i = 0; i < 3; ++i)
                        model << " " << corners[(first + i) % 4] << "/"
                              << camera * points + corners[(first + i) % 4];
                    model << "\n";
                }
            }
        }
    }
    return path;
}
