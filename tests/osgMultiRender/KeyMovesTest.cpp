// SPDX-License-Identifier: MIT
#include "osgMultiRender/KeySets.h"

#include <osgMultiRender/KeyMoves.h>

#include <gtest/gtest.h>

using namespace osgMultiRender;

namespace
{

/// With cells of its own.
KeyMoves makeMoves(const KeyPoints& keys)
{
    KeyMoves moves;
    keys.findCells(true);
    for (int frame = 0; frame < 2; ++frame)
        moves.update(keys);
    return moves;
}

/// Moves, adds or takes away a point.
void change(KeySet& set, int kind, std::mt19937& random)
{
    const std::size_t at = random() % set.points.size();
    const auto point = set.points.begin() + std::ptrdiff_t(at);
    if (kind % 3 == 0)
        *point = set.place(random);
    else if (kind % 3 == 1)
        set.points.insert(point, set.place(random));
    else
        set.points.erase(point);
}

/// The share of places that are told the distance, which is the right one.
double toldShare(const KeyMoves& moves, const KeySet& set, KeyMode mode, std::mt19937& random)
{
    const KeyPoints keys(set.points, mode);
    int told = 0;
    for (int i = 0; i < 200; ++i)
    {
        const glm::dvec3 place = set.place(random);
        const std::optional<double> distance = moves.distance(place);
        told += distance.has_value();
        // Candidates are left out by planes in double precision.
        if (distance)
        {
            EXPECT_NEAR(*distance, keys.distance(place), 1e-14 * (*distance + glm::length(place)));
        }
    }
    return told / 200.0;
}

} // namespace

TEST(KeyMoves, cellsStayRightWhilePointsMoveComeAndGo)
{
    std::mt19937 random(1);
    for (const std::size_t count : {20, 300})
        for (const KeyMode mode : {KeyMode::Points, KeyMode::PolylineLoop})
            for (KeySet set : makeKeySets(count, 3))
            {
                SCOPED_TRACE(set.name + " " + std::to_string(count));
                KeyMoves moves = makeMoves(KeyPoints(set.points, mode));
                for (int kind = 0; kind < 7; ++kind)
                {
                    change(set, kind, random);
                    moves.update(KeyPoints(set.points, mode));
                    toldShare(moves, set, mode, random);
                }
            }
}

TEST(KeyMoves, aDraggedPointTakesFewCellsAway)
{
    std::mt19937 random(2);
    KeySet set = makeKeySets(1000, 3)[0];
    KeyMoves moves = makeMoves(KeyPoints(set.points));
    EXPECT_EQ(toldShare(moves, set, KeyMode::Points, random), 1.0);
    for (int frame = 0; frame < 20; ++frame)
    {
        set.points[7] = randomIn(random, 1.0);
        moves.update(KeyPoints(set.points));
        EXPECT_GT(toldShare(moves, set, KeyMode::Points, random), 0.95);
        EXPECT_EQ(moves.getLoose().size(), 1u);
    }
}

TEST(KeyMoves, withoutCellsWhereManyMoveAndWithThoseThereWereWhenTheyAreBack)
{
    std::mt19937 random(3);
    const KeySet set = makeKeySets(1000, 3)[0];
    KeySet other = set;
    for (glm::dvec3& point : other.points)
        point += randomIn(random, 0.1);
    KeyMoves moves = makeMoves(KeyPoints(set.points));
    const auto cells = moves.getCells();
    moves.update(KeyPoints(other.points));
    EXPECT_EQ(moves.getCells(), nullptr);
    moves.update(KeyPoints(set.points, KeyMode::Polyline));
    EXPECT_EQ(moves.getCells(), nullptr);
    moves.update(KeyPoints(set.points));
    EXPECT_EQ(moves.getCells(), cells);
    EXPECT_TRUE(moves.isOwn());
}
