// SPDX-License-Identifier: MIT
#include "osgMultiRender/KeySets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using osgMultiRender::KeyMode;
using osgMultiRender::KeyPoints;
using osgMultiRender::KeySegment;
using osgMultiRender::KeyTree;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

double lookAtAll(const KeyTree& tree, const glm::dvec3& place)
{
    double nearest = Infinity;
    for (const KeySegment& segment : tree.getSegments())
        nearest = std::min(nearest, segment.distance(place));
    return nearest;
}

void compareWithBruteForce(const KeySet& set, KeyMode mode, std::mt19937& random, int places)
{
    const KeyPoints keys(set.points, mode);
    ASSERT_EQ(keys.getNumPoints() + keys.getNumLeftOut(), set.points.size());
    for (int i = 0; i < places; ++i)
    {
        const glm::dvec3 place = set.place(random);
        const double distance = keys.distance(place);
        ASSERT_EQ(distance, lookAtAll(keys.getTree(), place)) << i;
        const double brute = bruteDistance(set.points, mode, place);
        if (!std::isfinite(brute))
        {
            ASSERT_EQ(distance, brute);
            continue;
        }
        // Both round at the size of the coordinates, once for each of a dozen operations.
        const double scale = 2e7 + glm::length(place);
        ASSERT_NEAR(distance, brute,
                    12.0 * 1.2e-16 * (set.radius < 3.0 && set.name != "spread" ? 10.0 : scale))
            << i;
    }
}

double boxDistance(const KeyTree::Node::Child& box, const glm::dvec3& place)
{
    return glm::length(glm::max(glm::max(box.low - place, place - box.high), glm::dvec3(0.0)));
}

int depthOf(const KeyTree& tree, std::uint32_t node)
{
    int depth = 1;
    const KeyTree::Node& at = tree.getNodes()[node];
    for (std::uint32_t i = 0; i < at.used; ++i)
        if (at.children[i].count == 0)
            depth = std::max(depth, 1 + depthOf(tree, at.children[i].first));
    return depth;
}

} // namespace

TEST(KeyPoints, treeEqualsBruteForceForAllSetsAndModes)
{
    std::mt19937 random(1);
    for (const std::size_t count : {0, 1, 2, 3, 4, 5, 8, 9, 16, 17, 33, 100, 1000})
        for (const KeySet& set : makeKeySets(count, 7))
            for (const KeyMode mode : AllKeyModes)
            {
                SCOPED_TRACE(set.name + " " + std::to_string(count) + " mode " +
                             std::to_string(int(mode)));
                ASSERT_NO_FATAL_FAILURE(compareWithBruteForce(set, mode, random, 60));
            }
}

TEST(KeyPoints, treeEqualsBruteForceFor10000)
{
    std::mt19937 random(2);
    for (const KeySet& set : makeKeySets(10000, 8))
        for (const KeyMode mode : AllKeyModes)
        {
            SCOPED_TRACE(set.name);
            ASSERT_NO_FATAL_FAILURE(compareWithBruteForce(set, mode, random, 40));
        }
}

TEST(KeyPoints, cellsTellTheDistanceToTheNearestOfAll)
{
    std::mt19937 random(4);
    for (const std::size_t count : {5, 17, 100, 1000})
        for (const KeySet& set : makeKeySets(count, 5))
            for (const KeyMode mode : {KeyMode::Points, KeyMode::PolylineLoop})
            {
                const bool isEven = set.name == "random" || set.name == "far";
                if (count == 1000 && !isEven) // what is as far from many takes a second
                    continue;
                SCOPED_TRACE(set.name + " " + std::to_string(count));
                const KeyPoints keys(set.points, mode);
                const auto cells = keys.findCells(true);
                if (keys.getTree().getSegments().size() <= KeyTree::LeafSize)
                {
                    ASSERT_EQ(cells, nullptr);
                    continue;
                }
                int told = 0;
                for (int i = 0; i < 400; ++i)
                {
                    const glm::dvec3 place = set.place(random);
                    const std::optional<double> distance = cells->distance(place);
                    told += distance.has_value();
                    // Candidates are left out by planes in double precision.
                    if (distance)
                    {
                        ASSERT_NEAR(*distance, keys.distance(place),
                                    1e-14 * (*distance + glm::length(place)));
                    }
                }
                if (isEven)
                {
                    EXPECT_EQ(told, 400);
                }
            }
}

TEST(KeyPoints, fewSegmentsAreListedInACell)
{
    const KeyPoints keys(makeKeySets(1000, 5)[0].points);
    const osgMultiRender::KeyCells& cells = *keys.findCells(true);
    const osgMultiRender::KeyCells::Root& root = cells.getRoots()[0];
    std::mt19937 random(9);
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i)
    {
        const glm::dvec3 share = 0.5 + randomIn(random, 0.5);
        const glm::ivec3 place(share * 65535.0);
        std::int32_t cell = cells.getCells()[std::size_t(
            root.first + ((place.z >> 12) * 16 + (place.y >> 12)) * 16 + (place.x >> 12))];
        for (int shift = 11; cell > 0; --shift)
        {
            const glm::ivec3 part = place >> shift & 1;
            cell = cells.getCells()[std::size_t(cell + part.x + 2 * part.y + 4 * part.z)];
        }
        ASSERT_LT(cell, 0);
        sum += 4 * (1 + (-1 - cell) % 16);
    }
    EXPECT_LT(sum / 1000.0, 16.0); // 9 here, whole fours
}

