// SPDX-License-Identifier: MIT
// Label scenes inside of other kits: siblings, the same one in several places, scenes of shadows
// side by side.
#include "LabelPictures.h"

#include <osgLabels/LabelResources.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <support/NotifyCapture.h>

#include <osg/LightSource>
#include <osg/MatrixTransform>

using namespace labelScene;
using osgLabels::LabelScene;
using osgShadowVolume::ShadowedScene;

namespace
{

class LabelNested : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

osg::ref_ptr<osg::Group> group(std::initializer_list<osg::Node*> children)
{
    osg::ref_ptr<osg::Group> made = new osg::Group;
    for (osg::Node* child : children)
        made->addChild(child);
    return made;
}

osg::ref_ptr<ShadowedScene> shadowed(osg::Node* node)
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setKeys(false);
    scene->addChild(node);
    return scene;
}

osg::ref_ptr<osg::Geode> board(const std::string& name, float left, float y = 0.0f)
{
    return named(name,
                 rectangle({left, y, -0.4f}, {1.0f, 0, 0}, {0, 0, 0.8f}, {0.9f, 0.8f, 0.7f, 1}));
}

std::string textAt(LabelScene& scene, double x, osg::Node& root)
{
    scene.pick(x, 0.0);
    render(root, fromFront(), Width, Height, 1);
    const auto picked = scene.takePicked();
    return picked ? picked->text : "no answer";
}

/// A wall and a box that casts on it.
osg::ref_ptr<osg::Group> room(float left)
{
    osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
    lamp->getLight()->setPosition(osg::Vec4(-2.0f, -5.0f, 3.0f, 1.0f));
    const auto made = group({board("WALL", left, 0.5f).get(),
                             box("BOX", {left + 0.4f, 0, 0}, {0.2f, 0.1f, 0.1f}).get()});
    made->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    made->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    made->addChild(lamp);
    return made;
}

} // namespace

TEST_F(LabelNested, siblingsEachHaveTheirLabelsAndSettings)
{
    const auto left = board("LEFT", -1.1f), right = board("RIGHT", 0.1f);
    const auto first = labelled(left, Plain), second = labelled(right, Plain);
    const auto both = shadowed(group({first.get(), second.get()}));
    const auto whole = shadowed(labelled(group({left.get(), right.get()}), Plain));
    EXPECT_TRUE(areEqual(render(*both), render(*whole), "labelNested.siblings"));
    EXPECT_EQ(countOf(*first, "labels.drawables"), 1.0);
    EXPECT_EQ(countOf(*second, "labels.drawables"), 1.0);
    EXPECT_EQ(textAt(*first, -0.4, *both), "LEFT");
    EXPECT_EQ(textAt(*second, 0.4, *both), "RIGHT");
    second->setSettingsText("keys=off,ink=#ff0000,plate=off,size=0.2,proportional=on");
    const Picture red = render(*both);
    keep(red, "labelNested.settings");
    const auto alone = shadowed(labelled(group({right.get()}), second->getSettingsText()));
    const Picture expected = render(*alone), plain = render(*whole);
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            ASSERT_EQ(red->getColor(x, y), (x < Width / 2 ? plain : expected)->getColor(x, y))
                << x << " " << y;
}

TEST_F(LabelNested, aSceneInTwoPlacesIsLabelledInBoth)
{
    const auto scene = labelled(board("TWICE", -0.5f), Plain);
    osg::ref_ptr<osg::MatrixTransform> left = new osg::MatrixTransform,
                                       right = new osg::MatrixTransform;
    left->setMatrix(osg::Matrix::translate(-0.6, 0, 0));
    right->setMatrix(osg::Matrix::translate(0.6, 0, 0));
    left->addChild(scene);
    right->addChild(scene);
    const auto nested = shadowed(group({left.get(), right.get()}));
    const auto two =
        shadowed(labelled(group({board("TWICE", -1.1f).get(), board("TWICE", 0.1f).get()}), Plain));
    EXPECT_TRUE(areAlike(render(*nested), render(*two), "labelNested.twice"));
    EXPECT_EQ(countOf(*scene, "labels.drawables"), 2.0);
    EXPECT_EQ(textAt(*scene, -0.4, *nested), "TWICE");
    EXPECT_EQ(textAt(*scene, 0.4, *nested), "TWICE");
}

