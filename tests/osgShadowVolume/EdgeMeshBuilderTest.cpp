// SPDX-License-Identifier: MIT
#include "SilhouetteMeshes.h"

#include <osgShadowVolume/EdgeMeshBuilder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace osgShadowVolume;

namespace
{

bool isBefore(const glm::vec3& a, const glm::vec3& b)
{
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

const EdgeMesh::Group* groupOf(const EdgeMesh& mesh, std::uint32_t opposites)
{
    for (const EdgeMesh::Group& group : mesh.groups)
        if (group.opposites == opposites)
            return &group;
    return nullptr;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The opposite vertices of each edge, by looking at all triangles one by one.
std::map<Edge, std::multiset<std::uint32_t>> oppositesByHand(const EdgeMesh& mesh)
{
    std::map<Edge, std::multiset<std::uint32_t>> opposites;
    for (const glm::uvec3& t : mesh.triangles)
    {
        opposites[{t.x, t.y}].insert(t.z);
        opposites[{t.x, t.z}].insert(t.y);
        opposites[{t.y, t.z}].insert(t.x);
    }
    return opposites;
}

std::map<Edge, std::multiset<std::uint32_t>> oppositesOf(const EdgeMesh& mesh)
{
    std::map<Edge, std::multiset<std::uint32_t>> opposites;
    for (const EdgeMesh::Group& group : mesh.groups)
        for (std::size_t at = 0; at != group.indices.size(); at += 2 + group.opposites)
        {
            const std::uint32_t* record = group.indices.data() + at;
            for (std::uint32_t i = 2; i != 2 + group.opposites; ++i)
                if (record[i] != record[0])
                    opposites[{record[0], record[1]}].insert(record[i]);
        }
    return opposites;
}

} // namespace

TEST(EdgeMeshBuilderTest, nothingIsAnEmptyMesh)
{
    const EdgeMesh mesh = EdgeMeshBuilder().build();
    EXPECT_TRUE(mesh.vertices.empty());
    EXPECT_TRUE(mesh.triangles.empty());
    EXPECT_TRUE(mesh.groups.empty());
    EXPECT_EQ(mesh.scale, 1.0f);
}

TEST(EdgeMeshBuilderTest, zerosOfBothSignsWeld)
{
    EdgeMeshBuilder builder;
    builder.addTriangle({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    builder.addTriangle({-0.0f, 0.0f, -0.0f}, {1.0f, -0.0f, 0.0f}, {0.0f, -1.0f, 0.0f});
    const EdgeMesh mesh = builder.build();
    EXPECT_EQ(mesh.vertices.size(), 4u);
    for (const glm::vec3& v : mesh.vertices)
        for (int i = 0; i < 3; ++i)
            EXPECT_FALSE(v[i] == 0.0f && std::signbit(v[i]));
    EXPECT_EQ(groupOf(mesh, 2)->indices.size(), 5u * 4u);
}

TEST(EdgeMeshBuilderTest, verticesAscendAndAreDistinct)
{
    const EdgeMesh mesh = grazingTriangles(100000).build();
    EXPECT_TRUE(std::is_sorted(mesh.vertices.begin(), mesh.vertices.end(), isBefore));
    EXPECT_EQ(std::adjacent_find(mesh.vertices.begin(), mesh.vertices.end()), mesh.vertices.end());
    for (const glm::uvec3& t : mesh.triangles)
        ASSERT_TRUE(t.x < t.y && t.y < t.z && t.z < mesh.vertices.size());
}

TEST(EdgeMeshBuilderTest, degenerateAndNonFiniteTrianglesAreCountedAndLeftOut)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EdgeMeshBuilder builder;
    builder.addTriangle(a, b, c);
    builder.addTriangle(a, a, c);
    builder.addTriangle(a, b, a);
    builder.addTriangle(a, b, b);
    builder.addTriangle({nan, 0, 0}, b, c);
    builder.addTriangle(a, {0, infinity, 0}, c);
    builder.addTriangle(a, b, {0, 0, -infinity});
    const EdgeMesh mesh = builder.build();
    EXPECT_EQ(mesh.degenerate, 3u);
    EXPECT_EQ(mesh.notFinite, 3u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(EdgeMeshBuilderTest, anEdgeOfOneTriangleHasItsFirstEndAsSecondOpposite)
{
    EdgeMeshBuilder builder;
    builder.addTriangle({2, 0, 0}, {0, 0, 0}, {1, 1, 0});
    const EdgeMesh mesh = builder.build();
    ASSERT_EQ(mesh.groups.size(), 1u);
    EXPECT_EQ(mesh.groups[0].opposites, 2u);
    EXPECT_EQ(mesh.groups[0].indices,
              (std::vector<std::uint32_t>{0, 1, 2, 0, 0, 2, 1, 0, 1, 2, 0, 1}));
}

TEST(EdgeMeshBuilderTest, edgesWithMoreTrianglesThanAPatchHoldsAreSplit)
{
    for (const unsigned int count : {3u, 29u, 30u, 31u, 33u, 100u})
    {
        const EdgeMesh mesh = book(count).build();
        std::size_t spine = 0;
        for (const EdgeMesh::Group& group : mesh.groups)
            EXPECT_LE(group.opposites, EdgeMesh::MaxOpposites);
        const auto opposites = oppositesOf(mesh);
        for (const auto& [edge, list] : opposites)
            spine = std::max(spine, list.size());
        EXPECT_EQ(spine, count);
        EXPECT_EQ(opposites, oppositesByHand(mesh));
    }
}

TEST(EdgeMeshBuilderTest, eachEdgeHasTheOppositeVerticesOfAllItsTriangles)
{
    for (const HardCase& hard : hardCases(0.0))
    {
        const EdgeMesh mesh = hard.build();
        EXPECT_EQ(oppositesOf(mesh), oppositesByHand(mesh)) << hard.name;
        EXPECT_EQ(mesh.triangles.size() + mesh.degenerate, hard.triangles.size()) << hard.name;
    }
}

TEST(EdgeMeshBuilderTest, duplicatesAreKept)
{
    HardCase hard = book(5);
    const std::vector<HardCase::Triangle> once = hard.triangles;
    hard.triangles.insert(hard.triangles.end(), once.begin(), once.end());
    const EdgeMesh mesh = hard.build();
    EXPECT_EQ(mesh.triangles.size(), 10u);
    ASSERT_TRUE(groupOf(mesh, 10));
    EXPECT_EQ(groupOf(mesh, 2)->indices.size(), 10u * 4u);
}

TEST(EdgeMeshBuilderTest, theOrderOfTrianglesMattersToTheirListOnly)
{
    HardCase hard = hardCases(0.0)[1];
    const EdgeMesh mesh = hard.build();
    std::shuffle(hard.triangles.begin(), hard.triangles.end(), std::mt19937(1));
    const EdgeMesh shuffled = hard.build();
    EXPECT_EQ(mesh.vertices, shuffled.vertices);
    ASSERT_EQ(mesh.groups.size(), shuffled.groups.size());
    for (std::size_t i = 0; i != mesh.groups.size(); ++i)
        EXPECT_EQ(mesh.groups[i].indices, shuffled.groups[i].indices);
}

TEST(EdgeMeshBuilderTest, scaleTakesTheExtentToAboutOne)
{
    for (const double extent : {1e-38, 1e-20, 1e-3, 0.75, 1.0, 3.0, 1e7, 1e20, 3e38})
    {
        EdgeMeshBuilder builder;
        const float e = float(extent);
        builder.addTriangle({0, 0, 0}, {e, 0, 0}, {0, 0.25f * e, 0});
        const EdgeMesh mesh = builder.build();
        int exponent;
        EXPECT_EQ(std::frexp(mesh.scale, &exponent), 0.5f) << extent;
        EXPECT_GE(mesh.scale * extent, 0.5) << extent;
        EXPECT_LT(mesh.scale * extent, 8.0) << extent; // Beyond 1.7e38 the scale is the smallest.
        EXPECT_EQ(mesh.reach, e);
    }
}

TEST(EdgeMeshBuilderTest, aMillionTrianglesAreAllThere)
{
    const HardCase hard = grazingTriangles(1000000);
    const auto start = std::chrono::steady_clock::now();
    const EdgeMesh mesh = hard.build();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(mesh.triangles.size() + mesh.degenerate, hard.triangles.size());
    std::size_t bytes = sizeof(mesh) + mesh.vertices.capacity() * sizeof(mesh.vertices[0]) +
                        mesh.triangles.capacity() * sizeof(mesh.triangles[0]);
    std::size_t edges = 0;
    for (const EdgeMesh::Group& group : mesh.groups)
    {
        bytes += group.indices.capacity() * sizeof(group.indices[0]);
        edges += group.indices.size() / (2 + group.opposites);
    }
    std::cout << "1e6 triangles: " << time.count() << " s, " << double(bytes) / double(edges)
              << " bytes an edge\n";
}
