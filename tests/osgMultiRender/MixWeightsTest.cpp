// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixWeights.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using osgMultiRender::MixRange;
using osgMultiRender::MixRules;
using osgMultiRender::MixWeights;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

MixRules makeRules(MixRules::Excess excess, int base, const glm::dvec4& background = {})
{
    MixRules rules;
    rules.excess = excess;
    rules.base = base;
    rules.background = background;
    return rules;
}

void expectWeights(const MixRange& range, const std::vector<std::pair<double, double>>& expected)
{
    for (const auto& [distance, weight] : expected)
        EXPECT_DOUBLE_EQ(range.weight(distance), weight) << "at " << distance;
}

/// Any order, equal ones, negative ones, infinities; now and then what is no number.
double randomLimit(std::mt19937& random)
{
    switch (random() % 12)
    {
    case 0:
        return Infinity;
    case 1:
        return -Infinity;
    case 2:
        return random() % 4 ? 3.0 : NaN;
    default:
        return double(random() % 33) / 4.0 - 1.0;
    }
}

MixWeights randomWeights(std::mt19937& random)
{
    std::vector<MixRange> ranges(1 + random() % 5);
    for (MixRange& range : ranges)
        range = {randomLimit(random), randomLimit(random), randomLimit(random),
                 randomLimit(random)};
    return MixWeights(
        ranges, makeRules(random() % 2 ? MixRules::Excess::Clamp : MixRules::Excess::Normalise,
                          int(random() % 7) - 1));
}

} // namespace

TEST(MixWeights, riseStayAndFall)
{
    expectWeights({1, 2, 3, 5}, {{0, 0},
                                 {1, 0},
                                 {1.25, 0.25},
                                 {2, 1},
                                 {2.5, 1},
                                 {3, 1},
                                 {4, 0.5},
                                 {5, 0},
                                 {6, 0},
                                 {Infinity, 0},
                                 {NaN, 0}});
}

TEST(MixWeights, equalDistancesAreStepsThatBelongToTheMaximum)
{
    expectWeights({1, 1, 2, 2}, {{0.999, 0}, {1, 1}, {2, 1}, {2.001, 0}});
    expectWeights({0, 0, 0, 0}, {{0, 1}, {1e-300, 0}});
    expectWeights({0, 0, 0.5, 0.8}, {{0, 1}, {0.5, 1}, {0.8, 0}});
}

TEST(MixWeights, wrongOrderCountsAsEqualToTheOneBefore)
{
    expectWeights({3, 1, 2, 0}, {{2.9, 0}, {3, 1}, {3.1, 0}});
    expectWeights({0, 2, 1, 4}, {{1, 0.5}, {2, 1}, {3, 0.5}, {4, 0}});
}

TEST(MixWeights, negativeDistancesLieBeforeAll)
{
    expectWeights({-4, -2, 1, 2}, {{0, 1}, {1, 1}, {1.5, 0.5}});
    expectWeights({-1, 1, 2, 3}, {{0, 0.5}, {1, 1}});
    expectWeights({-4, -3, -2, -1}, {{0, 0}, {1, 0}});
}

TEST(MixWeights, infiniteDistancesAreLimits)
{
    expectWeights({1, 2, 3, Infinity}, {{2, 1}, {1e30, 1}, {Infinity, 1}});
    expectWeights({1, 2, Infinity, Infinity}, {{1.5, 0.5}, {Infinity, 1}});
    expectWeights({1, Infinity, 0, 0}, {{1, 0}, {1e30, 0}, {Infinity, 0}});
    expectWeights({Infinity, Infinity, Infinity, Infinity}, {{0, 0}, {Infinity, 0}});
    expectWeights({-Infinity, 2, 3, 4}, {{0, 1}, {3.5, 0.5}});
    expectWeights({-Infinity, -Infinity, -Infinity, 4}, {{0, 1}, {4, 1}, {5, 0}});
    expectWeights({-1e308, 1e308, 1e308, 1e308}, {{0, 0}}); // beyond 1e30: infinite
}

TEST(MixWeights, whatIsNotANumberNeverShows)
{
    for (int i = 0; i < 4; ++i)
    {
        double values[] = {0, 0, 1, 1};
        values[i] = NaN;
        expectWeights({values[0], values[1], values[2], values[3]},
                      {{0, 0}, {1, 0}, {Infinity, 0}});
    }
}

TEST(MixWeights, clampedAsThePaperHasIt)
{
    const MixWeights weights({{0, 0, 1, 2}, {0, 0, 1, 2}});
    const std::vector<glm::dvec3> colors = {{0.75, 0.25, 0.0}, {0.5, 0.25, 0.0}};
    EXPECT_EQ(weights.mix(0.5, colors), glm::dvec4(1.0, 0.5, 0.0, 1.0));
    EXPECT_EQ(weights.mix(1.75, colors), glm::dvec4(0.3125, 0.125, 0.0, 0.5));
    EXPECT_EQ(weights.mix(3.0, colors), glm::dvec4(0.0));
}

