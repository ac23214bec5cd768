// SPDX-License-Identifier: MIT
#include <osgLabels/FeatureTree.h>

#include <gtest/gtest.h>

using osgLabels::FeatureTree;

namespace
{

bool isIn(std::uint32_t number, const FeatureTree::Range& range)
{
    return number >= range.first && number <= range.last;
}

class Features : public testing::Test
{
protected:
    bool isOf(FeatureTree::Part part, FeatureTree::Name name)
    {
        return isIn(tree.getNumber(part), tree.getRange(name));
    }

    FeatureTree tree;
};

} // namespace

TEST_F(Features, partsThatNoLabelNamesAreForeign)
{
    const auto house = tree.add(FeatureTree::Scene, 1, "house");
    EXPECT_EQ(tree.getNumber(house), FeatureTree::Foreign);
    EXPECT_EQ(tree.getNumber(FeatureTree::Scene), FeatureTree::Foreign);
    EXPECT_FALSE(isIn(FeatureTree::Foreign, tree.getRange(FeatureTree::None)));
    EXPECT_FALSE(isIn(0, tree.getRange(FeatureTree::None)));
    EXPECT_FALSE(isIn(FeatureTree::Foreign, tree.getRange(tree.use("none such"))));
}

TEST_F(Features, whatLiesInAFeatureIsOfIt)
{
    const auto house = tree.add(FeatureTree::Scene, 1, "house");
    const auto roof = tree.add(house, 2, "roof");
    const auto name = tree.use("house");
    EXPECT_TRUE(isOf(house, name));
    EXPECT_EQ(tree.getNumber(roof), tree.getNumber(house));
    const auto later = tree.add(roof, 3, "chimney");
    EXPECT_EQ(tree.getNumber(later), tree.getNumber(house));
    EXPECT_EQ(tree.add(roof, 3, "chimney"), later) << "once a key";
}

TEST_F(Features, featuresInsideOfAnotherHaveNumbersOfTheirOwnInItsRange)
{
    const auto city = tree.add(FeatureTree::Scene, 1, "city");
    const auto house = tree.add(city, 2, "house");
    const auto tower = tree.add(city, 3, "tower");
    const auto cityName = tree.use("city"), houseName = tree.use("house");
    EXPECT_NE(tree.getNumber(house), tree.getNumber(city));
    EXPECT_TRUE(isOf(house, cityName));
    EXPECT_TRUE(isOf(tower, cityName));
    EXPECT_FALSE(isOf(tower, houseName));
    EXPECT_FALSE(isOf(city, houseName));
}

TEST_F(Features, partsOfOneNameAreOneFeature)
{
    const auto a = tree.add(FeatureTree::Scene, 1, "tower");
    const auto between = tree.add(FeatureTree::Scene, 2, "house");
    const auto b = tree.add(FeatureTree::Scene, 3, "tower");
    const auto inner = tree.add(b, 4, "clock");
    const auto tower = tree.use("tower"), house = tree.use("house"), clock = tree.use("clock");
    EXPECT_EQ(tree.getNumber(a), tree.getNumber(b));
    EXPECT_FALSE(isOf(between, tower));
    EXPECT_TRUE(isOf(between, house));
    EXPECT_TRUE(isOf(inner, clock));
    EXPECT_FALSE(isOf(inner, house));
    EXPECT_TRUE(isOf(inner, tower)) << "in whichever it lies";
    EXPECT_NE(tree.getNumber(inner), tree.getNumber(b));
}

TEST_F(Features, aNameInsideOfItselfAndOfOthersHasOneRange)
{
    const auto tower = tree.add(FeatureTree::Scene, 1, "tower");
    const auto house = tree.add(tower, 2, "house");
    const auto again = tree.add(house, 3, "tower");
    const auto clock = tree.add(again, 4, "clock");
    const auto range = tree.getRange(tree.use("tower"));
    tree.use("house");
    tree.use("clock");
    for (const auto part : {tower, house, again, clock})
        EXPECT_TRUE(isOf(part, tree.use("tower")));
    EXPECT_LE(range.first, range.last);
    EXPECT_EQ(tree.getNumber(tower), tree.getNumber(again));
    EXPECT_FALSE(isOf(tower, tree.use("house")));
}

TEST_F(Features, labelledPartsAreFeaturesWhateverTheirName)
{
    const auto a = tree.add(FeatureTree::Scene, 1, "Building");
    const auto b = tree.add(FeatureTree::Scene, 2, "Building");
    tree.addLabel(a);
    tree.addLabel(b);
    EXPECT_NE(tree.getNumber(a), tree.getNumber(b));
    EXPECT_TRUE(isIn(tree.getNumber(a), tree.getRangeOfPart(a)));
    EXPECT_FALSE(isIn(tree.getNumber(b), tree.getRangeOfPart(a)));
}

TEST_F(Features, countsWhenNumbersChange)
{
    const auto house = tree.add(FeatureTree::Scene, 1, "house");
    tree.getNumber(house);
    const unsigned int before = tree.getModifiedCount();
    tree.add(house, 2, "roof");
    tree.getNumber(house);
    EXPECT_EQ(tree.getModifiedCount(), before) << "no label names it";
    tree.use("roof");
    tree.getNumber(house);
    EXPECT_GT(tree.getModifiedCount(), before);
    const unsigned int after = tree.getModifiedCount();
    tree.use("roof");
    tree.getNumber(house);
    EXPECT_EQ(tree.getModifiedCount(), after);
}

