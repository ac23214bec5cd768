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

} // namespace

TEST(FeatureTree, partsThatNoLabelNamesAreForeign)
{
    FeatureTree tree;
    const auto house = tree.add(FeatureTree::Scene, 1, "house");
    EXPECT_EQ(tree.getNumber(house), FeatureTree::Foreign);
    EXPECT_EQ(tree.getNumber(FeatureTree::Scene), FeatureTree::Foreign);
    EXPECT_FALSE(isIn(FeatureTree::Foreign, tree.getRange(FeatureTree::None)));
    EXPECT_FALSE(isIn(0, tree.getRange(FeatureTree::None)));
    EXPECT_FALSE(isIn(FeatureTree::Foreign, tree.getRange(tree.use("none such"))));
}

TEST(FeatureTree, whatLiesInAFeatureIsOfIt)
{
    FeatureTree tree;
    const auto house = tree.add(FeatureTree::Scene, 1, "house");
    const auto roof = tree.add(house, 2, "roof");
    const auto name = tree.use("house");
    EXPECT_TRUE(isIn(tree.getNumber(house), tree.getRange(name)));
    EXPECT_EQ(tree.getNumber(roof), tree.getNumber(house));
    const auto later = tree.add(roof, 3, "chimney");
    EXPECT_EQ(tree.getNumber(later), tree.getNumber(house));
    EXPECT_EQ(tree.add(roof, 3, "chimney"), later) << "once a key";
}

TEST(FeatureTree, featuresInsideOfAnotherHaveNumbersOfTheirOwnInItsRange)
{
    FeatureTree tree;
    const auto city = tree.add(FeatureTree::Scene, 1, "city");
    const auto house = tree.add(city, 2, "house");
    const auto tower = tree.add(city, 3, "tower");
    const auto cityName = tree.use("city"), houseName = tree.use("house");
    EXPECT_NE(tree.getNumber(house), tree.getNumber(city));
    EXPECT_TRUE(isIn(tree.getNumber(house), tree.getRange(cityName)));
    EXPECT_TRUE(isIn(tree.getNumber(tower), tree.getRange(cityName)));
    EXPECT_FALSE(isIn(tree.getNumber(tower), tree.getRange(houseName)));
    EXPECT_FALSE(isIn(tree.getNumber(city), tree.getRange(houseName)));
}

TEST(FeatureTree, partsOfOneNameAreOneFeature)
{
    FeatureTree tree;
    const auto a = tree.add(FeatureTree::Scene, 1, "tower");
    const auto between = tree.add(FeatureTree::Scene, 2, "house");
    const auto b = tree.add(FeatureTree::Scene, 3, "tower");
    const auto inner = tree.add(b, 4, "clock");
    const auto tower = tree.use("tower"), house = tree.use("house"), clock = tree.use("clock");
    EXPECT_EQ(tree.getNumber(a), tree.getNumber(b));
    EXPECT_FALSE(isIn(tree.getNumber(between), tree.getRange(tower)));
    EXPECT_TRUE(isIn(tree.getNumber(between), tree.getRange(house)));
    EXPECT_TRUE(isIn(tree.getNumber(inner), tree.getRange(clock)));
    EXPECT_FALSE(isIn(tree.getNumber(inner), tree.getRange(house)));
    EXPECT_TRUE(isIn(tree.getNumber(inner), tree.getRange(tower))) << "in whichever it lies";
    EXPECT_NE(tree.getNumber(inner), tree.getNumber(b));
}

TEST(FeatureTree, aNameInsideOfItselfAndOfOthersHasOneRange)
{
    FeatureTree tree;
    const auto tower = tree.add(FeatureTree::Scene, 1, "tower");
    const auto house = tree.add(tower, 2, "house");
    const auto again = tree.add(house, 3, "tower");
    const auto clock = tree.add(again, 4, "clock");
    const auto range = tree.getRange(tree.use("tower"));
    tree.use("house");
    tree.use("clock");
    for (const auto part : {tower, house, again, clock})
        EXPECT_TRUE(isIn(tree.getNumber(part), tree.getRange(tree.use("tower"))));
    EXPECT_LE(range.first, range.last);
    EXPECT_EQ(tree.getNumber(tower), tree.getNumber(again));
    EXPECT_FALSE(isIn(tree.getNumber(tower), tree.getRange(tree.use("house"))));
}

TEST(FeatureTree, labelledPartsAreFeaturesWhateverTheirName)
{
    FeatureTree tree;
    const auto a = tree.add(FeatureTree::Scene, 1, "Building");
    const auto b = tree.add(FeatureTree::Scene, 2, "Building");
    tree.addLabel(a);
    tree.addLabel(b);
    EXPECT_NE(tree.getNumber(a), tree.getNumber(b));
    EXPECT_TRUE(isIn(tree.getNumber(a), tree.getRangeOfPart(a)));
    EXPECT_FALSE(isIn(tree.getNumber(b), tree.getRangeOfPart(a)));
}

TEST(FeatureTree, countsWhenNumbersChange)
{
    FeatureTree tree;
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

TEST(FeatureTree, aKeyThatComesAgainWithAnotherNameIsAnotherPart)
{
    FeatureTree tree;
    const auto house = tree.use("house"), barn = tree.use("barn");
    const auto first = tree.add(FeatureTree::Scene, 1, "house");
    const auto second = tree.add(FeatureTree::Scene, 1, "barn");
    EXPECT_TRUE(isIn(tree.getNumber(second), tree.getRange(barn)));
    EXPECT_FALSE(isIn(tree.getNumber(second), tree.getRange(house)));
    EXPECT_EQ(tree.add(FeatureTree::Scene, 1, "barn"), second);
    EXPECT_TRUE(isIn(tree.getNumber(first), tree.getRange(house)));
}

TEST(FeatureTree, aPartStaysWhileItIsHeldOrSomethingInItIs)
{
    FeatureTree tree;
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

TEST(FeatureTree, aPartThatIsGoneIsNoFeatureAnyMore)
{
    FeatureTree tree;
    const auto name = tree.use("house");
    std::vector<FeatureTree::Part> houses;
    for (std::uint64_t key = 1; key <= 3; ++key)
        tree.hold(houses.emplace_back(tree.add(FeatureTree::Scene, key, "house")));
    const auto shed = tree.add(houses[0], 9, "shed");
    tree.hold(shed);
    tree.release(houses[0]); // the shed keeps it
    tree.release(houses[1]);
    EXPECT_TRUE(isIn(tree.getNumber(houses[2]), tree.getRange(name)));
    EXPECT_TRUE(isIn(tree.getNumber(shed), tree.getRange(name)));
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

TEST(FeatureTree, numbersThatAPartLeavesAreNotThoseOfAnother)
{
    FeatureTree tree;
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
    EXPECT_FALSE(isIn(tree.getNumber(second), tree.getRange(house)));
    EXPECT_TRUE(isIn(tree.getNumber(second), tree.getRange(barn)));
}

TEST(FeatureTree, labelsOfAPartEndWithTheLastOne)
{
    FeatureTree tree;
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

TEST(FeatureTree, nestingSaysWhatIsAroundANumber)
{
    FeatureTree tree;
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