TEST(MixWeights, normalisedWhereAboveOne)
{
    const MixWeights weights({{0, 0, 1, 2}, {0, 0, 1, 2}, {0, 0, 1, 3}},
                             makeRules(MixRules::Excess::Normalise, -1));
    EXPECT_EQ(weights.at(0.0), (std::vector<double>{1.0 / 3, 1.0 / 3, 1.0 / 3, 0.0}));
    // 0 + 0 + 0.25: less than 1 stays.
    EXPECT_EQ(weights.at(2.5), (std::vector<double>{0.0, 0.0, 0.25, 0.75}));
}

TEST(MixWeights, theBaseTakesWhatIsMissing)
{
    const MixWeights weights({{0, 0, 1, 2}, {9, 9, 9, 9}}, makeRules(MixRules::Excess::Clamp, 1));
    EXPECT_EQ(weights.at(1.75), (std::vector<double>{0.25, 0.75, 0.0}));
    EXPECT_EQ(weights.at(5.0), (std::vector<double>{0.0, 1.0, 0.0}));
    EXPECT_EQ(weights.mix(5.0, {{1, 0, 0}, {0, 1, 0}}), glm::dvec4(0, 1, 0, 1));
}

TEST(MixWeights, theBackgroundTakesWhatIsMissingByItsAlpha)
{
    const MixWeights weights({{0, 0, 1, 2}},
                             makeRules(MixRules::Excess::Clamp, 7, {0.5, 0.0, 1.0, 0.5}));
    EXPECT_EQ(weights.getRules().base, -1) << "a base that is no rendering";
    EXPECT_EQ(weights.mix(5.0, {{1, 1, 1}}), glm::dvec4(0.25, 0.0, 0.5, 0.5));
    EXPECT_EQ(weights.mix(1.5, {{1, 1, 1}}), glm::dvec4(0.625, 0.5, 0.75, 0.75));
}

TEST(MixWeights, withoutRenderingsTheBackgroundShows)
{
    EXPECT_EQ(MixWeights().at(1.0), std::vector<double>{1.0});
    EXPECT_EQ(MixWeights({}, makeRules(MixRules::Excess::Normalise, 0, {1, 0, 0, 1})).mix(1.0, {}),
              glm::dvec4(1, 0, 0, 1));
}

TEST(MixWeights, boundsHoldAllWeightsAndAreReached)
{
    std::mt19937 random(4);
    for (int round = 0; round < 3000; ++round)
    {
        const MixWeights weights = randomWeights(random);
        const double low = double(random() % 40) / 4.0;
        const double high = random() % 10 ? low + double(random() % 24) / 8.0 : Infinity;
        const auto bounds = weights.over(low, high);
        std::vector<MixWeights::Bounds> seen(bounds.size(), {Infinity, -Infinity});
        // Quarters are sampled, where all slopes begin and end.
        const double end = std::min(high, low + 40.0);
        for (int i = 0; i <= 1600 && low + i / 40.0 <= end; ++i)
        {
            const double at = low + i / 40.0; // and both sides of each step
            for (const double beside : {at, std::nextafter(at, low), std::nextafter(at, end)})
            {
                const auto values = weights.at(beside);
                for (std::size_t k = 0; k < values.size(); ++k)
                {
                    ASSERT_GE(values[k], bounds[k].low - 1e-12) << round << ", at " << beside;
                    ASSERT_LE(values[k], bounds[k].high + 1e-12) << round << ", at " << beside;
                    seen[k].low = std::min(seen[k].low, values[k]);
                    seen[k].high = std::max(seen[k].high, values[k]);
                }
            }
        }
        for (std::size_t k = 0; k < bounds.size(); ++k)
        {
            // The steepest slope is 4 a unit, for each of 5 in a sum; samples lie 1/40 apart.
            ASSERT_NEAR(seen[k].low, bounds[k].low, 0.5) << round;
            ASSERT_NEAR(seen[k].high, bounds[k].high, 0.5) << round;
            ASSERT_EQ(bounds[k].isZero(), seen[k].high <= 0.0) << round << ", " << k;
        }
    }
}

TEST(MixWeights, noDistancesProveNothing)
{
    const MixWeights weights({{0, 0, 1, 2}});
    for (const auto& [low, high] : {std::pair(2.0, 1.0), std::pair(NaN, 1.0), std::pair(0.0, NaN)})
    {
        const auto bounds = weights.over(low, high);
        EXPECT_EQ(bounds[0].low, 0.0);
        EXPECT_EQ(bounds[0].high, 1.0);
    }
}
