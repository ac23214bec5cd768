// SPDX-License-Identifier: MIT
// Labels together with shadows, with parts of scenes, and with what is loaded later.
#include "LabelPictures.h"

#include <osgLabels/PrimitiveBatch.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <support/TemporaryFolder.h>

#include <osg/BlendFunc>
#include <osg/LOD>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/PagedLOD>
#include <osg/Switch>
#include <osgDB/WriteFile>

#include <chrono>
#include <thread>

using namespace labelScene;
using osgLabels::LabelScene;
using osgShadowVolume::ShadowedScene;

namespace
{

class LabelComposition : public PictureTest
{
};

osg::ref_ptr<ShadowedScene> shadowed(osg::Node* node)
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->setShadows(osgShadowVolume::Shadows::VOLUMES);
    scene->setKeys(false);
    scene->addChild(node);
    return scene;
}

osg::ref_ptr<osg::LightSource> lamp()
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setPosition(osg::Vec4(-2.0f, -5.0f, 3.0f, 1.0f));
    source->getLight()->setDiffuse(osg::Vec4(0.8f, 0.8f, 0.8f, 1.0f));
    source->getLight()->setAmbient(osg::Vec4(0.2f, 0.2f, 0.2f, 1.0f));
    return source;
}

osg::ref_ptr<osg::Geode> wall()
{
    return named("WALL 7", rectangle({-1.3f, 0.6f, -0.9f}, {2.6f, 0, 0}, {0, 0, 1.8f},
                                     {0.8f, 0.8f, 0.7f, 1.0f}));
}

/// A wall, boxes that cast on it, a lamp; state that follows colours.
osg::ref_ptr<osg::Group> room(bool hasGlass = false)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    osg::StateSet* state = group->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    state->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    state->setAttributeAndModes(material);
    group->addChild(lamp());
    group->addChild(wall());
    group->addChild(box("PUMP", {-0.4f, 0.0f, 0.1f}, {0.4f, 0.2f, 0.2f}, {0.9f, 0.5f, 0.4f, 1}));
    group->addChild(box("TANK", {0.6f, -0.2f, -0.4f}, {0.3f, 0.2f, 0.25f}, {0.5f, 0.6f, 0.9f, 1}));
    if (hasGlass)
    {
        const auto glass = named("GLASS", rectangle({-0.9f, 0.35f, -0.8f}, {1.6f, 0, 0},
                                                    {0, 0, 0.8f}, {0.4f, 0.9f, 0.5f, 0.5f}));
        glass->getOrCreateStateSet()->setAttributeAndModes(new osg::BlendFunc);
        glass->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        group->addChild(glass);
    }
    return group;
}

/// Draws the model with labels below shadows and with shadows below labels.
void expectSame(osg::Node& model, const std::string& name, support::HeadlessViewer& in = viewer())
{
    SCOPED_TRACE(name);
    in.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    const auto look = [&](osg::Node* node)
    { return in.render(node, fromFront(), Width, Height, 2); };
    const auto innerShadows = labelled(shadowed(&model), Plain);
    const auto innerLabels = labelled(&model, Plain);
    const osg::ref_ptr<ShadowedScene> outerShadows = shadowed(innerLabels);
    const Picture a = look(innerShadows), b = look(outerShadows);
    EXPECT_TRUE(areEqual(a, b, "labelComposition." + name));
    EXPECT_GT(countOf(*innerShadows, "labels.drawables"), 0.0) << decisionOf(*innerShadows);
    EXPECT_GT(countOf(*innerLabels, "labels.drawables"), 0.0) << decisionOf(*innerLabels);
    const Picture labelsAlone = look(labelled(&model, Plain)),
                  shadowsAlone = look(shadowed(&model));
    ASSERT_TRUE(a && b && labelsAlone && shadowsAlone);
    EXPECT_GT(changedShare(*b, *labelsAlone), 0.01) << "no shadows";
    EXPECT_GT(changedShare(*b, *shadowsAlone), 0.01) << "no labels";
}

