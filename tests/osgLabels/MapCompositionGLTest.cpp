// SPDX-License-Identifier: MIT
// Map labels with batches, chunks, picks, surface labels, shadows and several views.
#include "MapPictures.h"

#include <osgLabels/LabelResources.h>
#include <osgLabels/PrimitiveBatch.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <support/WindowViews.h>

#include <osg/Camera>
#include <osg/LightSource>

using namespace mapScene;
using osgLabels::LabelScene;

namespace
{

class MapComposition : public MapTest
{
};

osg::ref_ptr<osg::Geode> before(const std::string& name = "before")
{
    return box(name, {-0.5f, -1, 0}, {0.5f, 0.2f, 0.7f}, {0.4f, 0.5f, 0.9f, 1});
}

osg::ref_ptr<osg::Geode> middle()
{
    return box("middle", {0, 0, 0}, {0.5f, 0.3f, 0.5f});
}

int whole(const std::string& text, const osg::Vec3d& anchor)
{
    return redPixels(*render(*scene({label(text, anchor)})));
}

/// Edges of plates are mixed with what is behind them.
constexpr int Edges = 12;

/// Blocks by their names and places along x.
osg::ref_ptr<osgLabels::PrimitiveBatch>
batchOf(const std::vector<std::pair<std::string, double>>& blocks)
{
    osg::ref_ptr<osgLabels::PrimitiveBatch> batch = new osgLabels::PrimitiveBatch;
    batch->setName("blocks");
    for (const auto& [name, x] : blocks)
    {
        osgLabels::Primitive block;
        block.shape = osgLabels::Shape::Box;
        block.size = osg::Vec3(0.3f, 0.3f, 0.5f);
        block.position = osg::Vec3d(x, 0, 0);
        block.name = name;
        batch->add(block);
    }
    batch->build();
    return batch;
}

LabelScene::Picked pickAt(LabelScene& scene, double x, double y)
{
    scene.pick(x, y);
    render(scene, labelScene::fromFront(), labelScene::Width, labelScene::Height, 1);
    return scene.takePicked().value_or(LabelScene::Picked{~0u, "no answer", ""});
}

} // namespace

TEST_F(MapComposition, objectsOfBatchesHideByTheirNames)
{
    const auto batch = batchOf({{"tower", -0.5}, {"tree", 0.5}});
    const osg::Vec3d left(-0.5, 0.5, 0), right(0.5, 0.5, 0);
    const auto pixels = [&](const osg::Vec3d& at, const std::string& own) {
        return redPixels(
            *render(*scene({batch, label("text", at, own)}, "mapclass='tree:ignore'")));
    };
    EXPECT_EQ(pixels(left, ""), 0);
    EXPECT_NEAR(pixels(left, "tower"), whole("text", left), Edges);
    EXPECT_NEAR(pixels(left, "blocks"), whole("text", left), Edges) << "the batch";
    EXPECT_NEAR(pixels(right, ""), whole("text", right), Edges) << "by its class";
    EXPECT_NEAR(pixels({-0.5, 0.2, 0}, ""), whole("text", {-0.5, 0.2, 0}), Edges) << "inside";
}

TEST_F(MapComposition, aFrameKeepsTheFeaturesThatItWasCulledWith)
{
    // Between the cull and the draw of a frame another cull gives the features other numbers.
    struct OtherCull : osg::Camera::DrawCallback
    {
        explicit OtherCull(LabelScene& ofScene) : scene(ofScene) {}
        void operator()(osg::RenderInfo&) const override
        {
            osgLabels::MapScene& map = *scene.getResources()->map;
            const auto before = map.features.getModifiedCount();
            map.features.use("ground");
            map.records.update(scene);
            hasChanged = map.features.getModifiedCount() != before;
        }
        LabelScene& scene;
        mutable bool hasChanged = false;
    };
    const osg::Vec3d at(-0.5, 0.5, 0);
    const auto top = scene({box("ground", {0, 1, -0.9f}, {1, 0.3f, 0.05f}),
                            batchOf({{"tower", -0.5}, {"tree", 0.5}}), label("text", at, "tower")});
    const int expected = redPixels(*render(*top));
    ASSERT_NEAR(expected, whole("text", at), Edges);
    const osg::ref_ptr<OtherCull> other = new OtherCull(*top);
    osg::Camera& camera = *labelScene::viewer().getViewer().getCamera();
    camera.addPreDrawCallback(other);
    const Picture picture =
        render(*top, labelScene::fromFront(), labelScene::Width, labelScene::Height, 1);
    camera.removePreDrawCallback(other);
    EXPECT_TRUE(other->hasChanged);
    EXPECT_EQ(redPixels(*picture), expected);
    EXPECT_EQ(redPixels(*render(*top)), expected) << "with the new numbers";
}