TEST_F(Features, aKeyThatComesAgainWithAnotherNameIsAnotherPart)
{
    const auto house = tree.use("house"), barn = tree.use("barn");
    const auto first = tree.add(FeatureTree::Scene, 1, "house");
    const auto second = tree.add(FeatureTree::Scene, 1, "barn");
    EXPECT_TRUE(isOf(second, barn));
    EXPECT_FALSE(isOf(second, house));
    EXPECT_EQ(tree.add(FeatureTree::Scene, 1, "barn"), second);
    EXPECT_TRUE(isOf(first, house));
}

TEST_F(Features, aPartStaysWhileItIsHeldOrSomethingInItIs)
{
    const auto house = tree.add(FeatureTree::Scene, 1, "house");
    const auto roof = tree.add(house, 2, "roof");
    tree.hold(house);
    tree.hold(roof);
    tree.hold(roof);
    tree.release(house);
    tree.release(roof);
    EXPECT_EQ(tree.getPartCount(), 3u);
    EXPECT_EQ(tree.add(FeatureTree::Scene, 1, "house"), house);
    tree.release(roof);
    EXPECT_EQ(tree.getPartCount(), 1u) << "the scene";
    EXPECT_EQ(tree.getNameCount(), 0u);
}

TEST_F(Features, aPartThatIsGoneIsNoFeatureAnyMore)
{
    const auto name = tree.use("house");
    std::vector<FeatureTree::Part> houses;
    for (std::uint64_t key = 1; key <= 3; ++key)
        tree.hold(houses.emplace_back(tree.add(FeatureTree::Scene, key, "house")));
    const auto shed = tree.add(houses[0], 9, "shed");
    tree.hold(shed);
    tree.release(houses[0]); // the shed keeps it
    tree.release(houses[1]);
    EXPECT_TRUE(isOf(houses[2], name));
    EXPECT_TRUE(isOf(shed, name));
    tree.release(shed);
    tree.release(houses[2]);
    EXPECT_EQ(tree.getPartCount(), 1u);
    EXPECT_EQ(tree.getNameCount(), 1u) << "the label's";
    tree.unuse(name);
    EXPECT_EQ(tree.getNameCount(), 0u);
    EXPECT_FALSE(tree.isUsed("house"));
    const auto again = tree.add(FeatureTree::Scene, 1, "house");
    EXPECT_EQ(tree.getNumber(again), FeatureTree::Foreign) << "no label names it";
}

TEST_F(Features, numbersThatAPartLeavesAreNotThoseOfAnother)
{
    const auto house = tree.use("house"), barn = tree.use("barn");
    const auto first = tree.add(FeatureTree::Scene, 1, "house");
    const auto second = tree.add(FeatureTree::Scene, 2, "barn");
    tree.hold(first);
    tree.hold(second);
    const auto before = tree.getNumber(second);
    tree.release(first);
    EXPECT_EQ(tree.getNumber(second), before);
    const auto third = tree.add(FeatureTree::Scene, 3, "");
    EXPECT_EQ(tree.getNumber(third), FeatureTree::Foreign);
    EXPECT_FALSE(isOf(second, house));
    EXPECT_TRUE(isOf(second, barn));
}

TEST_F(Features, labelsOfAPartEndWithTheLastOne)
{
    const auto house = tree.add(FeatureTree::Scene, 1, "");
    tree.hold(house);
    tree.addLabel(house);
    tree.addLabel(house);
    tree.removeLabel(house);
    EXPECT_NE(tree.getNumber(house), FeatureTree::Foreign);
    tree.removeLabel(house);
    EXPECT_EQ(tree.getNumber(house), FeatureTree::Foreign);
    tree.release(house);
    EXPECT_EQ(tree.getPartCount(), 1u);
}

TEST_F(Features, nestingSaysWhatIsAroundANumber)
{
    const auto campus = tree.add(FeatureTree::Scene, 1, "campus");
    const auto house = tree.add(campus, 2, "house");
    const auto wing = tree.add(house, 3, "wing");
    const auto barn = tree.add(FeatureTree::Scene, 4, "barn");
    std::vector<FeatureTree::Range> ranges;
    for (const char* name : {"campus", "house", "wing", "barn"})
        tree.use(name);
    for (const char* name : {"campus", "house", "wing"})
        ranges.push_back(tree.getRange(tree.use(name)));
    const auto nesting = tree.getNesting();
    for (std::uint32_t depth = 0; depth < 3; ++depth)
    {
        const auto around = nesting->at(tree.getNumber(wing), depth);
        EXPECT_EQ(around.first, ranges[depth].first);
        EXPECT_EQ(around.last, ranges[depth].last);
        EXPECT_EQ(nesting->depthOf(ranges[depth].first), depth);
    }
    // What has no feature of that depth around it is alone.
    for (const std::uint32_t number : {0u, FeatureTree::Foreign, tree.getNumber(campus), 99u})
    {
        EXPECT_EQ(nesting->at(number, 1).first, number);
        EXPECT_EQ(nesting->at(number, 1).last, number);
    }
    EXPECT_EQ(nesting->at(tree.getNumber(barn), 0).last, tree.getNumber(barn));
    tree.unuse(tree.use("new"));
    tree.addLabel(barn);
    tree.getNumber(barn);
    EXPECT_EQ(nesting->at(tree.getNumber(wing), 0).first, ranges[0].first) << "stays as it was";
}
