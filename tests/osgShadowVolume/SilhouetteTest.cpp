// SPDX-License-Identifier: MIT
#include "SilhouetteMeshes.h"

#include <osgShadowVolume/EdgeMeshBuilder.h>
#include <osgShadowVolume/Silhouette.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>

using namespace osgShadowVolume;

namespace
{

int signOf(double value)
{
    return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

/// The exact sign: the products of three differences of floats within 2^±12 of each other fit into
/// 113 bits, or nearly so.
int exactFacing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const MeshLight& light)
{
    using Real = __float128;
    Real u[3], v[3], e[3];
    for (int i = 0; i < 3; ++i)
    {
        u[i] = Real(c[i]) - Real(a[i]);
        v[i] = Real(light.light[i]) + Real(light.rest[i]) - Real(a[i]) * Real(light.light.w);
        e[i] = Real(b[i]) - Real(a[i]);
    }
    const Real side = (u[1] * v[2] - u[2] * v[1]) * e[0] + (u[2] * v[0] - u[0] * v[2]) * e[1] +
                      (u[0] * v[1] - u[1] * v[0]) * e[2];
    return side > 0 ? 1 : side < 0 ? -1 : 0;
}

/// As facing(), but as a compiler may contract it.
int fusedFacing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const MeshLight& light,
                float scale)
{
    const glm::vec3 u = (c - a) * scale, e = (b - a) * scale;
    glm::vec3 v;
    for (int i = 0; i < 3; ++i)
        v[i] = std::fma(-a[i], light.light.w, light.light[i]) + light.rest[i];
    const glm::vec3 n(std::fma(u.y, v.z, -(u.z * v.y)), std::fma(u.z, v.x, -(u.x * v.z)),
                      std::fma(u.x, v.y, -(u.y * v.x)));
    return signOf(std::fma(n.z, e.z, std::fma(n.y, e.y, n.x * e.x)));
}

/// Judged in the order of the edge's own ends, as older programs do.
int edgeOrderFacing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& o,
                    const MeshLight& light)
{
    const glm::vec3 v = (glm::vec3(light.light) - a * light.light.w) + light.rest;
    return signOf(glm::dot(glm::cross(b - a, o - a), v));
}

/// Vertices that stay open where each edge judges for itself.
std::size_t openByEdgeOrder(const EdgeMesh& mesh, const MeshLight& light)
{
    std::vector<int> sums(mesh.vertices.size());
    for (const glm::uvec3& t : mesh.triangles)
        for (const glm::uvec3& edge :
             {glm::uvec3(t.x, t.y, t.z), glm::uvec3(t.y, t.z, t.x), glm::uvec3(t.x, t.z, t.y)})
        {
            const int side = edgeOrderFacing(mesh.vertices[edge.x], mesh.vertices[edge.y],
                                             mesh.vertices[edge.z], light);
            sums[edge.x] += side;
            sums[edge.y] -= side;
        }
    return sums.size() - std::size_t(std::count(sums.begin(), sums.end(), 0));
}

using Directed = std::pair<std::uint32_t, std::uint32_t>;

/// Edges of the volume's triangles that no other triangle runs through the other way. All
/// extrusions of a directional light are one point.
std::size_t openEdges(const EdgeMesh& mesh, const Silhouette& silhouette, bool directional)
{
    const std::uint32_t count = std::uint32_t(mesh.vertices.size());
    std::map<Directed, int> balance;
    const auto add = [&](const std::vector<std::uint32_t>& indices, int weight)
    {
        for (std::size_t i = 0; i < indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k)
            {
                std::uint32_t from = indices[i + k], to = indices[i + (k + 1) % 3];
                if (directional)
                {
                    from = std::min(from, count);
                    to = std::min(to, count);
                }
                if (from < to)
                    balance[{from, to}] += weight;
                else if (to < from)
                    balance[{to, from}] -= weight;
            }
    };
    for (const Silhouette::Sides& sides : silhouette.sides)
        add(sides.indices, int(sides.weight));
    add(silhouette.nearCaps, 1);
    add(silhouette.farCaps, 1);
    return std::size_t(
        std::count_if(balance.begin(), balance.end(), [](const auto& e) { return e.second != 0; }));
}

