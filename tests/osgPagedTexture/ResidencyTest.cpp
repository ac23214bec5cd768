// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/Residency.h>
#include <osgPagedTexture/ThreadClock.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace
{

using namespace osgPagedTexture;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

std::vector<std::uint64_t> bytesOf(int side)
{
    std::vector<std::uint64_t> bytes;
    for (int level = 0; level < levelCount(side, side); ++level)
        bytes.push_back(chainBytes(BlockFormat::BC1, side, side, level));
    return bytes;
}

const std::vector<std::uint64_t>& large()
{
    static const std::vector<std::uint64_t> bytes = bytesOf(1024);
    return bytes;
}

ResidencyWish wish(double need, const std::vector<std::uint64_t>& bytes = large())
{
    ResidencyWish result;
    result.bytes = bytes.data();
    result.levels = int(bytes.size());
    result.need = need;
    return result;
}

std::uint64_t sum(const std::vector<ResidencyWish>& wishes, const ResidencyPlan& plan)
{
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < wishes.size(); ++i)
        bytes += plan.first[i] < 0 ? 0 : wishes[i].bytes[plan.first[i]];
    return bytes;
}

TEST(ResidencyTest, texturesThatFitTogetherAreLoadedWholeWhereTheyAreInView)
{
    const std::vector<ResidencyWish> wishes = {wish(3.0), wish(ResidencyWish::None)};
    const ResidencyPlan plan = planResidency(wishes, 2 * large()[0]);
    EXPECT_TRUE(plan.isWhole);
    EXPECT_EQ(plan.first, (std::vector<int>{0, -1}));
}

TEST(ResidencyTest, texturesThatWishNothingCountForWhetherAllFit)
{
    const std::vector<ResidencyWish> wishes = {wish(3.0)};
    EXPECT_TRUE(planResidency(wishes, 2 * large()[0], large()[0]).isWhole);
    const ResidencyPlan plan = planResidency(wishes, 2 * large()[0], large()[0] + 1);
    EXPECT_FALSE(plan.isWhole);
    EXPECT_EQ(plan.first, std::vector<int>{3});
}

TEST(ResidencyTest, whatFitsGetsTheLevelThatItNeeds)
{
    const std::vector<ResidencyWish> wishes = {wish(1.9), wish(3.0), wish(7.2)};
    const ResidencyPlan plan = planResidency(wishes, large()[0]);
    EXPECT_FALSE(plan.isWhole);
    EXPECT_EQ(plan.bias, 0.0);
    EXPECT_EQ(plan.first, (std::vector<int>{1, 3, 7}));
    EXPECT_EQ(plan.bytes, sum(wishes, plan));
}

TEST(ResidencyTest, theLeastNeededGoesFirst)
{
    const std::vector<ResidencyWish> wishes = {wish(0.1), wish(0.9)};
    const ResidencyPlan plan = planResidency(wishes, large()[0] + large()[1]);
    EXPECT_EQ(plan.first, (std::vector<int>{0, 1}));
    EXPECT_GT(plan.bias, 0.0);
}

TEST(ResidencyTest, whatIsInViewPushesOutWhatIsNot)
{
    std::vector<ResidencyWish> wishes = {wish(0.0), wish(ResidencyWish::None)};
    wishes[1].resident = 0;
    EXPECT_EQ(planResidency(wishes, large()[0]).first, (std::vector<int>{0, -1}));
    EXPECT_EQ(planResidency(wishes, large()[0] + large()[2]).first, (std::vector<int>{0, 2}));
}

TEST(ResidencyTest, whatWillBeInViewComesBeforeWhatWas)
{
    std::vector<ResidencyWish> wishes = {wish(0.0), wish(ResidencyWish::None),
                                         wish(ResidencyWish::None)};
    wishes[1].resident = 0;
    wishes[2].soon = 1.0;
    EXPECT_EQ(planResidency(wishes, large()[0] + large()[1]).first, (std::vector<int>{0, -1, 1}));
}

TEST(ResidencyTest, theLongestOutOfViewGoesFirst)
{
    std::vector<ResidencyWish> wishes(3, wish(ResidencyWish::None));
    for (ResidencyWish& each : wishes)
        each.resident = 0;
    wishes[0].lastUsed = 5;
    wishes[1].lastUsed = 9;
    wishes[2].lastUsed = 7;
    EXPECT_EQ(planResidency(wishes, 2 * large()[0]).first, (std::vector<int>{-1, 0, 0}));
}

