// SPDX-License-Identifier: MIT
#include "DeclutterScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace osgLabels;

namespace
{

using Shown = std::vector<std::uint8_t>;

const glm::vec2 View(800.0f, 600.0f);

/// 100 x 20 pixels.
DeclutterLabel at(float x, float y, double priority, std::uint64_t key)
{
    return {{{x, y}, {x + 100.0f, y + 20.0f}}, priority, key};
}

Shown once(const std::vector<DeclutterLabel>& labels)
{
    return Declutter().update(labels, View, 0.0);
}

} // namespace

TEST(DeclutterTest, ofOverlappingLabelsTheHigherPriorityIsShown)
{
    EXPECT_EQ(once({at(10, 10, 1.0, 1), at(60, 20, 2.0, 2)}), (Shown{0, 1}));
    EXPECT_EQ(once({at(10, 10, 3.0, 1), at(60, 20, 2.0, 2)}), (Shown{1, 0}));
    // The second hides the third, and is hidden itself: the third is shown.
    EXPECT_EQ(once({at(0, 10, 3.0, 1), at(80, 10, 2.0, 2), at(160, 10, 1.0, 3)}), (Shown{1, 0, 1}));
}

TEST(DeclutterTest, labelsThatTouchAreBothShown)
{
    EXPECT_EQ(once({at(10, 10, 1.0, 1), at(110, 10, 1.0, 2), at(10, 30, 1.0, 3)}),
              (Shown{1, 1, 1}));
}

TEST(DeclutterTest, equalPrioritiesGoByTheSmallerKeyInAnyOrder)
{
    EXPECT_EQ(once({at(10, 10, 1.0, 7), at(60, 20, 1.0, 5)}), (Shown{0, 1}));
    EXPECT_EQ(once({at(60, 20, 1.0, 5), at(10, 10, 1.0, 7)}), (Shown{1, 0}));
    EXPECT_EQ(once({at(60, 20, 1.0, 5), at(10, 10, 1.0, 5)}), (Shown{1, 0}));
}

TEST(DeclutterTest, aPriorityThatIsNoNumberCountsAsMinusInfinity)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    const double low = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(once({at(10, 10, none, 1), at(60, 20, -1e308, 2)}), (Shown{0, 1}));
    EXPECT_EQ(once({at(10, 10, none, 1), at(60, 20, low, 2)}), (Shown{1, 0}));
    EXPECT_EQ(once({at(10, 10, none, 2), at(60, 20, low, 1)}), (Shown{0, 1}));
    EXPECT_EQ(once({at(10, 10, none, 2), at(60, 20, none, 1)}), (Shown{0, 1}));
}

TEST(DeclutterTest, rectanglesWithoutAnInsideAreNotShownAndTakeNoPlace)
{
    const float nan = std::nanf(""), huge = std::numeric_limits<float>::max(),
                infinite = std::numeric_limits<float>::infinity();
    const Rectangle wrong[] = {{{50, 15}, {50, 15}},         {{50, 15}, {50, 30}},
                               {{100, 100}, {0, 0}},         {{nan, 0}, {100, 100}},
                               {{0, 0}, {100, nan}},         {{-infinite, 0}, {infinite, 600}},
                               {{-infinite, 0}, {0.0f, 10}}, {{-huge, -huge}, {huge, huge}},
                               {{900, 10}, {950, 30}},       {{10, -30}, {50, 0}}};
    for (const Rectangle& rectangle : wrong)
        EXPECT_EQ(once({{rectangle, 9.0, 1}, at(10, 10, 1.0, 2)}), (Shown{0, 1}));
}

TEST(DeclutterTest, aLabelLargerThanTheViewHidesAllThatIsWeaker)
{
    const float large = 1e30f;
    const DeclutterLabel all{{{-large, -large}, {large, large}}, 2.0, 1};
    EXPECT_EQ(once({all, at(10, 10, 1.0, 2), at(700, 570, 3.0, 3)}), (Shown{0, 1, 1}));
    EXPECT_EQ(once({all, at(10, 10, 1.0, 2), at(700, 570, 1.0, 3)}), (Shown{1, 0, 0}));
}

TEST(DeclutterTest, noLabelsAndNoViewShowNothing)
{
    EXPECT_EQ(once({}), Shown());
    for (const float side : {0.0f, -1.0f, std::nanf("")})
        EXPECT_EQ(Declutter().update({at(10, 10, 1.0, 1)}, {800.0f, side}, 0.0), Shown{0});
}

