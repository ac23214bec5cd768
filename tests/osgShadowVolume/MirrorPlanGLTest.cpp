// SPDX-License-Identifier: MIT
// Which mirrors get pictures of their own, and what the plan says of them.
#include "MirrorPictures.h"

#include <support/NotifyCapture.h>

#include <osg/CullFace>
#include <osg/Geometry>

using namespace mirrorScene;
using osgMultiRender::PlanEntry;
using osgShadowVolume::ShadowedScene;

TEST(MirrorPlanGLTest, mirrorsThatDoNotShowCostNothing)
{
    OSGKITS_NEED_GL(viewer());
    struct Case
    {
        const char* reason;
        osg::Vec3d eye, center;
    };
    const osg::Vec3d middle = Corner + Along * 0.5f + Up * 0.5f;
    for (const Case& each :
         {Case{"it is behind the viewer", {0, -4, 2}, {0, -9, 2}},
          Case{"it is out of view", {0, -6, 2}, {-20, -5.5, 2}},
          Case{"it is seen edge-on", osg::Vec3d(Corner) - osg::Vec3d(Along), middle}})
    {
        osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
        scene->addChild(
            box(each.center, {1, 1, 1}, {1, 1, 1, 1})); // without leaves there is no plan
        picture(*scene, camera(each.eye, each.center));
        EXPECT_EQ(reasonOf(*scene, "mirror 'wall'", PlanEntry::Decision::Dropped), each.reason);
        EXPECT_EQ(passesOf(*scene), 0.0);
        EXPECT_EQ(scene->getPlans().size(), 1u) << "a view of a mirror has been drawn";
    }
    osg::ref_ptr<osg::Geode> oneSided = wall();
    oneSided->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace);
    osg::ref_ptr<ShadowedScene> scene = wallScene(oneSided);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 1.0) << "its front faces the viewer";
    picture(*scene, camera({0, 9, 4}, {0, 0, 1}));
    EXPECT_EQ(passesOf(*scene), 0.0) << "its back does";
    osg::ref_ptr<ShadowedScene> without = wallScene(wall(""));
    picture(*without);
    EXPECT_EQ(passesOf(*without), -1.0) << "the plan of a scene without mirrors speaks of them";
    scene = wallScene(wall());
    scene->setMirrors(false);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), -1.0);
}

TEST(MirrorPlanGLTest, twoMirrorsThatFaceEachOtherReflectOnce)
{
    OSGKITS_NEED_GL(viewer());
    const auto facing = [](const std::string& second)
    {
        osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
        osg::ref_ptr<osg::Geode> other =
            quad({3, -7, 0}, {0, 7, 0}, {0, 0, 3}, {0.5f, 0.1f, 0.1f, 1});
        other->setName("other");
        if (!second.empty())
            other->addDescription(second);
        scene->addChild(other);
        return scene;
    };
    const support::CameraSpec from = camera({-3, -8, 3}, {1, 0, 1.5});
    osg::ref_ptr<ShadowedScene> both = facing("mirror=1"), one = facing("");
    const auto actual = picture(*both, from), expected = picture(*one, from);
    EXPECT_EQ(passesOf(*both), 2.0);
    EXPECT_EQ(both->getPlans().size(), 3u) << "the view and one picture of each mirror";
    // In the first mirror the second one shows its own surface, as if it were none.
    const auto mask = wallMask(from);
    unsigned int wrong = 0, red = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            if (pixel(*mask, x, y)[0] != 255)
                continue;
            // Where the other mirror stands before the wall, that one reflects.
            const bool covered = !isAlike(pixel(*actual, x, y), pixel(*expected, x, y), 1);
            wrong += covered;
            const unsigned char* p = pixel(*expected, x, y);
            red += p[0] > 2 * p[1] + 20;
        }
    EXPECT_GT(red, 50u) << "the second mirror is not seen in the first";
    EXPECT_LT(wrong, 900u);
    support::writeImage(*actual, "mirrorsFacing.actual");
    support::writeImage(*expected, "mirrorsFacing.expected");
}