TEST(KeyPoints, copiesShareTheirCellsAndOthersDoNot)
{
    const std::vector<glm::dvec3> points = makeKeySets(40, 5)[0].points;
    const KeyPoints keys(points), copy = keys, other(points);
    const auto cells = keys.findCells(true);
    EXPECT_EQ(copy.findCells(), cells);
    EXPECT_EQ(keys.getIdentity(), copy.getIdentity());
    EXPECT_NE(keys.getIdentity(), other.getIdentity());
    EXPECT_EQ(KeyPoints().findCells(true), nullptr);
}

TEST(KeyPoints, handComputedDistances)
{
    const std::vector<glm::dvec3> corners = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}};
    const glm::dvec3 place(2, 1, 0);
    EXPECT_DOUBLE_EQ(KeyPoints(corners).distance(place), std::sqrt(5.0));
    EXPECT_DOUBLE_EQ(KeyPoints(corners, KeyMode::Polyline).distance(place), 1.0);
    // The hypotenuse 3x - 4y = 0 is 2 / 5 away.
    EXPECT_DOUBLE_EQ(KeyPoints(corners, KeyMode::PolylineLoop).distance(place), 0.4);
}

TEST(KeyPoints, withoutPointsEverythingIsInfinitelyFar)
{
    for (const KeyMode mode : AllKeyModes)
    {
        EXPECT_EQ(KeyPoints({}, mode).distance({1, 2, 3}), Infinity);
        EXPECT_EQ(KeyPoints({{NaN, 0, 0}}, mode).distance({1, 2, 3}), Infinity);
    }
}

TEST(KeyPoints, onePointOrEqualPointsOfALoopAreAPoint)
{
    for (const KeyMode mode : AllKeyModes)
    {
        EXPECT_EQ(KeyPoints({{1, 0, 0}}, mode).distance({1, 3, 4}), 5.0);
        EXPECT_EQ(KeyPoints({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, mode).distance({1, 3, 4}), 5.0);
    }
}

TEST(KeyPoints, aLoopOfTwoIsTheirSegment)
{
    const KeyPoints keys({{0, 0, 0}, {2, 0, 0}}, KeyMode::PolylineLoop);
    EXPECT_EQ(keys.getTree().getSegments().size(), 1u);
    EXPECT_EQ(keys.distance({1, 1, 0}), 1.0);
}

TEST(KeyPoints, whatIsNotANumberIsLeftOutAndItsNeighboursAreJoined)
{
    const KeyPoints keys({{0, 0, 0}, {NaN, 5, 0}, {4, 0, 0}, {0, Infinity, 0}, {0, 0, 1e16}},
                         KeyMode::Polyline);
    EXPECT_EQ(keys.getNumPoints(), 2u);
    EXPECT_EQ(keys.getNumLeftOut(), 3u);
    EXPECT_EQ(keys.distance({2, 7, 0}), 7.0);
}

TEST(KeyPoints, aPositionThatIsNotANumberIsInfinitelyFar)
{
    const KeyPoints keys({{0, 0, 0}, {1, 0, 0}}, KeyMode::Polyline);
    for (const double bad : {NaN, Infinity, -Infinity, 1e300})
        EXPECT_EQ(keys.distance({0, bad, 0}), Infinity) << bad;
}

TEST(KeyPoints, pointsBeyondTheLimitAreLeftOut)
{
    const KeyPoints keys(std::vector<glm::dvec3>(KeyPoints::MaxPoints + 5));
    EXPECT_EQ(keys.getNumPoints(), KeyPoints::MaxPoints);
    EXPECT_EQ(keys.getNumLeftOut(), 5u);
    EXPECT_EQ(keys.distance({0, 2, 0}), 2.0);
    // Three more places of the stack for each level of nodes.
    EXPECT_LE(3 * depthOf(keys.getTree(), 0), KeyTree::MaxStack);
}

// What any walk has to open: leaves whose box is nearer than the nearest segment.
TEST(KeyPoints, fewOf10000PointsLieInBoxesNearerThanTheNearestOne)
{
    std::mt19937 random(3);
    for (const KeySet& set : makeKeySets(10000, 9))
    {
        // Lines between random points cross the whole set: no tree keeps them apart.
        const bool isPath = set.name == "path" || set.name == "circle";
        const KeyPoints keys(set.points, isPath ? KeyMode::Polyline : KeyMode::Points);
        double opened = 0.0;
        for (int i = 0; i < 200; ++i)
        {
            const glm::dvec3 place = set.place(random);
            const double distance = keys.distance(place);
            for (const KeyTree::Node& node : keys.getTree().getNodes())
                for (std::uint32_t child = 0; child < node.used; ++child)
                    if (boxDistance(node.children[child], place) < distance)
                        opened += node.children[child].count;
        }
        const double share = opened / 200.0 / double(keys.getTree().getSegments().size());
        std::printf("%-10s %.5f\n", set.name.c_str(), share);
        EXPECT_LT(share, 0.01) << set.name;
    }
}

// Cut before all cells have their candidates.
TEST(KeyPoints, cellsOfVeryManyPointsTellTheDistanceOrNothing)
{
    std::mt19937 random(5);
    const KeySet set = makeKeySets(osgMultiRender::KeyCells::MaxSegments, 5)[0];
    const KeyPoints keys(set.points);
    const auto cells = keys.findCells(true);
    for (int i = 0; i < 400; ++i)
    {
        const glm::dvec3 place = (i % 2 ? 1.0 : 5.0) * set.place(random);
        if (const std::optional<double> distance = cells->distance(place))
        {
            ASSERT_NEAR(*distance, keys.distance(place), 1e-14 * (*distance + glm::length(place)));
        }
    }
}
