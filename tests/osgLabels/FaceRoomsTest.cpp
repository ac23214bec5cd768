// SPDX-License-Identifier: MIT
// How much of the faces of what is no box text may use, so that it is cut nowhere.
#include "ShapeMeshes.h"

#include <osgLabels/Placement.h>
#include <osgLabels/ShapeFit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace osgLabels;

namespace
{

FittedShape fitOf(const ShapeMesh& mesh)
{
    return fitShape(mesh.vertices(), mesh.indices);
}

/// The rooms, smallest first: axes of fits may have any order.
std::vector<unsigned int> sortedRooms(const FittedShape& shape)
{
    std::vector<unsigned int> rooms{shape.rooms.x, shape.rooms.y, shape.rooms.z};
    std::sort(rooms.begin(), rooms.end());
    return rooms;
}

using Rooms = std::vector<unsigned int>;

/// With ends, of a profile that is seen whole from its first corner.
ShapeMesh closed(const std::vector<glm::dvec2>& profile, double half)
{
    ShapeMesh mesh = shapemesh::extrusion(profile, half);
    for (const double z : {-half, half})
    {
        const auto first = std::uint32_t(mesh.points.size());
        for (const glm::dvec2& p : profile)
            mesh.points.push_back({p, z});
        for (std::uint32_t i = 2; i < profile.size(); ++i)
            mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
    }
    return mesh;
}

std::vector<glm::dvec2> circle(int sides, double radius)
{
    std::vector<glm::dvec2> points;
    for (int i = 0; i < sides; ++i)
        points.push_back(
            radius * glm::dvec2(std::cos(6.2831853 * i / sides), std::sin(6.2831853 * i / sides)));
    return points;
}

} // namespace

TEST(FaceRoomsTest, boxesHaveAllOfTheirFaces)
{
    EXPECT_EQ(sortedRooms(fitOf(shapemesh::box({1.0, 0.7, 0.5}, false))), Rooms({15, 15, 15}));
    EXPECT_EQ(fitOf(shapemesh::box({1.0, 0.7, 0.5}, false)).record(1).shape, 1u);
}

TEST(FaceRoomsTest, aRoofHasTextOnItsGablesAloneAndWithinTheTriangle)
{
    // Two slopes of 42 degrees, which meet in a ridge, over a floor.
    const FittedShape roof = fitOf(closed({{-0.55, 0.0}, {0.55, 0.0}, {0.0, 0.5}}, 0.68));
    ASSERT_EQ(roof.shape, Shape::Extrusion);
    // The middle third of a triangle's box lies within the triangle, less what the grid is coarse.
    // The slopes face both other ways for a part, or fold.
    EXPECT_EQ(sortedRooms(roof), Rooms({0, 0, 4}));
    EXPECT_EQ(roof.rooms.z, 4u);
    // So much is kept off by the record.
    EXPECT_EQ(roof.record(1).shape >> RoomShift, 15u | 15u << 4 | 11u << 8);
}

TEST(FaceRoomsTest, stepsAndHolesAreKeptOff)
{
    // An L: its inner sides end at the other leg, its ends are not there in the middle.
    const FittedShape corner =
        fitOf(closed({{-1, -1}, {1, -1}, {1, -0.9}, {-0.9, -0.9}, {-0.9, 1}, {-1, 1}}, 2.0));
    ASSERT_EQ(corner.shape, Shape::Extrusion);
    EXPECT_EQ(corner.rooms.z, 0u);
    EXPECT_EQ(corner.rooms.x, 12u) << "a twentieth of the side, on both sides of the middle";
    EXPECT_EQ(corner.rooms.y, 12u);
    // A prism of eight sides has flat ones to the left and right, and above and below.
    const FittedShape nut = fitOf(closed(
        {{1, -0.4}, {1, 0.4}, {0.4, 1}, {-0.4, 1}, {-1, 0.4}, {-1, -0.4}, {-0.4, -1}, {0.4, -1}},
        0.5));
    if (nut.shape == Shape::Extrusion)
    {
        EXPECT_GE(nut.rooms.z, 9u);
        EXPECT_LE(nut.rooms.z, 11u) << "0.7 of the end's sides are within it";
    }
}

TEST(FaceRoomsTest, aFlatDiscHasTheSquareWithinIt)
{
    ShapeMesh disc;
    const std::vector<glm::dvec2> points = circle(48, 2.0);
    for (const glm::dvec2& p : points)
        disc.points.push_back({p, 0.0});
    for (std::uint32_t i = 2; i < points.size(); ++i)
        disc.indices.insert(disc.indices.end(), {0, i - 1, i});
    const FittedShape shape = fitOf(disc);
    ASSERT_EQ(shape.shape, Shape::Quad);
    EXPECT_EQ(shape.rooms.z, 10u); // of 15: 0.707
}

TEST(FaceRoomsTest, nothingIsPlacedBeyondTheRoom)
{
    ObjectRecord record;
    record.shape = std::uint32_t(Shape::Extrusion) | 10u << (RoomShift + 2 * RoomBits);
    record.size = {1.0f, 1.0f, 0.5f};
    PlacementView view;
    view.eye = glm::vec4(0, 0, 9, 1);
    view.up = {0, 1, 0};
    const glm::vec3 dx(1e-3f, 0, 0), dy(0, 1e-3f, 0);
    int inside = 0;
    for (float y = -0.995f; y < 1.0f; y += 0.01f)
        for (float x = -0.995f; x < 1.0f; x += 0.01f)
            for (const float width : {0.6f, 3.0f})
                if (placeOn(record, {x, y, 0.5f}, dx, dy, view, width).inside)
                {
                    ++inside;
                    EXPECT_LE(std::max(std::abs(x), std::abs(y)), 0.334f) << x << ' ' << y;
                }
    EXPECT_GT(inside, 100);
    record.shape = std::uint32_t(Shape::Extrusion) | 15u << (RoomShift + 2 * RoomBits);
    EXPECT_FALSE(placeOn(record, {0.0f, 0.0f, 0.5f}, dx, dy, view, 3.0f).inside);
}