TEST(MirrorPlanGLTest, tilesOfOnePlaneShareAPicture)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> whole = wallScene(wall());
    osg::ref_ptr<ShadowedScene> tiled = emptyScene();
    tiled->addChild(lights());
    tiled->addChild(things());
    for (int i = 0; i < 3; ++i)
    {
        osg::ref_ptr<osg::Geode> tile =
            quad(Corner + Along * (float(i) / 3.0f), Along / 3.0f, Up, {0, 0, 0, 1});
        tile->setName("mirror=1 tile " + std::to_string(i));
        tiled->addChild(tile);
    }
    const auto actual = picture(*tiled), expected = picture(*whole);
    EXPECT_TRUE(support::CompareImage()(actual, expected, "mirrorTiles"));
    EXPECT_EQ(passesOf(*tiled), 1.0);
    EXPECT_NE(reasonOf(*tiled, "mirror 'mirror=1 tile 2'", PlanEntry::Decision::Folded), "");
}

TEST(MirrorPlanGLTest, theLargestMirrorsAreDrawnUpToTheLimit)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<ShadowedScene> scene = wallScene(wall());
    osg::ref_ptr<osg::Geode> small = quad({-3.5f, -2, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0, 1});
    small->setName("mirror_small");
    scene->insertChild(0, small);
    scene->setMaxMirrors(1);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 1.0);
    EXPECT_NE(reasonOf(*scene, "mirror 'wall'", PlanEntry::Decision::Drawn), "");
    EXPECT_NE(
        reasonOf(*scene, "mirror 'mirror_small'", PlanEntry::Decision::Dropped).find("maxmirrors"),
        std::string::npos);
    scene->setMaxMirrors(2);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 2.0);
}

TEST(MirrorPlanGLTest, aCurvedMirrorWarnsOnceAndReflectsNothing)
{
    OSGKITS_NEED_GL(viewer());
    support::NotifyCapture capture;
    osg::ref_ptr<osg::Geode> ball = box({0, 0, 2}, {1, 1, 1}, {0.5f, 0.5f, 0.5f, 1});
    ball->setName("mirror_ball");
    osg::ref_ptr<ShadowedScene> scene = wallScene(ball);
    picture(*scene);
    picture(*scene);
    EXPECT_EQ(capture.takeWarnings(),
              support::NotifyCapture::Lines{
                  "osgShadowVolume::ShadowedScene: mirror 'mirror_ball' is not planar, so it "
                  "reflects nothing; a mirror has to be one flat Drawable"});
    EXPECT_EQ(reasonOf(*scene, "mirror 'mirror_ball'", PlanEntry::Decision::Dropped),
              "it is not planar");
}

TEST(MirrorPlanGLTest, trianglesWithIndicesBeyondTheVerticesAreNoPartOfAMirror)
{
    OSGKITS_NEED_GL(viewer());
    osg::ref_ptr<osg::Geode> torn = wall();
    osg::Geometry& geometry = *torn->getDrawable(0)->asGeometry();
    // What OSG itself makes of such indices is its own affair.
    const osg::BoundingBox box = geometry.getBoundingBox();
    geometry.setInitialBound(box);
    geometry.setComputeBoundingBoxCallback(new osg::Drawable::ComputeBoundingBoxCallback);
    geometry.removePrimitiveSet(0);
    osg::ref_ptr<osg::DrawElementsUShort> elements = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (const GLushort i : {0, 1, 2, 0, 2, 3, 0, 1, 60000})
        elements->push_back(i);
    geometry.addPrimitiveSet(elements);
    osg::ref_ptr<ShadowedScene> scene = wallScene(torn);
    picture(*scene);
    EXPECT_EQ(passesOf(*scene), 1.0);
}