TEST(DeclutterTest, withoutAPastEachHiddenLabelOverlapsAStrongerOneAndNoShownOnesDo)
{
    const std::vector<DeclutterLabel> labels = crowd(3000, 1);
    Declutter declutter;
    const Shown shown = declutter.update(labels, View, 0.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
        bool overlaps = false;
        for (std::size_t k = 0; k < labels.size(); ++k)
            overlaps |= k != i && shown[k] && labels[k].rectangle.overlaps(labels[i].rectangle) &&
                        (shown[i] || labels[k].priority >= labels[i].priority);
        EXPECT_NE(overlaps, bool(shown[i])) << i;
        count += shown[i];
    }
    EXPECT_EQ(declutter.getNumShown(), count);
    EXPECT_GT(count, 100u);
}

TEST(DeclutterTest, comingNeedsAMargin)
{
    Declutter declutter({8.0f, 0.0});
    std::vector<DeclutterLabel> labels = {at(10, 10, 2.0, 1), at(90, 10, 1.0, 2)};
    EXPECT_EQ(declutter.update(labels, View, 0.0), (Shown{1, 0}));
    labels[1] = at(117, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 1.0), (Shown{1, 0}));
    labels[1] = at(118, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 2.0), (Shown{1, 1}));
    labels[1] = at(110, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 3.0), (Shown{1, 1}));
    labels[1] = at(109, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 4.0), (Shown{1, 0}));
}

TEST(DeclutterTest, aHiddenLabelComesAfterTheHold)
{
    Declutter declutter;
    std::vector<DeclutterLabel> labels = {at(10, 10, 2.0, 1), at(110, 10, 1.0, 2)};
    EXPECT_EQ(declutter.update(labels, View, 0.0), (Shown{1, 1}));
    labels[1] = at(109, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 0.1), (Shown{1, 0}));
    labels[1] = at(200, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 0.2), (Shown{1, 0}));
    labels[1] = at(201, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 1.05), (Shown{1, 0}));
    labels[1] = at(202, 10, 1.0, 2);
    EXPECT_EQ(declutter.update(labels, View, 1.15), (Shown{1, 1}));
}

TEST(DeclutterTest, aStrongerLabelWaitsForTheHoldOfThoseThatItPushesOut)
{
    Declutter declutter;
    declutter.update({at(10, 300, 1.0, 1)}, View, 0.0);
    EXPECT_EQ(declutter.update({at(10, 300, 1.0, 1), at(10, 10, 1.0, 2)}, View, 0.1),
              (Shown{1, 1}));
    // New; the label of key 2 came at 0.1.
    std::vector<DeclutterLabel> labels = {at(10, 300, 1.0, 1), at(10, 10, 1.0, 2),
                                          at(60, 10, 5.0, 3)};
    EXPECT_EQ(declutter.update(labels, View, 0.2), (Shown{1, 1, 0}));
    labels[2] = at(61, 10, 5.0, 3);
    EXPECT_EQ(declutter.update(labels, View, 1.2), (Shown{1, 0, 1}));
}

TEST(DeclutterTest, withinTheHoldALabelGoesOnlyIfOverlappedByMoreThanAMarginOrAQuarter)
{
    const auto after = [](float x, float y)
    {
        Declutter declutter;
        declutter.update({}, View, 0.0);
        declutter.update({at(10, 10, 2.0, 1), at(200, 100, 1.0, 2)}, View, 0.1);
        return declutter.update({at(10, 10, 2.0, 1), at(x, y, 1.0, 2)}, View, 0.2);
    };
    EXPECT_EQ(after(103, 10), (Shown{1, 1}));
    EXPECT_EQ(after(101, 10), (Shown{1, 0}));
    EXPECT_EQ(after(10, 26), (Shown{1, 1}));
    EXPECT_EQ(after(10, 24), (Shown{1, 0}));
}

TEST(DeclutterTest, aTimeThatDoesNotAdvanceIsACut)
{
    const std::vector<DeclutterLabel> before = crowd(500, 1), after = crowd(500, 2);
    const Shown fresh = once(after);
    for (const double time : {5.0, 4.0, std::numeric_limits<double>::quiet_NaN()})
    {
        Declutter declutter;
        declutter.update(before, View, 5.0);
        EXPECT_EQ(declutter.update(after, View, time), fresh);
    }
}

