// SPDX-License-Identifier: MIT
// What is kept of features that come and go, and what a frame keeps of them.
#include <osgLabels/MapRecords.h>
#include <osgLabels/PrimitiveBatch.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/ValueObject>

#include <gtest/gtest.h>

using namespace osgLabels;

namespace
{

osg::ref_ptr<osg::Geode> house(const std::string& name)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    geometry->setVertexArray(new osg::Vec3Array(3, corners));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(name);
    geode->addDrawable(geometry);
    return geode;
}

MapFeatures::Occluder find(MapFeatures& features, osg::Group& group, osg::Geode& geode)
{
    return features.find(group, {&group, &geode, geode.getChild(0)});
}

osg::ref_ptr<PrimitiveBatch> batchOf(const std::vector<std::string>& names)
{
    osg::ref_ptr<PrimitiveBatch> batch = new PrimitiveBatch;
    for (const std::string& name : names)
    {
        Primitive block;
        block.shape = Shape::Box;
        block.name = name;
        batch->add(block);
    }
    batch->build();
    return batch;
}

/// Batches below a group, and what stands before map labels of them.
struct Batches
{
    Batches()
    {
        std::string error;
        batches.setSource(LabelSource::create({}, error),
                          [](const std::string&) { return LabelTable::Codes(); });
    }
    void add(const std::vector<std::string>& names)
    {
        group->addChild(batchOf(names));
        batches.sweep(); // a batch may lie where one has died
        batches.collect(*group);
    }

    osg::ref_ptr<osg::Group> group = new osg::Group;
    NumberSpace identifiers, numbers;
    FramesInFlight frames;
    LabelBatches batches{{std::make_shared<LabelTable>(), identifiers, numbers, frames}};
    LabelObjects objects{batches, numbers};
    MapFeatures features{{}, {}};
    MapRecords records{batches, objects, features};
};

} // namespace

TEST(MapFeatures, aThousandTimesFeaturesComeAndGoWithoutGrowth)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    std::vector<MapFeatures::Valued> valued;
    MapFeatures features({}, [&](MapFeatures::Valued each) { valued.push_back(each); });
    const osg::ref_ptr<osg::Geode> stays = house("stays");
    group->addChild(stays);
    constexpr std::size_t each = 20;
    for (int cycle = 0; cycle < 1000; ++cycle)
    {
        osg::ref_ptr<osg::Group> town = new osg::Group;
        town->setName("town " + std::to_string(cycle));
        std::vector<FeatureTree::Name> names;
        for (std::size_t i = 0; i < each; ++i)
        {
            // Names that were never there before, as of a street that is loaded.
            const auto one = house("house " + std::to_string(cycle * 100 + int(i)));
            if (i % 4 == 0)
                one->setUserValue("label", std::string("by value"));
            town->addChild(one);
            names.push_back(features.use(one->getName()));
        }
        group->addChild(town);
        features.collect(*group);
        ASSERT_EQ(features.getPartCount(), 1u + 1u + 1u + each);
        ASSERT_EQ(valued.size(), each / 4);
        group->removeChild(town);
        town = nullptr;
        features.sweep(*group, 2 * each);
        for (const FeatureTree::Name name : names)
            features.unuse(name);
        for (const MapFeatures::Valued& label : valued)
            features.forget(label.part);
        valued.clear();
        ASSERT_EQ(features.getPartCount(), 2u);
    }
    const auto name = features.use("stays");
    const auto range = features.getRange(name);
    EXPECT_EQ(find(features, *group, *stays).number, range.first);
    EXPECT_EQ(range.first, FeatureTree::First) << "numbers do not run away either";
}

TEST(MapFeatures, aLabelledNodeThatIsHungElsewhereHasItsLabelThere)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    std::vector<MapFeatures::Valued> valued;
    MapFeatures features({}, [&](MapFeatures::Valued each) { valued.push_back(each); });
    const osg::ref_ptr<osg::Geode> one = house("one");
    one->setUserValue("label", std::string("text"));
    for (int i = 0; i < 100; ++i)
    {
        osg::ref_ptr<osg::Group> around = new osg::Group; // often where the last one lay
        around->addChild(one);
        group->addChild(around);
        features.collect(*group);
        ASSERT_EQ(valued.size(), 1u) << i;
        group->removeChild(around);
        around = nullptr;
        features.sweep(*group, 10);
        features.forget(valued[0].part);
        valued.clear();
        ASSERT_EQ(features.getPartCount(), 1u);
    }
}

TEST(MapRecords, partsOfBatchesGoWithThem)
{
    Batches scene;
    for (int i = 0; i < 50; ++i)
    {
        const std::string name = "block " + std::to_string(i);
        const auto used = scene.features.use(name);
        scene.add({name, "other"});
        scene.records.update(*scene.group);
        EXPECT_EQ(scene.features.getPartCount(), 2u) << "the scene and the block";
        scene.group->removeChildren(0, 1);
        scene.features.unuse(used);
    }
}

TEST(MapRecords, whatAFrameWasCulledWithStays)
{
    Batches scene;
    scene.add({"tower", "shed"});
    scene.features.use("tower");
    const auto culled = scene.records.update(*scene.group);
    const std::vector<std::uint32_t> words = culled->words;
    EXPECT_EQ(scene.records.update(*scene.group), culled) << "nothing has changed";
    scene.features.use("shed"); // the next frame's cull
    const auto next = scene.records.update(*scene.group);
    EXPECT_NE(next->words, words);
    EXPECT_NE(next->features, culled->features);
    EXPECT_EQ(culled->words, words);
}
