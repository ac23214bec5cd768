// SPDX-License-Identifier: MIT
#include "ShapeMeshes.h"

#include <osgLabels/ShapeFit.h>

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(ShapeFitTest, shapesFarFromTheOriginAreFound)
{
    // Floats are 1 apart at 1e7: shapes of 1e4 have a ten thousandth of noise.
    std::mt19937 random(5);
    using namespace shapemesh;
    const std::vector<Named> meshes = {{"box", box({3e4, 2e4, 1e4}, false)},
                                       {"cylinder", frustum(1e4, 1e4, 3e4, 16, 1, FanCapped)},
                                       {"cone", frustum(1e4, 0, 1e4, 24, 1, FanCapped)},
                                       {"sphere", sphere(2e4, 24, 12)},
                                       {"dish", dish(2e4, 1e4, 24, 6, Open)},
                                       {"torus", torus(3e4, 1e4, 1.5707963, 8, 12, Open)},
                                       {"quad", quad(1e4, 2e4, 1)},
                                       {"pyramid", pyramid({1e4, 1e4, 1e4}, true)}};
    for (const Named& named : meshes)
        for (int turn = 0; turn != 4; ++turn)
        {
            ShapeMesh mesh = named.mesh;
            mesh.move(randomTurn(random), {1e7, -1e7, 1e7});
            const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
            EXPECT_EQ(int(fit.shape), int(mesh.truth.shape)) << named.name;
            EXPECT_FALSE(fit.projected) << named.name;
            EXPECT_TRUE(hasSizes(fit, mesh.truth, 1e-3)) << named.name;
            EXPECT_LT(glm::distance(fit.origin, mesh.truth.origin), 10.0) << named.name;
        }
}

TEST(ShapeFitTest, theFrameIsThatOfTheShape)
{
    std::mt19937 random(9);
    for (const Named& named : allMeshes())
    {
        ShapeMesh mesh = named.mesh;
        mesh.move(randomTurn(random), {0.5, -3.0, 2.0});
        const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
        const double reach = glm::length(mesh.truth.size);
        EXPECT_NEAR(glm::length(fit.rotation), 1.0, 1e-9);
        // Profiles may have a box along any of their sides.
        if (mesh.truth.shape == Shape::Extrusion)
            continue;
        EXPECT_LT(glm::distance(fit.origin, mesh.truth.origin), 1e-3 * reach) << named.name;
        for (const glm::dvec3& point : mesh.points)
            EXPECT_LT(distanceTo(fit, point), 1e-4 * reach) << named.name;
    }
}

TEST(ShapeFitTest, whatIsNoShapeIsProjected)
{
    using namespace shapemesh;
    std::mt19937 random(2);
    std::normal_distribution<double> gauss;
    std::vector<Named> meshes;
    // A third of a sphere, an oblique cone, a bent plate, a heap of triangles.
    ShapeMesh part = sphere(1, 24, 12);
    part.indices.resize(part.indices.size() / 3);
    meshes.push_back({"part of a sphere", part});
    ShapeMesh oblique = frustum(1, 0.5, 1, 24, 1, FanCapped);
    for (glm::dvec3& point : oblique.points)
        point.x += 0.4 * point.z;
    meshes.push_back({"oblique cone", oblique});
    ShapeMesh egg = sphere(1, 24, 12);
    for (glm::dvec3& point : egg.points)
        point.z *= point.z > 0.0 ? 1.6 : 1.0;
    meshes.push_back({"egg", egg});
    ShapeMesh sheared = box({1, 1, 1}, false);
    for (glm::dvec3& point : sheared.points)
        point.x += 0.5 * point.z + 0.2 * point.y;
    meshes.push_back({"sheared box", sheared});
    ShapeMesh heap;
    for (std::uint32_t i = 0; i != 300; ++i)
    {
        heap.points.emplace_back(gauss(random), gauss(random), gauss(random));
        heap.indices.push_back(i);
    }
    meshes.push_back({"heap", heap});
    for (const Named& named : meshes)
    {
        ShapeMesh mesh = named.mesh;
        mesh.move(randomTurn(random), {1, 2, 3});
        const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
        EXPECT_EQ(int(fit.shape), int(Shape::Box)) << named.name;
        EXPECT_TRUE(fit.projected) << named.name;
        // The box holds the mesh.
        for (const std::uint32_t index : mesh.indices)
        {
            const glm::dvec3 point = mesh.points[index];
            const glm::dvec3 p = glm::abs(fit.rotation * (point - fit.origin)) - fit.size;
            EXPECT_LT(std::max({p.x, p.y, p.z}), 1e-5) << named.name;
        }
    }
}