TEST_F(LabelNested, scenesOfShadowsSideBySideEachCastTheirOwn)
{
    const auto left = room(-1.1f), right = room(0.1f);
    const auto together = labelled(group({shadowed(left).get(), shadowed(right).get()}), Plain);
    const auto apart =
        group({labelled(shadowed(left), Plain).get(), labelled(shadowed(right), Plain).get()});
    const Picture actual = render(*together), expected = render(*apart);
    EXPECT_TRUE(areEqual(actual, expected, "labelNested.shadows"));
    const Picture unshadowed = render(*labelled(group({left.get(), right.get()}), Plain));
    EXPECT_GT(changedShare(*actual, *unshadowed), 0.01) << "no shadows";
}

TEST_F(LabelNested, aSceneOfShadowsInTwoPlacesCastsInBoth)
{
    const auto inner = shadowed(room(-0.5f));
    osg::ref_ptr<osg::MatrixTransform> left = new osg::MatrixTransform,
                                       right = new osg::MatrixTransform;
    left->setMatrix(osg::Matrix::translate(-0.6, 0, 0));
    right->setMatrix(osg::Matrix::translate(0.6, 0, 0));
    left->addChild(inner);
    right->addChild(inner);
    const auto places = group({left.get(), right.get()});
    const Picture actual = render(*labelled(places, Plain));
    keep(actual, "labelNested.shadowsTwice");
    inner->setShadows(osgShadowVolume::Shadows::OFF);
    EXPECT_GT(changedShare(*actual, *render(*labelled(places, Plain))), 0.01) << "no shadows";
}

TEST_F(LabelNested, onlyItsOwnLeavesAreItsObjects)
{
    // The same drawable lies inside and outside.
    const auto shared = board("SHARED", -1.1f);
    osg::ref_ptr<osg::MatrixTransform> outside = new osg::MatrixTransform;
    outside->setMatrix(osg::Matrix::translate(1.2, 0, 0));
    outside->addChild(shared);
    const auto scene = labelled(shared, Plain);
    const auto root =
        shadowed(group({board("STRANGER", -0.5f, 1.0f).get(), outside.get(), scene.get()}));
    ASSERT_TRUE(render(*root));
    EXPECT_EQ(countOf(*scene, "labels.drawables"), 1.0);
    EXPECT_EQ(countOf(*scene, "labels.count"), 1.0);
    EXPECT_EQ(textAt(*scene, -0.4, *root), "SHARED");
    EXPECT_EQ(textAt(*scene, 0.4, *root), "");
}

TEST_F(LabelNested, ofScenesInsideOfEachOtherTheOuterOneCounts)
{
    const auto inner = labelled(board("INNER", -0.5f), Plain);
    const auto outer = labelled(inner, Plain);
    const Picture actual = render(*outer);
    EXPECT_TRUE(
        areEqual(actual, render(*labelled(board("INNER", -0.5f), Plain)), "labelNested.inside"));
    EXPECT_EQ(countOf(*inner, "labels.drawables"), -1.0) << "it has no plan";
}

TEST_F(LabelNested, aViewWithoutLeavesHasAPlanThatSaysSo)
{
    const auto child = board("GONE", -0.5f);
    const auto scene = labelled(child);
    ASSERT_TRUE(render(*scene));
    EXPECT_EQ(countOf(*scene, "drawCalls"), 1.0);
    const unsigned int frame = scene->getPlans().front().frame;
    child->setNodeMask(0);
    ASSERT_TRUE(render(*scene));
    const osgMultiRender::Plan plan = scene->getPlans().front();
    EXPECT_GT(plan.frame, frame);
    EXPECT_EQ(countOf(*scene, "drawCalls"), 0.0);
    ASSERT_EQ(plan.entries.size(), 1u);
    EXPECT_EQ(plan.entries.front().reason, "nothing of it is in view");
}