void expectClosed(const HardCase& hard)
{
    const EdgeMesh mesh = hard.build();
    for (const glm::dvec4& light : hard.lights)
    {
        const MeshLight l = toMeshLight(mesh, light);
        EXPECT_EQ(openVertices(mesh, l), 0u) << hard.name;
    }
    const MeshLight l = toMeshLight(mesh, hard.lights.front());
    EXPECT_EQ(openEdges(mesh, silhouetteOf(mesh, l, 1), l.light.w == 0.0f), 0u) << hard.name;
}

HardCase scaled(HardCase hard, double factor)
{
    for (HardCase::Triangle& t : hard.triangles)
        for (glm::vec3& corner : t)
            corner = glm::vec3(glm::dvec3(corner) * factor);
    for (glm::dvec4& light : hard.lights)
        light *= glm::dvec4(factor, factor, factor, 1.0);
    return hard;
}

} // namespace

TEST(SilhouetteTest, aTriangleFacesWhoSeesItCounterclockwise)
{
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EXPECT_EQ(facing(a, b, c, {{0, 0, 1, 0}, {}}, 1.0f), 1);
    EXPECT_EQ(facing(a, b, c, {{0, 0, -1, 0}, {}}, 1.0f), -1);
    EXPECT_EQ(facing(a, b, c, {{3, 4, 0, 1}, {}}, 1.0f), 0);
    EXPECT_EQ(facing(a, b, c, {{3, 4, 5, 1}, {}}, 1.0f), 1);
}

TEST(SilhouetteTest, notANumberIsNoSide)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(facing({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {{nan, 0, 1, 0}, {}}, 1.0f), 0);
}

TEST(SilhouetteTest, aTriangleHasAVolumeOfThreeSidesAndTwoCaps)
{
    EdgeMeshBuilder builder;
    builder.addTriangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    const EdgeMesh mesh = builder.build();
    const Silhouette point = silhouetteOf(mesh, {{0.2f, 0.2f, 1, 1}, {}}, 1);
    ASSERT_EQ(point.sides.size(), 1u);
    EXPECT_EQ(point.sides[0].weight, 1u);
    EXPECT_EQ(point.sides[0].indices.size(), 3u * 6u);
    // Vertices ascend, so the light above sees 0, 1, 2 clockwise.
    EXPECT_EQ(point.nearCaps, (std::vector<std::uint32_t>{0, 2, 1}));
    EXPECT_EQ(point.farCaps, (std::vector<std::uint32_t>{4, 5, 3}));
    const Silhouette directional = silhouetteOf(mesh, {{0, 0, 1, 0}, {}}, 1);
    EXPECT_EQ(directional.sides[0].indices.size(), 3u * 3u);
    EXPECT_TRUE(directional.farCaps.empty());
}

TEST(SilhouetteTest, trianglesOnOneSideOfAnEdgeAddUp)
{
    HardCase hard = book(5);
    const EdgeMesh mesh = hard.build();
    std::map<std::uint32_t, std::size_t> triangles;
    for (const Silhouette::Sides& sides : silhouetteOf(mesh, {{100, 1, 0.3f, 1}, {}}, 1).sides)
        triangles[sides.weight] = sides.indices.size() / 3;
    // Three pages on one side of the spine, two on the other: it counts once, as each outer edge.
    EXPECT_EQ(triangles[1], 2u * 11u);
    HardCase twice = hard;
    twice.triangles.insert(twice.triangles.end(), hard.triangles.begin(), hard.triangles.end());
    const Silhouette doubled = silhouetteOf(twice.build(), {{100, 1, 0.3f, 1}, {}}, 1);
    ASSERT_EQ(doubled.sides.size(), 1u);
    EXPECT_EQ(doubled.sides[0].weight, 2u);
}