/// Draws frames until there are as many labels, at most a minute.
bool waitForLabels(LabelScene& scene, double count)
{
    for (int i = 0; i < 600 && countOf(scene, "labels.drawables") != count; ++i)
    {
        render(scene, fromFront(), Width, Height, 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(i < 5 ? 0 : 100));
    }
    return countOf(scene, "labels.drawables") == count;
}

} // namespace

TEST_F(LabelComposition, shadowsAndLabelsShowTheSameInEitherOrder)
{
    expectSame(*room(), "order");
}

TEST_F(LabelComposition, transparentReceiversShowTheSameInEitherOrder)
{
    expectSame(*room(true), "glass");
}

TEST_F(LabelComposition, samplesShowTheSameInEitherOrder)
{
    support::HeadlessSettings settings{Width, Height};
    settings.samples = 4;
    support::HeadlessViewer smooth(settings);
    OSGKITS_NEED_GL(smooth);
    smooth.getViewer().setLightingMode(osg::View::NO_LIGHT);
    expectSame(*room(true), "samples", smooth);
}

namespace
{

osg::ref_ptr<osgLabels::PrimitiveBatch> batchOfBoxes()
{
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    for (int i = 0; i < 3; ++i)
    {
        osgLabels::Primitive primitive;
        primitive.size = osg::Vec3(0.25f, 0.1f, 0.15f);
        primitive.position = osg::Vec3d(-0.7 + 0.7 * i, -0.1, 0.3 - 0.3 * i);
        primitive.color = osg::Vec4ub(255, 153, 102, 255);
        primitive.name = "B-" + std::to_string(i);
        batch->add(primitive);
    }
    batch->build();
    return batch;
}

/// The room's wall and lamp with the boxes of a batch, or the same as Drawables.
osg::ref_ptr<osg::Group> roomOfBoxes(bool asBatch)
{
    const osg::ref_ptr<osg::Group> group = room();
    group->removeChildren(2, 2);
    if (asBatch)
        group->addChild(batchOfBoxes());
    for (int i = 0; i < 3 && !asBatch; ++i)
        group->addChild(box("B-" + std::to_string(i),
                            {-0.7f + 0.7f * float(i), -0.1f, 0.3f - 0.3f * float(i)},
                            {0.25f, 0.1f, 0.15f}, {1, 0.6f, 0.4f, 1}));
    return group;
}

} // namespace

TEST_F(LabelComposition, batchesShowTheSameInEitherOrder)
{
    expectSame(*roomOfBoxes(true), "batch");
}

TEST_F(LabelComposition, batchesCastAndReceiveAsDrawablesDo)
{
    const Picture batch = render(*shadowed(roomOfBoxes(true)));
    const Picture drawables = render(*shadowed(roomOfBoxes(false)));
    EXPECT_TRUE(areAlike(batch, drawables, "labelComposition.batchShadows"));
    const Picture labels = render(*labelled(shadowed(roomOfBoxes(true)), Plain));
    EXPECT_TRUE(areAlike(labels, render(*labelled(shadowed(roomOfBoxes(false)), Plain)),
                         "labelComposition.batchLabels"));
}

TEST_F(LabelComposition, innerLabelsAreOnTheirPartOnly)
{
    const auto build = [](bool hasLabels)
    {
        const osg::ref_ptr<osg::Group> group = room();
        const osg::ref_ptr<osg::Node> tank = group->getChild(3);
        group->removeChild(3);
        group->addChild(hasLabels ? labelled(tank, Plain).get() : tank.get());
        return group;
    };
    const osg::ref_ptr<osg::Group> part = build(true);
    const Picture with = render(*shadowed(part)), without = render(*shadowed(build(false)));
    ASSERT_TRUE(with && without);
    keep(with, "labelComposition.part");
    EXPECT_GT(changedShare(*with, *without), 0.002);
    // The tank lies right of the middle.
    unsigned int left = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width / 2; ++x)
            left += with->getColor(x, y) != without->getColor(x, y);
    EXPECT_EQ(left, 0u);
    EXPECT_EQ(countOf(static_cast<LabelScene&>(*part->getChild(3)), "labels.drawables"), 1.0);
}