TEST_F(MapComposition, chunksHideAsTheirObjectsDo)
{
    const osg::Vec3d behind(-0.3, 0, 0);
    const auto pixels = [&](const osg::Vec3d& at, const std::string& own) {
        return redPixels(*render(*scene({middle(), before(), label("text", at, own)}, "chunk=on")));
    };
    EXPECT_EQ(pixels(behind, ""), 0);
    EXPECT_NEAR(pixels(behind, "before"), whole("text", behind), Edges);
    EXPECT_NEAR(pixels({-0.5, -0.9, 0}, ""), whole("text", {-0.5, -0.9, 0}), Edges) << "inside";
}

TEST_F(MapComposition, picksFindTheLabelOnTopWhereItIsSeen)
{
    const auto top =
        scene({before(), middle(), label("half of it", {0, 0, 0}, "middle")}, "surface=on");
    ASSERT_TRUE(render(*top));
    const LabelScene::Picked right = pickAt(*top, 0.1, 0), left = pickAt(*top, -0.1, 0),
                             beside = pickAt(*top, 0.1, 0.3);
    EXPECT_EQ(right.text, "half of it");
    EXPECT_GE(right.identifier, 0x80000000u);
    EXPECT_EQ(left.text, "before");
    EXPECT_EQ(beside.text, "middle");
    EXPECT_TRUE(top->setText(right.identifier, "another, longer text"));
    EXPECT_EQ(pickAt(*top, 0.4, 0).text, "another, longer text");
}

TEST_F(MapComposition, surfaceLabelsStayBelow)
{
    const auto both = scene({middle(), label("map", {0.3, 0, 0.3}, "middle")}, "surface=on");
    const auto surface = scene({middle()}, "surface=on");
    const Picture picture = render(*both), alone = render(*surface);
    keep(picture, "map-surface");
    EXPECT_EQ(redPixels(*picture) > redPixels(*alone), true);
    EXPECT_GT(redPixels(*alone), 0) << "the plate of the surface's label";
}

TEST_F(MapComposition, shadowsInEitherOrderShowTheSame)
{
    const auto model = [&]
    {
        osg::ref_ptr<osg::Group> group = new osg::Group;
        group->addChild(middle());
        group->addChild(before());
        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        source->getLight()->setPosition({2, -3, 3, 1});
        group->addChild(source);
        group->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
        group->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
        group->addChild(label("half of it", {0, 0, 0}, "middle"));
        return group;
    };
    osg::ref_ptr<osgShadowVolume::ShadowedScene> inner = new osgShadowVolume::ShadowedScene,
                                                 outer = new osgShadowVolume::ShadowedScene;
    inner->addChild(model());
    const auto labelsOutside = scene({inner}), labelsInside = scene({model()});
    outer->addChild(labelsInside);
    const Picture a = render(*labelsOutside), b = render(*outer);
    keep(a, "map-shadows-inside");
    keep(b, "map-shadows-outside");
    const int expected =
        redPixels(*render(*scene({middle(), before(), label("half of it", {0, 0, 0}, "middle")})));
    EXPECT_EQ(redPixels(*a), expected);
    EXPECT_EQ(redPixels(*b), expected);
    EXPECT_TRUE(labelScene::areAlike(a, b, "map-shadows"));
}