TEST(SilhouetteTest, hardCasesAreClosed)
{
    for (const double offset : {0.0, 1e4, 1e6})
        for (const HardCase& hard : hardCases(offset))
            expectClosed(hard);
}

TEST(SilhouetteTest, aMillionGrazingTrianglesAreClosed)
{
    const HardCase hard = grazingTriangles(1000000);
    const EdgeMesh mesh = hard.build();
    EXPECT_EQ(openVertices(mesh, toMeshLight(mesh, hard.lights[0])), 0u);
}

TEST(SilhouetteTest, anyNumberOfTrianglesMeetsAtAnEdge)
{
    for (const unsigned int count : {1u, 2u, 3u, 29u, 30u, 31u, 33u, 100u})
        expectClosed(book(count));
}

TEST(SilhouetteTest, onesidedAndRepeatedAndBrokenMeshesAreClosed)
{
    expectClosed(moebiusStrip(40));
    HardCase duplicates = book(7);
    const std::vector<HardCase::Triangle> once = duplicates.triangles;
    for (int i = 0; i < 3; ++i)
        duplicates.triangles.insert(duplicates.triangles.end(), once.begin(), once.end() - i);
    expectClosed(duplicates);
    HardCase broken = book(9);
    broken.triangles[2][1].x = std::numeric_limits<float>::quiet_NaN();
    broken.triangles[4][1] = broken.triangles[4][0];
    // Collinear, but with three corners.
    broken.triangles.push_back({glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 3)});
    expectClosed(broken);
}

TEST(SilhouetteTest, sizesFromTinyToHugeMakeNoDifference)
{
    const HardCase box = hardCases(0.0)[1];
    for (const double factor : {1e-20, 1e-10, 1e10, 1e20})
        expectClosed(scaled(box, factor));
    // Powers of two are exact, so the decisions are the same one by one.
    const EdgeMesh mesh = box.build();
    for (const int exponent : {-66, -20, 20, 66})
    {
        const double factor = std::ldexp(1.0, exponent);
        const HardCase other = scaled(box, factor);
        const EdgeMesh otherMesh = other.build();
        for (std::size_t i = 0; i != box.lights.size(); ++i)
        {
            const Silhouette a = silhouetteOf(mesh, toMeshLight(mesh, box.lights[i]), 1);
            const Silhouette b =
                silhouetteOf(otherMesh, toMeshLight(otherMesh, other.lights[i]), 1);
            EXPECT_EQ(a.nearCaps, b.nearCaps) << exponent;
        }
    }
}

TEST(SilhouetteTest, lightsOfAnySizeStayFinite)
{
    const EdgeMesh mesh = book(3).build();
    for (const double size : {1e-300, 1e-30, 1.0, 1e30, 1e300})
    {
        const MeshLight light = toMeshLight(mesh, glm::dvec4(size, 2 * size, 3 * size, size));
        EXPECT_GT(std::max({light.light.x, light.light.y, light.light.z, light.light.w}), 0.1f)
            << size;
        EXPECT_LT(std::max({light.light.x, light.light.y, light.light.z, light.light.w}), 10.0f)
            << size;
        EXPECT_NEAR(light.light.y / light.light.x, 2.0, 1e-6);
    }
    EXPECT_EQ(toMeshLight(mesh, {1e60, 0, 0, 1}).light.w, 0.0f);
}

TEST(SilhouetteTest, judgingInTheOrderOfEdgesLeaks)
{
    // Why triangles are judged in the order of their indices: these are the lights of the wall.
    const HardCase wall = hardCases(0.0)[0];
    const EdgeMesh mesh = wall.build();
    std::size_t open = 0;
    for (const glm::dvec4& light : wall.lights)
        open += openByEdgeOrder(mesh, toMeshLight(mesh, light));
    EXPECT_GT(open, 0u);
}