TEST(DeclutterTest, labelsThatAppearAndDisappearKeepTheOthersAsTheyAre)
{
    Declutter declutter;
    declutter.update({at(10, 10, 1.0, 1), at(10, 100, 1.0, 2), at(20, 15, 0.5, 3)}, View, 0.0);
    // In another order, one taken away.
    EXPECT_EQ(declutter.update({at(20, 15, 0.5, 3), at(10, 100, 1.0, 2)}, View, 0.1),
              (Shown{1, 1}));
    // It comes back, new, and waits for the one that took its place.
    EXPECT_EQ(declutter.update({at(20, 15, 0.5, 3), at(10, 10, 1.0, 1)}, View, 0.2), (Shown{1, 0}));
    EXPECT_EQ(declutter.update({at(20, 15.5, 0.5, 3), at(10, 10, 1.0, 1)}, View, 1.3),
              (Shown{0, 1}));
    EXPECT_EQ(declutter.update({}, View, 1.4), Shown());
}

TEST(DeclutterTest, atRestNothingChangesWhateverTheTime)
{
    CityFlight flight(2000);
    Declutter declutter;
    for (int frame = 0; frame < 60; ++frame)
        declutter.update(flight.labelsAt(frame / 30.0, 40.0), View, frame / 30.0);
    std::vector<DeclutterLabel> labels = flight.labelsAt(2.0, 40.0);
    labels.push_back(at(std::nanf(""), 0.0f, 1.0, 1u << 20));
    const Shown shown = declutter.update(labels, View, 2.0);
    for (int frame = 0; frame < 300; ++frame)
        ASSERT_EQ(declutter.update(labels, View, 2.0 + frame / 30.0), shown) << frame;
}

namespace
{

/// The most changes of one label in any second of 20 s of a flight, and all of them.
std::pair<int, int> changesOf(const DeclutterSettings& settings, double metersASecond)
{
    CityFlight flight(2000);
    Declutter declutter(settings);
    std::map<std::uint64_t, std::vector<double>> changes;
    std::map<std::uint64_t, bool> last;
    int most = 0, total = 0;
    for (int frame = 0; frame < 600; ++frame)
    {
        const double time = frame / 30.0;
        const std::vector<DeclutterLabel> labels = flight.labelsAt(time, metersASecond);
        const Shown& shown = declutter.update(labels, View, time);
        std::map<std::uint64_t, bool> now;
        for (std::size_t i = 0; i < labels.size(); ++i)
        {
            const Rectangle& box = labels[i].rectangle;
            if (!box.overlaps({{0.0f, 0.0f}, View}))
                continue;
            now[labels[i].key] = shown[i];
            const auto before = last.find(labels[i].key);
            if (before == last.end() || before->second == bool(shown[i]))
                continue;
            std::vector<double>& times = changes[labels[i].key];
            times.push_back(time);
            ++total;
            most =
                std::max(most, int(std::count_if(times.begin(), times.end(),
                                                 [&](double t) { return t > time - 1.0 + 1e-9; })));
        }
        last = std::move(now);
    }
    return {most, total};
}

} // namespace

TEST(DeclutterTest, aLabelChangesOnceASecondAtMostWhileTheCameraMovesSlowly)
{
    // 8 m/s over a city seen from 300 m: labels move by less than 16 pixels a second against
    // each other.
    const auto [most, total] = changesOf({}, 8.0);
    EXPECT_LE(most, 1);
    EXPECT_GT(total, 10);
    const auto [mostPlain, totalPlain] = changesOf({0.0f, 0.0}, 8.0);
    EXPECT_GT(totalPlain, total);
}

TEST(DeclutterTest, aLabelChangesTwiceASecondAtMostHoweverFastTheCameraIs)
{
    EXPECT_LE(changesOf({}, 300.0).first, 2);
    EXPECT_GT(changesOf({0.0f, 0.0}, 300.0).first, 2);
}

TEST(DeclutterTest, aHundredThousandLabelsMayBeAtOnePoint)
{
    // Of three frames the last. Where all are compared with all this takes minutes.
    const auto shownOf = [](std::vector<DeclutterLabel> labels)
    {
        Declutter declutter;
        Shown shown;
        for (int frame = 0; frame < 3; ++frame)
        {
            for (DeclutterLabel& label : labels)
                label.rectangle.low.x -= 0.25f;
            shown = declutter.update(labels, View, frame * 0.1);
        }
        return std::count(shown.begin(), shown.end(), 1);
    };
    std::vector<DeclutterLabel> stack, specks;
    for (std::uint64_t i = 0; i < 100000; ++i)
    {
        stack.push_back(at(400, 300, double(i % 7), i));
        const float x = 400.0f + float(i % 300) * 1e-3f, y = 300.0f + float(i / 300) * 1e-3f;
        specks.push_back({{{x, y}, {x + 5e-4f, y + 5e-4f}}, 1.0, i});
    }
    EXPECT_EQ(shownOf(stack), 1);
    EXPECT_EQ(shownOf(specks), 1) << "all are within the margin of the first";
}