TEST_F(MapComposition, transparentSurfacesUnderShadowsHideFromHalfOfTheirOpacityOn)
{
    for (const float alpha : {0.3f, 0.7f})
    {
        osg::ref_ptr<osgShadowVolume::ShadowedScene> lit = new osgShadowVolume::ShadowedScene;
        const auto glass =
            sheet("glass", {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, {0.5f, 0.9f, 0.9f, alpha});
        glass->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        glass->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        lit->addChild(glass);
        lit->addChild(middle());
        EXPECT_EQ(redPixels(*render(*scene({lit, label("text", {0, 0, 0}, "middle")}))) > 0,
                  alpha < 0.5f)
            << alpha;
    }
}

TEST_F(MapComposition, viewportsBesideEachOtherHaveTargetsOfTheirOwn)
{
    const auto top = scene({before(), label("half of it", {0, 0, 0})});
    osg::ref_ptr<osg::Group> root = new osg::Group;
    for (const int x : {0, labelScene::Width / 2})
    {
        osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        const support::CameraSpec spec = labelScene::fromFront(2.0 / 3.0);
        camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        camera->setViewMatrix(spec.view);
        camera->setProjectionMatrix(spec.projection);
        camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setViewport(x, 0, labelScene::Width / 2, labelScene::Height);
        camera->setRenderOrder(osg::Camera::NESTED_RENDER);
        camera->addChild(top);
        root->addChild(camera);
    }
    const Picture picture = render(*root);
    keep(picture, "map-views");
    const int left = redPixels(*picture, 0, labelScene::Width / 2);
    EXPECT_GT(left, 100);
    EXPECT_EQ(left, redPixels(*picture, labelScene::Width / 2, labelScene::Width));
    EXPECT_EQ(redPixels(*picture, 0, labelScene::Width / 4), 0) << "hidden there";
}

TEST_F(MapComposition, slaveCamerasShowPartsOfOnePicture)
{
    const auto make = []
    {
        return labelScene::unlit(scene(
            {before(), middle(), label("half of it", {0, 0, 0}), label("across", {0, -1.5, 0.3})}));
    };
    const Picture joined = support::drawHalves(*make(), labelScene::fromFront(), labelScene::Width,
                                               labelScene::Height);
    const Picture whole = render(*make());
    ASSERT_TRUE(joined && whole);
    EXPECT_GT(redPixels(*whole, 0, labelScene::Width / 2), 100) << "one lies across";
    EXPECT_TRUE(labelScene::areAlike(joined, whole, "map-slaves"));
}

TEST_F(MapComposition, withoutLabelsInViewNothingIsDrawnForThem)
{
    const auto top = scene({before(), middle(), label("text", {0, -9, 0}), label("", {0, 0, 0})});
    ASSERT_TRUE(render(*top));
    EXPECT_EQ(countOf(*top, "map.labels"), -1);
    EXPECT_EQ(countOf(*top, "map.bytes.targets"), -1);
    const auto beside = scene({before(), middle(), label("text", {0.9, 0, 0.85})});
    ASSERT_TRUE(render(*beside));
    EXPECT_EQ(countOf(*beside, "map.occluders"), 0) << "nothing is near the label's box";
    EXPECT_EQ(countOf(*beside, "map.occluders.leftOut"), 2);
    EXPECT_EQ(countOf(*beside, "map.bytes.targets"), 0);
}

TEST_F(MapComposition, stateAndTextsMayChangeAtRunTime)
{
    const auto node = label("text", {0, 0, 0});
    const auto top = scene({before(), node}, "mapaction=ignore");
    const int all = redPixels(*render(*top));
    EXPECT_EQ(all, whole("text", {0, 0, 0}));
    osgLabels::LabelSettings settings = top->getSettings();
    settings.mapAction = osgLabels::MapAction::Hide;
    top->setSettings(settings);
    EXPECT_LT(redPixels(*render(*top)), all * 2 / 3);
    node->setLabels({{{0.3, 0, 0}, "longer text", 0, {}, {}}});
    EXPECT_GT(redPixels(*render(*top)), all);
    node->setLabels({});
    EXPECT_EQ(redPixels(*render(*top)), 0);
}