TEST(SilhouetteTest, oneContractedProgramAmongOthersDisagrees)
{
    // Why the shaders say `precise` on each step.
    const HardCase wall = hardCases(0.0)[0];
    const EdgeMesh mesh = wall.build();
    std::size_t differs = 0;
    for (const glm::dvec4& light : wall.lights)
        for (const glm::uvec3& t : mesh.triangles)
        {
            const MeshLight l = toMeshLight(mesh, light);
            const glm::vec3 &a = mesh.vertices[t.x], &b = mesh.vertices[t.y],
                            &c = mesh.vertices[t.z];
            differs += facing(a, b, c, l, mesh.scale) != fusedFacing(a, b, c, l, mesh.scale);
        }
    EXPECT_GT(differs, 0u);
}

TEST(SilhouetteTest, wrongSignsAreRareAndOnlyWhereTheLightIsInThePlane)
{
    for (const double offset : {0.0, 1e4, 1e6})
        for (HardCase hard : hardCases(offset))
        {
            hard.lights.resize(5);
            const EdgeMesh mesh = hard.build();
            std::size_t wrong = 0;
            double worst = 0.0;
            for (const glm::dvec4& light : hard.lights)
            {
                const MeshLight l = toMeshLight(mesh, light);
                for (const glm::uvec3& t : mesh.triangles)
                {
                    const glm::vec3 &a = mesh.vertices[t.x], &b = mesh.vertices[t.y],
                                    &c = mesh.vertices[t.z];
                    if (facing(a, b, c, l, mesh.scale) == exactFacing(a, b, c, l))
                        continue;
                    ++wrong;
                    // The determinant over the product of the vectors' lengths: 1 for a corner of a
                    // cube.
                    const glm::dvec3 v = glm::dvec3(l.light) + glm::dvec3(l.rest) -
                                         glm::dvec3(a) * double(l.light.w);
                    const glm::dvec3 u = glm::dvec3(c) - glm::dvec3(a);
                    const glm::dvec3 e = glm::dvec3(b) - glm::dvec3(a);
                    worst = std::max(worst, std::abs(glm::dot(glm::cross(u, v), e)) /
                                                (glm::length(u) * glm::length(v) * glm::length(e)));
                }
            }
            const double share =
                double(wrong) /
                double(std::max<std::size_t>(1, hard.lights.size() * mesh.triangles.size()));
            std::cout << hard.name << " at " << offset << ": " << 100.0 * share
                      << " % differ from the exact sign, at most " << worst << " from the plane\n";
            // Five roundings of 2^-24 each, and a factor for products that cancel.
            EXPECT_LT(worst, 6e-7) << hard.name << offset;
        }
}

TEST(SilhouetteTest, theNumberOfThreadsMakesNoDifference)
{
    const HardCase hard = grazingTriangles(300000);
    const EdgeMesh mesh = hard.build();
    const MeshLight light = toMeshLight(mesh, hard.lights[0]);
    const Silhouette one = silhouetteOf(mesh, light, 1);
    for (const unsigned int threads : {0u, 2u, 3u, 7u})
    {
        const Silhouette many = silhouetteOf(mesh, light, threads);
        ASSERT_EQ(many.sides.size(), one.sides.size());
        for (std::size_t i = 0; i != one.sides.size(); ++i)
        {
            EXPECT_EQ(many.sides[i].weight, one.sides[i].weight);
            EXPECT_EQ(many.sides[i].indices, one.sides[i].indices);
        }
        EXPECT_EQ(many.nearCaps, one.nearCaps);
        EXPECT_EQ(many.farCaps, one.farCaps);
    }
}

TEST(SilhouetteTest, anEmptyMeshHasNone)
{
    const Silhouette silhouette = silhouetteOf(EdgeMesh(), {{0, 0, 1, 1}, {}}, 4);
    EXPECT_TRUE(silhouette.sides.empty());
    EXPECT_TRUE(silhouette.nearCaps.empty());
}
