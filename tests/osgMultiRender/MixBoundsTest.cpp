// SPDX-License-Identifier: MIT
#include "osgMultiRender/KeySets.h"

#include <osgMultiRender/MixBounds.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace osgMultiRender;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
using AllBounds = std::vector<MixWeights::Bounds>;

/// What random positions of a solid show.
struct Seen
{
    AllBounds bounds;

    Seen(std::size_t size) : bounds(size, {Infinity, -Infinity}) {}
    void add(const std::vector<double>& weights)
    {
        for (std::size_t i = 0; i < weights.size(); ++i)
        {
            bounds[i].low = std::min(bounds[i].low, weights[i]);
            bounds[i].high = std::max(bounds[i].high, weights[i]);
        }
    }
};

glm::dvec3 pointOf(const MixBox& box, std::mt19937& random)
{
    glm::dvec3 share = randomIn(random, 1.0);
    for (int axis = 0; axis < 3; ++axis) // sides and corners, too
        if (random() % 3 == 0)
            share[axis] = share[axis] < 0.0 ? -1.0 : 1.0;
    return box.center + share.x * box.halfAxes[0] + share.y * box.halfAxes[1] +
           share.z * box.halfAxes[2];
}

MixBox randomBox(std::mt19937& random, const KeySet& set)
{
    MixBox box;
    box.center = set.place(random);
    for (glm::dvec3& axis : box.halfAxes)
        axis = randomIn(random, set.radius * (random() % 2 ? 0.5 : 0.05));
    return box;
}

MixWeights randomMix(std::mt19937& random, double radius)
{
    std::vector<MixRange> ranges(3);
    for (MixRange& range : ranges)
    {
        double limits[4];
        for (double& limit : limits)
            limit = radius * double(random() % 9) / 8.0;
        std::sort(std::begin(limits), std::end(limits));
        range = {limits[0], limits[1], limits[2], random() % 3 ? limits[3] : Infinity};
    }
    MixRules rules;
    rules.excess = random() % 2 ? MixRules::Excess::Clamp : MixRules::Excess::Normalise;
    rules.base = int(random() % 4) - 1;
    return MixWeights(ranges, rules);
}

void expectWithin(const Seen& seen, const AllBounds& bounds)
{
    ASSERT_EQ(seen.bounds.size(), bounds.size());
    for (std::size_t i = 0; i < bounds.size(); ++i)
    {
        // Rounding of the weights alone.
        ASSERT_GE(seen.bounds[i].low, bounds[i].low - 1e-12) << i;
        ASSERT_LE(seen.bounds[i].high, bounds[i].high + 1e-12) << i;
    }
}

} // namespace

TEST(MixBounds, boxesAndSpheresHoldAllSampledWeights)
{
    std::mt19937 random(5);
    std::size_t zeros = 0, zerosSeen = 0, ones = 0, onesSeen = 0;
    for (const KeySet& set : makeKeySets(50, 10))
        for (int round = 0; round < 60; ++round)
        {
            SCOPED_TRACE(set.name + " " + std::to_string(round));
            const KeyPoints keys(set.points, AllKeyModes[round % 3]);
            const MixWeights weights = randomMix(random, set.radius);
            const MixBox box = randomBox(random, set);
            const auto ofBox = weightsOver(keys, weights, box);
            const auto ofSphere = weightsOver(keys, weights, box.center, box.radius());
            Seen seen(ofBox.size());
            for (int i = 0; i < 400; ++i)
                seen.add(weights.at(keys.distance(pointOf(box, random))));
            ASSERT_NO_FATAL_FAILURE(expectWithin(seen, ofBox));
            ASSERT_NO_FATAL_FAILURE(expectWithin(seen, ofSphere));
            for (std::size_t i = 0; i < ofBox.size(); ++i)
            {
                zeros += ofBox[i].isZero();
                zerosSeen += seen.bounds[i].high <= 0.0;
                ones += ofBox[i].isOne();
                onesSeen += seen.bounds[i].low >= 1.0;
            }
        }
    std::printf("0 everywhere: %zu proven of %zu; 1 everywhere: %zu of %zu\n", zeros, zerosSeen,
                ones, onesSeen);
    // What cannot be proven with 128 distances touches the boundary; samples miss corners, too.
    EXPECT_GT(double(zeros), 0.9 * double(zerosSeen));
    EXPECT_GT(double(ones), 0.85 * double(onesSeen));
}