TEST(ResidencyTest, aNeedThatWaversAroundALevelMovesNothing)
{
    std::vector<ResidencyWish> wishes = {wish(1.95), wish(1.5)};
    const std::uint64_t budget = 2 * large()[1];
    wishes[0].resident = 1;
    wishes[1].resident = 1;
    wishes[0].need = 2.1;
    EXPECT_EQ(planResidency(wishes, budget).first[0], 1);
    wishes[0].need = 2.5;
    wishes[1].need = 0.5;
    EXPECT_EQ(planResidency(wishes, large()[0] + large()[2]).first, (std::vector<int>{2, 0}));
}

TEST(ResidencyTest, aBudgetBelowThePreviewsLeavesTheLeastNeededOut)
{
    const std::vector<ResidencyWish> wishes = {wish(9.0), wish(2.0), wish(5.0)};
    EXPECT_EQ(planResidency(wishes, 16).first, (std::vector<int>{-1, 10, 10}));
    EXPECT_EQ(planResidency(wishes, 7).first, (std::vector<int>{-1, -1, -1}));
    EXPECT_EQ(planResidency(wishes, 0).bytes, 0u);
}

TEST(ResidencyTest, needsThatAreNoNumbersAreNone)
{
    std::vector<ResidencyWish> wishes = {wish(NaN), wish(-Infinity), wish(Infinity), wish(1e300),
                                         ResidencyWish()};
    wishes[0].soon = NaN;
    wishes[4].need = 0.0;
    const ResidencyPlan plan = planResidency(wishes, 3 * large()[0]);
    EXPECT_EQ(plan.first, (std::vector<int>{-1, -1, 10, 10, -1}));
    EXPECT_TRUE(planResidency({}, 100).first.empty());
}

TEST(ResidencyTest, noRandomPlanIsOverItsBudgetAndEachIsTheSameTwice)
{
    std::mt19937 random(3);
    const std::vector<std::vector<std::uint64_t>> tables = {bytesOf(1), bytesOf(64), bytesOf(512),
                                                            bytesOf(4096)};
    for (int round = 0; round < 2000; ++round)
    {
        std::vector<ResidencyWish> wishes;
        for (unsigned int i = random() % 40; i > 0; --i)
        {
            wishes.push_back(wish(double(random() % 1500) / 100.0 - 1.0, tables[random() % 4]));
            wishes.back().soon = double(random() % 1500) / 100.0 - 1.0;
            wishes.back().resident = int(random() % (wishes.back().levels + 1)) - 1;
            wishes.back().lastUsed = random() % 10;
        }
        const std::uint64_t budget = std::uint64_t(1) << (random() % 30);
        const ResidencyPlan plan = planResidency(wishes, budget);
        ASSERT_LE(plan.bytes, budget);
        ASSERT_EQ(plan.bytes, sum(wishes, plan));
        ASSERT_EQ(plan.first, planResidency(wishes, budget).first);
    }
}

TEST(ResidencyTest, aPlanThatIsCarriedOutIsKept)
{
    std::mt19937 random(4);
    for (int round = 0; round < 500; ++round)
    {
        std::vector<ResidencyWish> wishes;
        for (int i = 0; i < 20; ++i)
            wishes.push_back(wish(double(random() % 1200) / 100.0 - 1.0));
        const std::uint64_t budget = large()[0] * (1 + random() % 8) / 2;
        const ResidencyPlan plan = planResidency(wishes, budget);
        for (std::size_t i = 0; i < wishes.size(); ++i)
            wishes[i].resident = plan.first[i];
        ASSERT_EQ(planResidency(wishes, budget).first, plan.first);
    }
}

TEST(ResidencyTest, fiftyThousandTexturesFillTheBudget)
{
    std::mt19937 random(5);
    std::vector<ResidencyWish> wishes;
    for (int i = 0; i < 50000; ++i)
    {
        wishes.push_back(wish(double(random() % 1200) / 100.0 - 1.0));
        wishes.back().resident = int(random() % 12) - 1;
        wishes.back().lastUsed = random() % 1000;
    }
    constexpr std::uint64_t budget = 500u << 20;
    const double start = threadMilliseconds();
    const ResidencyPlan plan = planResidency(wishes, budget);
    RecordProperty("milliseconds", std::to_string(threadMilliseconds() - start));
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < wishes.size(); ++i)
        bytes += plan.first[i] < 0 ? 0 : large()[std::size_t(plan.first[i])];
    EXPECT_EQ(bytes, plan.bytes);
    EXPECT_LE(bytes, budget);
    EXPECT_GT(bytes, budget - budget / 100) << "what fits is there";
}

} // namespace