TEST(ShapeFitTest, aDodecahedronIsNoSphere)
{
    // Its 20 corners lie on a sphere; each of its sides has the five that are farthest that way.
    const double phi = 0.5 * (1.0 + std::sqrt(5.0));
    ShapeMesh mesh;
    std::vector<glm::dvec3> ways;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-1.0, 1.0})
        {
            for (const double c : {-1.0, 1.0})
                mesh.points.emplace_back(a, b, c);
            for (int axis = 0; axis != 3; ++axis)
            {
                glm::dvec3 corner(0.0), way(0.0);
                corner[(axis + 1) % 3] = a / phi;
                corner[(axis + 2) % 3] = b * phi;
                way[(axis + 1) % 3] = a * phi;
                way[(axis + 2) % 3] = b;
                mesh.points.push_back(corner);
                ways.push_back(glm::normalize(way));
            }
        }
    for (const glm::dvec3& way : ways)
    {
        const glm::dvec3 x = glm::normalize(glm::cross(way, glm::dvec3(0.3, 0.5, 0.9)));
        std::vector<std::pair<double, std::uint32_t>> side;
        for (std::uint32_t i = 0; i != mesh.points.size(); ++i)
            if (glm::dot(mesh.points[i], way) > 1.3)
                side.emplace_back(std::atan2(glm::dot(mesh.points[i], glm::cross(way, x)),
                                             glm::dot(mesh.points[i], x)),
                                  i);
        ASSERT_EQ(side.size(), 5u);
        std::sort(side.begin(), side.end());
        for (std::size_t i = 1; i != 4; ++i)
            mesh.indices.insert(mesh.indices.end(),
                                {side[0].second, side[i].second, side[i + 1].second});
    }
    const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
    EXPECT_EQ(int(fit.shape), int(Shape::Box));
    EXPECT_TRUE(fit.projected);
}

TEST(ShapeFitTest, aPipeWithAWallIsACylinder)
{
    ShapeMesh mesh = shapemesh::frustum(1.0, 1.0, 3.0, 24, 1, shapemesh::Open);
    const ShapeMesh bore = shapemesh::frustum(0.8, 0.8, 3.0, 24, 1, shapemesh::Open);
    const auto first = std::uint32_t(mesh.points.size());
    mesh.points.insert(mesh.points.end(), bore.points.begin(), bore.points.end());
    for (const std::uint32_t index : bore.indices)
        mesh.indices.push_back(first + index);
    // Ends: a ring of quads each; points go up and down in turn.
    for (std::uint32_t i = 0; i != 24; ++i)
        for (const std::uint32_t end : {0u, 1u})
        {
            const std::uint32_t a = 2 * i + end;
            mesh.indices.insert(mesh.indices.end(),
                                {a, a + 2, first + a, a + 2, first + a + 2, first + a});
        }
    const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
    EXPECT_EQ(int(fit.shape), int(Shape::Cylinder));
    EXPECT_LT(glm::distance(fit.size, glm::dvec3(1.0, 1.0, 3.0)), 1e-5);
}

TEST(ShapeFitTest, halfAPipeIsAnExtrusion)
{
    ShapeMesh half = shapemesh::frustum(1, 1, 2, 24, 1, shapemesh::Open);
    half.indices.resize(half.indices.size() / 2);
    const FittedShape fit = fitShape(half.vertices(), half.indices);
    EXPECT_EQ(int(fit.shape), int(Shape::Extrusion));
    EXPECT_NEAR(fit.size.z, 2.0, 1e-5);
}

TEST(ShapeFitTest, aBoxWithABevelFollowsItsFaces)
{
    // Its faces dominate; the bevels make it no box.
    ShapeMesh mesh = shapemesh::extrusion({{-2, -1}, {1.9, -1}, {2, -0.9}, {2, 1}, {-2, 1}}, 3);
    mesh.indices.insert(mesh.indices.end(), {0, 1, 4});
    std::mt19937 random(4);
    mesh.move(randomTurn(random), {0, 0, 0});
    const FittedShape fit = fitShape(mesh.vertices(), mesh.indices);
    glm::dvec3 sides = fit.size;
    std::sort(&sides.x, &sides.x + 3);
    EXPECT_LT(glm::distance(sides, glm::dvec3(1, 2, 3)), 1e-5);
}

TEST(ShapeFitTest, degenerateMeshesAreNoneOrFinite)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const float huge = std::numeric_limits<float>::max();
    const std::vector<std::vector<glm::vec3>> vertices = {
        {},
        {{1, 2, 3}},
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
        {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}},
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{infinite, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
        {{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}, {1e-30f, 1e-30f, 0}},
        {{0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {huge, huge, 0}},
        {{-huge, -huge, 0}, {huge, 0, 0}, {0, huge, 0}, {huge, huge, huge}},
        {{0, 0, 0}, {1e4f, 0, 0}, {1e4f, 1e-4f, 0}, {0, 1e-4f, 0}}};
    const std::vector<std::vector<std::uint32_t>> indices = {{},
                                                             {0},
                                                             {0, 1},
                                                             {0, 1, 2, 0, 2, 3},
                                                             {0, 1, 2, 1, 2, 3, 0, 2, 3, 0, 1, 3},
                                                             {0, 0, 0},
                                                             {7, 8, 4000000000u},
                                                             {0, 1, 2, 9, 1, 2}};
    for (const auto& points : vertices)
        for (const auto& corners : indices)
        {
            const FittedShape fit = fitShape(points, corners);
            const glm::dvec3 all = fit.origin + fit.size;
            EXPECT_TRUE(std::isfinite(all.x + all.y + all.z));
            EXPECT_TRUE(std::isfinite(fit.residual) && std::isfinite(fit.coarseness));
            EXPECT_NEAR(glm::length(fit.rotation), 1.0, 1e-6);
            if (fit.shape != Shape::None)
            {
                EXPECT_GT(std::max({fit.size.x, fit.size.y, fit.size.z}), 0.0);
            }
        }
    EXPECT_EQ(int(fitShape(vertices[3], indices[4]).shape), int(Shape::None));
    EXPECT_EQ(int(fitShape(vertices[10], indices[3]).shape), int(Shape::Quad));
}