TEST_F(LabelComposition, whatIsSwitchedOnLaterHasLabels)
{
    const osg::ref_ptr<osg::Group> root = unlit();
    osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    choice->addChild(box("ONE", {-0.5f, 0, 0}, {0.4f, 0.2f, 0.2f}), false);
    root->addChild(choice);
    const auto scene = labelled(root, Plain);
    ASSERT_TRUE(render(*scene));
    EXPECT_EQ(countOf(*scene, "labels.drawables"), -1.0) << decisionOf(*scene);
    choice->setValue(0, true);
    EXPECT_TRUE(waitForLabels(*scene, 1.0)) << decisionOf(*scene);
    choice->addChild(box("TWO", {0.5f, 0, 0}, {0.4f, 0.2f, 0.2f}));
    EXPECT_TRUE(waitForLabels(*scene, 2.0)) << decisionOf(*scene);
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(box("NEAR", {0, 0, 0.6f}, {0.4f, 0.1f, 0.1f}), 0.0f, 2.0f);
    lod->addChild(box("FAR", {0, 0, 0.6f}, {0.4f, 0.1f, 0.1f}), 2.0f, 100.0f);
    root->addChild(lod);
    EXPECT_TRUE(waitForLabels(*scene, 3.0)) << decisionOf(*scene);
    const Picture actual = render(*scene);
    EXPECT_TRUE(areEqual(actual, render(*labelled(root, Plain)), "labelComposition.later"));
}

TEST_F(LabelComposition, whatThePagerLoadsHasLabels)
{
    support::TemporaryFolder folder;
    const std::string file = folder.file("part.osgt");
    const osg::ref_ptr<osg::Group> part = unlit();
    part->addChild(box("PAGED", {0, 0, 0}, {0.6f, 0.2f, 0.3f}));
    ASSERT_TRUE(osgDB::writeNodeFile(*part, file));
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setFileName(0, file);
    paged->setRange(0, 0.0f, 1000.0f);
    paged->setCenter(osg::Vec3());
    paged->setRadius(1.0f);
    const auto scene = labelled(paged, Plain);
    EXPECT_TRUE(waitForLabels(*scene, 1.0)) << decisionOf(*scene);
    EXPECT_TRUE(areEqual(render(*scene), render(*labelled(part, Plain)), "labelComposition.paged"));
    viewer().getViewer().setSceneData(nullptr);
}

TEST_F(LabelComposition, withoutALabelledObjectInViewThereIsNoTargetAndNoPass)
{
    const osg::ref_ptr<osg::Group> root = unlit();
    root->addChild(rectangle({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1, 1}));
    root->addChild(box("BEHIND", {0, -9, 0}, {0.4f, 0.2f, 0.2f}));
    const auto scene = labelled(root, Plain);
    const Picture actual = render(*scene);
    EXPECT_EQ(decisionOf(*scene), "dropped: nothing labelled is in view");
    EXPECT_EQ(countOf(*scene, "labels.bytes.targets"), -1.0);
    EXPECT_TRUE(areEqual(actual, render(*root), "labelComposition.none"));
    root->addChild(box("BEFORE", {0, 0, 0}, {0.9f, 0.2f, 0.2f}));
    const auto shown = labelled(root, Plain);
    ASSERT_TRUE(render(*shown));
    EXPECT_EQ(decisionOf(*shown),
              "drawn: 1 drawables, 0 of them blended or sorted, labelled as they "
              "are drawn");
    // RGBA8, depth, and four integers on the surface.
    EXPECT_EQ(countOf(*shown, "labels.bytes.targets"), Width * Height * (4.0 + 4 + 16));
}
