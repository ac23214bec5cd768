// SPDX-License-Identifier: MIT
// What lies under a point of a picture.
#include "LabelPictures.h"

#include <osgLabels/PrimitiveBatch.h>

#include <osg/Camera>

#include <limits>

using namespace labelScene;
using osgLabels::LabelScene;

namespace
{

class LabelPick : public PictureTest
{
};

/// Two boards, left and right, below a named group.
osg::ref_ptr<osg::Group> unit()
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->setName("unit 7");
    group->addChild(named(
        "P-101", rectangle({-1, 0, -0.4f}, {0.9f, 0, 0}, {0, 0, 0.8f}, {0.9f, 0.8f, 0.8f, 1})));
    group->addChild(named(
        "P-102", rectangle({0.1f, 0, -0.4f}, {0.9f, 0, 0}, {0, 0, 0.8f}, {0.8f, 0.8f, 1, 1})));
    root->addChild(group);
    root->addChild(rectangle({-0.2f, 0.2f, 0.5f}, {0.4f, 0, 0}, {0, 0, 0.4f}, {1, 1, 1, 1}));
    return root;
}

/// Asks for a point from -1 to 1 and draws one frame.
LabelScene::Picked pickAt(LabelScene& scene, double x, double y, osg::Node* root = nullptr,
                          support::HeadlessViewer* in = nullptr)
{
    scene.pick(x, y);
    if (in)
        in->render(&scene, fromFront(), Width, Height, 1);
    else
        render(root ? *root : scene, fromFront(), Width, Height, 1);
    const std::optional<LabelScene::Picked> picked = scene.takePicked();
    EXPECT_TRUE(picked) << "no answer at " << x << " " << y;
    EXPECT_FALSE(scene.takePicked()) << "the answer comes twice";
    return picked.value_or(LabelScene::Picked{~0u, "none", ""});
}

} // namespace

TEST_F(LabelPick, saysIdentifierTextAndPath)
{
    const auto scene = labelled(unit());
    scene->setName("plant");
    ASSERT_TRUE(render(*scene));
    const LabelScene::Picked left = pickAt(*scene, -0.4, 0.1), right = pickAt(*scene, 0.4, -0.3);
    EXPECT_EQ(left.identifier, 1u);
    EXPECT_EQ(left.text, "P-101");
    EXPECT_EQ(left.path, "/plant/Group/unit 7/P-101");
    EXPECT_EQ(right.identifier, 2u);
    EXPECT_EQ(right.text, "P-102");
    EXPECT_TRUE(scene->setText(2, "34 bar"));
    EXPECT_EQ(pickAt(*scene, 0.4, -0.3).text, "34 bar");
}

TEST_F(LabelPick, isZeroForTheBackgroundAndWhatHasNoName)
{
    const auto scene = labelled(unit());
    ASSERT_TRUE(render(*scene));
    EXPECT_EQ(pickAt(*scene, 0.0, -0.9).identifier, 0u);
    EXPECT_EQ(pickAt(*scene, 0.0, 0.7).identifier, 0u) << "it has no name";
    EXPECT_EQ(pickAt(*scene, 0.0, 0.7).text, "");
    EXPECT_EQ(pickAt(*scene, -1.0, -1.0).identifier, 0u);
    EXPECT_EQ(pickAt(*scene, 1.0, 1.0).identifier, 0u);
}

TEST_F(LabelPick, isZeroBeyondTheView)
{
    // What is in view covers it all and goes on beyond.
    const auto scene =
        labelled(named("WALL", rectangle({-40, 0, -40}, {80, 0, 0}, {0, 0, 80}, {1, 1, 1, 1})));
    ASSERT_TRUE(render(*scene));
    for (double x : {-0.999, 0.0, 0.999})
        for (double y : {-0.999, 0.0, 0.999})
            EXPECT_EQ(pickAt(*scene, x, y).text, "WALL") << x << ' ' << y;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [x, y] :
         {std::pair(7.0, -7.0), std::pair(1.01, 0.0), std::pair(-1.01, 0.0), std::pair(0.0, 1.01),
          std::pair(0.0, -1.01), std::pair(1e300, 0.0), std::pair(nan, 0.0), std::pair(0.0, nan)})
        EXPECT_EQ(pickAt(*scene, x, y).identifier, 0u) << x << ' ' << y;
}

