// SPDX-License-Identifier: MIT
#include "ShapeMeshes.h"

#include <osgLabels/ShapeFit.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <random>

using namespace osgLabels;

namespace
{

struct Named
{
    std::string name;
    ShapeMesh mesh;
};

/// All shapes at many tessellations, from the coarsest that count as round.
std::vector<Named> allMeshes()
{
    using namespace shapemesh;
    std::vector<Named> all;
    const auto add = [&](const std::string& name, const ShapeMesh& mesh) {
        all.push_back({name, mesh});
    };
    for (const glm::dvec3 half : {glm::dvec3(1, 1, 1), glm::dvec3(3, 2, 1), glm::dvec3(50, 1, 1),
                                  glm::dvec3(5, 5, 0.01), glm::dvec3(0.2, 1, 8)})
        for (const bool shared : {false, true})
            add("box", box(half, shared));
    for (const int cells : {1, 3})
        for (const double y : {1.0, 0.25, 0.001})
            add("quad", quad(1.0, y, cells));
    for (const int around : {5, 6, 7, 8, 12, 16, 24, 40})
        for (const Ends ends : {Open, Capped, FanCapped})
        {
            for (const double half : {0.05, 1.0, 20.0, 1000.0})
                for (const int along : {1, 3})
                    add("cylinder", frustum(1.0, 1.0, half, around, along, ends));
            for (const double other : {0.0, 0.3, 0.9})
                for (const double half : {0.1, 1.0, 10.0})
                {
                    add("frustum", frustum(1.0, other, half, around, 1, ends));
                    add("frustum", frustum(other, 1.0, half, around, 3, ends));
                }
            for (const double height : {0.25, 0.5, 1.0, 1.5})
                for (const int along : {2, 3, 5, 9})
                    add("dish", dish(1.0, height, around, along, ends));
            for (const double angle : {0.4, 1.0, 1.5708, 3.1416, 4.7})
                for (const double ring : {1.5, 3.0, 12.0})
                    for (const int along : {2, 4, 9})
                        if (around >= 5 && angle / along < 1.2)
                            add(angle < 3.0 ? "elbow" : "torus arc",
                                torus(ring, 1.0, angle, along, around, ends));
        }
    for (const int around : {5, 6, 8, 12, 24, 48})
        for (const int along : {2, 3, 4, 6, 12, 24})
            if (along > 2 || around == 4)
                add("sphere", sphere(1.0, around, along));
    for (const int around : {5, 6, 8, 12, 24})
        for (const int along : {6, 9, 16, 48})
            for (const double ring : {1.3, 2.0, 10.0})
                add("torus", torus(ring, 1.0, 2.0 * 3.14159265358979, along, around, Open));
    for (const glm::dvec3 half : {glm::dvec3(1, 1, 1), glm::dvec3(1, 2, 0.3), glm::dvec3(1, 1, 6)})
        for (const bool base : {false, true})
            add("pyramid", pyramid(half, base));
    const std::vector<glm::dvec2> l = {{0, 0}, {3, 0}, {3, 0.5}, {0.5, 0.5}, {0.5, 2}, {0, 2}};
    const std::vector<glm::dvec2> i = {{-1, -2},   {1, -2},     {1, -1.8},    {0.1, -1.8},
                                       {0.1, 1.8}, {1, 1.8},    {1, 2},       {-1, 2},
                                       {-1, 1.8},  {-0.1, 1.8}, {-0.1, -1.8}, {-1, -1.8}};
    const std::vector<glm::dvec2> wedge = {{-1, -1}, {2, -1}, {-1, 1}};
    for (const double half : {0.5, 2.0, 40.0})
        for (const auto& profile : {l, i, wedge})
            add("extrusion", extrusion(profile, half));
    return all;
}

glm::dquat randomTurn(std::mt19937& random)
{
    std::normal_distribution<double> gauss;
    return glm::normalize(glm::dquat(gauss(random), gauss(random), gauss(random), gauss(random)));
}

/// Whether sizes are those of the truth, however the frame was chosen, within a share of the
/// largest of them.
bool hasSizes(const FittedShape& fit, const FittedShape& truth, double tolerance)
{
    glm::dvec3 a = fit.size, b = truth.size;
    const auto sort = [](glm::dvec3& v, int count)
    {
        for (int i = 0; i != count; ++i)
            for (int k = i + 1; k < count; ++k)
                if (v[k] < v[i])
                    std::swap(v[i], v[k]);
    };
    if (truth.shape == Shape::Box)
    {
        sort(a, 3);
        sort(b, 3);
    }
    // A profile's box may lie along any of its sides.
    if (truth.shape == Shape::Extrusion)
        a.x = a.y = b.x = b.y = 0.0;
    if (truth.shape == Shape::Quad || truth.shape == Shape::Pyramid ||
        truth.shape == Shape::Frustum)
    {
        sort(a, 2);
        sort(b, 2);
    }
    const double most = std::max({b.x, b.y, truth.shape == Shape::Torus ? 0.0 : b.z});
    return std::abs(a.x - b.x) <= tolerance * most && std::abs(a.y - b.y) <= tolerance * most &&
           std::abs(a.z - b.z) <= tolerance * (truth.shape == Shape::Torus ? 1.0 : most);
}

struct Tally
{
    int count = 0, right = 0, wrongSize = 0;
    double residual = 0.0;
    std::map<int, int> wrong;
};

void print(const std::map<std::string, Tally>& tallies)
{
    for (const auto& [name, tally] : tallies)
    {
        std::cout << std::setw(10) << name << ": " << tally.right << " of " << tally.count
                  << " right, residual at most " << tally.residual;
        for (const auto& [shape, count] : tally.wrong)
            std::cout << ", " << count << " as shape " << shape;
        if (tally.wrongSize)
            std::cout << ", " << tally.wrongSize << " with another size";
        std::cout << "\n";
    }
}

/// Fits all meshes, turned, scaled and moved, and expects each to be found.
void expectAllFound(double scale, const glm::dvec3& offset, int turns, double tolerance)
{
    std::mt19937 random(7);
    std::map<std::string, Tally> tallies;
    for (const Named& named : allMeshes())
        for (int turn = 0; turn != turns; ++turn)
        {
            ShapeMesh mesh = named.mesh;
            for (glm::dvec3& point : mesh.points)
                point *= scale;
            mesh.truth.origin *= scale;
            mesh.truth.size *=
                mesh.truth.shape == Shape::Torus ? glm::dvec3(scale, scale, 1) : glm::dvec3(scale);
            if (turn > 0)
                mesh.move(randomTurn(random), offset);
            else
                mesh.move(glm::dquat(1, 0, 0, 0), offset);
            const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
            Tally& tally = tallies[named.name];
            ++tally.count;
            const bool right = fit.shape == mesh.truth.shape && !fit.projected;
            const bool sized = right && hasSizes(fit, mesh.truth, tolerance);
            tally.right += sized;
            if (!right)
                ++tally.wrong[int(fit.shape) + (fit.projected ? 256 : 0)];
            else if (!sized)
                ++tally.wrongSize;
            tally.residual = std::max(tally.residual, fit.residual);
            EXPECT_TRUE(sized) << named.name << " of size " << mesh.truth.size.x << ' '
                               << mesh.truth.size.y << ' ' << mesh.truth.size.z << " with "
                               << mesh.indices.size() / 3 << " triangles, turn " << turn
                               << ": shape " << int(fit.shape) << (fit.projected ? "p" : "") << ' '
                               << fit.size.x << ' ' << fit.size.y << ' ' << fit.size.z;
        }
    print(tallies);
}

} // namespace

TEST(ShapeFitTest, everyShapeIsFoundAtEveryTurn)
{
    expectAllFound(1.0, glm::dvec3(0.0), 4, 1e-4);
}

TEST(ShapeFitTest, smallShapesAreFound)
{
    expectAllFound(1e-6, glm::dvec3(0.0), 2, 1e-4);
}