TEST(MixBounds, provesAWallBesideTheRangeThatItsSphereTouches)
{
    // A wall of 20 x 20 at 3 from the point: its sphere reaches the point, the wall does not.
    const KeyPoints keys({{0, 0, 3}});
    const MixWeights weights({{0, 0, 1, 2}, {2.5, 2.5, Infinity, Infinity}});
    const MixBox wall = MixBox::from({-10, -10, 0}, {10, 10, 0});
    const auto ofBox = weightsOver(keys, weights, wall);
    EXPECT_TRUE(ofBox[0].isZero());
    EXPECT_TRUE(ofBox[1].isOne());
    EXPECT_FALSE(weightsOver(keys, weights, wall.center, wall.radius())[0].isZero());
}

TEST(MixBounds, theMatrixOfTheDrawableCounts)
{
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(100, 0, 0));
    matrix = glm::rotate(matrix, 1.0, glm::dvec3(0, 0, 1));
    matrix = glm::scale(matrix, glm::dvec3(2.0));
    const MixBox box = MixBox::from({-1, -1, -1}, {1, 1, 1}, matrix);
    EXPECT_NEAR(box.radius(), 2.0 * std::sqrt(3.0), 1e-12);
    EXPECT_EQ(box.center, glm::dvec3(100, 0, 0));
    const KeyPoints keys({{0, 0, 0}});
    EXPECT_TRUE(weightsOver(keys, MixWeights({{0, 0, 90, 96}}), box)[0].isZero());
    EXPECT_FALSE(weightsOver(keys, MixWeights({{0, 0, 90, 98}}), box)[0].isZero());
}

TEST(MixBounds, theMarginWidens)
{
    const KeyPoints keys({{0, 0, 0}});
    const MixWeights weights({{0, 0, 1, 2}});
    const MixBox box = MixBox::from({2.5, -0.1, -0.1}, {2.6, 0.1, 0.1});
    EXPECT_TRUE(weightsOver(keys, weights, box)[0].isZero());
    EXPECT_TRUE(weightsOver(keys, weights, box, 0.4)[0].isZero());
    EXPECT_FALSE(weightsOver(keys, weights, box, 0.6)[0].isZero());
}

TEST(MixBounds, withoutKeyPointsOnlyEndlessRangesShow)
{
    const MixWeights weights({{0, 0, 1, 2}, {1, 2, Infinity, Infinity}});
    const auto bounds = weightsOver(KeyPoints(), weights, MixBox::from({-1, -1, -1}, {1, 1, 1}));
    EXPECT_TRUE(bounds[0].isZero());
    EXPECT_TRUE(bounds[1].isOne());
}

TEST(MixBounds, whatIsNoSolidProvesNothing)
{
    const KeyPoints keys({{0, 0, 0}});
    const MixWeights weights({{100, 100, 200, 200}});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto provesNothing = [](const AllBounds& bounds)
    { return bounds[0].low == 0.0 && bounds[0].high == 1.0; };
    EXPECT_TRUE(provesNothing(weightsOver(keys, weights, glm::dvec3(nan), 1.0)));
    EXPECT_TRUE(provesNothing(weightsOver(keys, weights, glm::dvec3(0.0), -1.0)));
    EXPECT_TRUE(provesNothing(weightsOver(keys, weights, glm::dvec3(0.0), Infinity)));
    EXPECT_TRUE(provesNothing(
        weightsOver(keys, weights, MixBox::from(glm::dvec3(Infinity), glm::dvec3(-Infinity)))));
}