TEST_F(LabelPick, isAnsweredWhereNothingIsInView)
{
    const auto nothing = labelled(new osg::Group);
    ASSERT_TRUE(render(*nothing));
    EXPECT_EQ(pickAt(*nothing, 0.0, 0.0).identifier, 0u);
    const auto unnamed =
        labelled(rectangle({-1, 0, -0.4f}, {0.9f, 0, 0}, {0, 0, 0.8f}, {1, 1, 1, 1}));
    ASSERT_TRUE(render(*unnamed));
    EXPECT_EQ(pickAt(*unnamed, -0.4, 0.1).identifier, 0u);
    const auto hidden = labelled(unit());
    ASSERT_TRUE(render(*hidden));
    hidden->setShown(false);
    EXPECT_EQ(pickAt(*hidden, -0.4, 0.1).identifier, 0u);
}

TEST_F(LabelPick, findsTheNearestOfAllBins)
{
    osg::ref_ptr<osg::Group> group = unit();
    const auto early = named(
        "NEAR", rectangle({-0.6f, -0.2f, -0.1f}, {0.3f, 0, 0}, {0, 0, 0.2f}, {1, 0.5f, 0.5f, 1}));
    early->getOrCreateStateSet()->setRenderBinDetails(-3, "RenderBin");
    const auto late = named(
        "LATE", rectangle({0.3f, -0.2f, -0.1f}, {0.3f, 0, 0}, {0, 0, 0.2f}, {1, 0.5f, 0.5f, 1}));
    late->getOrCreateStateSet()->setRenderBinDetails(4, "RenderBin");
    group->addChild(early);
    group->addChild(late);
    const auto scene = labelled(group);
    ASSERT_TRUE(render(*scene));
    EXPECT_EQ(pickAt(*scene, -0.35, 0.0).text, "NEAR");
    EXPECT_EQ(pickAt(*scene, 0.35, 0.0).text, "LATE");
    EXPECT_EQ(pickAt(*scene, -0.1, 0.0).text, "P-101");
}

TEST_F(LabelPick, countsFromTheCornerOfItsViewport)
{
    const auto scene = labelled(unit());
    osg::Camera& camera = *viewer().getViewer().getCamera();
    ASSERT_TRUE(render(*scene));
    scene->pick(-0.4, 0.1);
    camera.setViewport(Width / 2, Height / 2, Width / 2, Height / 2);
    viewer().getViewer().frame();
    const auto picked = scene->takePicked();
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->text, "P-101");
    EXPECT_EQ(pickAt(*scene, 0.4, 0.1).text, "P-102");
}

TEST_F(LabelPick, takesOneOfTheSamples)
{
    support::HeadlessSettings settings{Width, Height};
    settings.samples = 4;
    support::HeadlessViewer smooth(settings);
    OSGKITS_NEED_GL(smooth);
    const auto scene = labelled(unit());
    ASSERT_TRUE(smooth.render(scene, fromFront(), Width, Height, 2));
    EXPECT_EQ(pickAt(*scene, -0.4, 0.1, nullptr, &smooth).text, "P-101");
    EXPECT_EQ(pickAt(*scene, 0.4, 0.3, nullptr, &smooth).text, "P-102");
    EXPECT_EQ(pickAt(*scene, 0.0, -0.9, nullptr, &smooth).identifier, 0u);
}

TEST_F(LabelPick, findsTheObjectsOfBatches)
{
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    batch->setName("pipes");
    for (int i = 0; i < 3; ++i)
    {
        osgLabels::Primitive box;
        box.shape = osgLabels::Shape::Box;
        box.size = osg::Vec3(0.2f, 0.2f, 0.2f);
        box.position = osg::Vec3d(-0.7 + 0.7 * i, 0.0, -0.6);
        box.name = i == 1 ? std::string() : "B-" + std::to_string(i);
        batch->add(box);
    }
    batch->build();
    osg::ref_ptr<osg::Group> group = unit();
    group->addChild(batch);
    const auto scene = labelled(group);
    ASSERT_TRUE(render(*scene));
    EXPECT_EQ(pickAt(*scene, -0.7 * 0.79, -0.63).text, "B-0");
    EXPECT_EQ(pickAt(*scene, 0.7 * 0.79, -0.63).text, "B-2");
    EXPECT_EQ(pickAt(*scene, 0.0, -0.63).identifier, 0u);
    EXPECT_EQ(pickAt(*scene, -0.4, 0.3).text, "P-101");
    const LabelScene::Picked last = pickAt(*scene, 0.7 * 0.79, -0.63);
    EXPECT_NE(last.path.find("pipes"), std::string::npos) << last.path;
}
