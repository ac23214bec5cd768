// SPDX-License-Identifier: MIT
#include <osgLabels/FramesInFlight.h>
#include <osgLabels/LabelCollector.h>
#include <osgLabels/NumberSpace.h>

#include <osg/Geometry>

#include <gtest/gtest.h>

using namespace osgLabels;

TEST(FramesInFlightTest, aFrameIsOverWhenItsTicketIsGoneAndAllBeforeToo)
{
    FramesInFlight frames;
    EXPECT_TRUE(frames.areOver(frames.getLast()));
    FramesInFlight::Ticket first = frames.begin(), second = frames.begin();
    EXPECT_FALSE(frames.areOver(1));
    second.reset();
    EXPECT_FALSE(frames.areOver(2)) << "the first one is still drawn";
    first.reset();
    EXPECT_TRUE(frames.areOver(2));
}

TEST(FramesInFlightTest, retiredThingsWaitForTheFramesThatMayShowThem)
{
    FramesInFlight frames;
    Retired<int> retired;
    std::vector<int> released;
    const auto release = [&]
    { retired.release(frames, [&](int what) { released.push_back(what); }); };
    FramesInFlight::Ticket first = frames.begin();
    retired.add(7, frames);
    FramesInFlight::Ticket second = frames.begin(); // begun later: shows nothing of it
    release();
    EXPECT_TRUE(released.empty());
    first.reset();
    release();
    EXPECT_EQ(released, std::vector<int>{7});
}

TEST(FramesInFlightTest, numbersOfObjectsAreNotGivenAgainWhileAFrameMayShowThem)
{
    const auto shared = std::make_shared<LabelCollector::Shared>();
    const auto table = std::make_shared<LabelTable>();
    std::string error;
    LabelCollector collector(
        table, LabelSource::create({}, error),
        [](const std::string& text) { return LabelTable::Codes(text.begin(), text.end()); },
        shared);
    osg::ref_ptr<osg::Group> group = new osg::Group;
    const auto add = [&](const std::string& name)
    {
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setName(name);
        group->addChild(geometry);
        collector.collect(*group);
        return collector.takeNew().front();
    };
    const std::uint32_t object = add("OLD");
    const std::uint32_t identifier = collector.getObject(object).identifier;
    FramesInFlight::Ticket frame = shared->frames.begin();
    group->removeChild(0u, 1);
    collector.sweep(*group, 10);
    const std::uint32_t meanwhile = add("NEW");
    EXPECT_NE(meanwhile, object);
    EXPECT_NE(collector.getObject(meanwhile).identifier, identifier);
    frame.reset();
    collector.sweep(*group, 10);
    const std::uint32_t after = add("LATER");
    EXPECT_EQ(after, object) << "free numbers are given again";
    EXPECT_EQ(collector.getObject(after).identifier, identifier);
}

TEST(NumberSpaceTest, holesAreFilledAndTheEndShrinks)
{
    NumberSpace space;
    EXPECT_EQ(space.take(10), 1u);
    EXPECT_EQ(space.take(5), 11u);
    space.give(1, 10);
    EXPECT_EQ(space.take(4), 1u);
    EXPECT_EQ(space.takeNext(), 16u);
    space.give(16, 1);
    EXPECT_EQ(space.getEnd(), 16u);
}
