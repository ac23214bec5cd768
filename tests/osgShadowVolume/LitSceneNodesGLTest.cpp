// SPDX-License-Identifier: MIT
#include "LitPictures.h"

#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>
#include <support/WindowViews.h>

#include <osg/Billboard>
#include <osg/Camera>
#include <osg/ClearNode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/OcclusionQueryNode>
#include <osg/PagedLOD>
#include <osg/Switch>
#include <osg/Texture2D>
#include <osgDB/WriteFile>

#include <atomic>
#include <chrono>
#include <thread>

using lit::ball;
using lit::expectSameAsStock;
using lit::makeTransparent;

namespace
{

const osg::Vec4 Red(1, 0.2, 0.2, 0.6), Green(0.2, 1, 0.2, 0.6), Blue(0.3, 0.3, 1, 0.6);

osg::ref_ptr<osg::Group> group(std::initializer_list<osg::ref_ptr<osg::Node>> children)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const osg::ref_ptr<osg::Node>& child : children)
        group->addChild(child);
    return group;
}

osg::ref_ptr<osg::Geode> glass(const osg::Vec3& center, const osg::Vec4& color, bool nest = true)
{
    osg::ref_ptr<osg::Geode> geode = ball(center, color);
    makeTransparent(*geode, nest);
    return geode;
}

class LitSceneNodes : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(lit::viewer()); }
    support::NotifyCapture _notify;
};

} // namespace

TEST_F(LitSceneNodes, transparentLeavesSortWithSiblingsInsideAndOutsideOfTheGroup)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            kit.addChild(glass({-0.3f, 0, 0}, Green));
            kit.addChild(ball({0.8f, 1.5f, 0.3f}));
            kit.addChild(glass({0.2f, -2.4f, 0}, Green));
            return group({glass({0.5f, -1.2f, 0}, Red), &kit, glass({0, 1.2f, 0.2f}, Blue),
                          ball({-1, 1, -0.3f}), glass({-0.6f, -3.0f, 0.2f}, Blue)});
        },
        "lit.transparentSiblings");
}

TEST_F(LitSceneNodes, opaqueSiblingsStandBeforeBehindAndAroundTheGroup)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            kit.addChild(ball({0, 0, 0}, Green));
            osg::ref_ptr<osg::Geode> back = ball({0.8f, 1, 0}, Blue);
            back->getOrCreateStateSet()->setRenderBinDetails(-1, "RenderBin");
            kit.addChild(back);
            osg::ref_ptr<osg::Geode> last = ball({0.5f, 0.5f, 0.5f}, Red);
            last->getOrCreateStateSet()->setRenderBinDetails(5, "RenderBin");
            last->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
            osg::ref_ptr<osg::Geode> first = ball({-0.9f, -1, 0}, Red);
            first->getOrCreateStateSet()->setRenderBinDetails(-2, "RenderBin");
            first->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
            return group({last, &kit, first});
        },
        "lit.opaqueSiblings");
}

TEST_F(LitSceneNodes, binsBelowZeroDrawBeforeTheRest)
{
    // Without depth test only the order of the bins decides.
    expectSameAsStock(
        [](osg::Group& kit)
        {
            for (int bin : {3, -1, 0, -7, 1})
            {
                osg::ref_ptr<osg::Geode> geode = ball({0.12f * bin, 0, 0.05f * bin * bin},
                                                      osg::Vec4(0.3 + 0.2 * bin, 0.5, 0.8, 1));
                if (bin)
                    geode->getOrCreateStateSet()->setRenderBinDetails(bin, "RenderBin");
                geode->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
                kit.addChild(geode);
            }
            return group({&kit});
        },
        "lit.bins");
}

TEST_F(LitSceneNodes, binsThatDoNotNestEscapeTheBinOfTheGroup)
{
    // Inventor's transparent leaves: not nested, under a group that lies in a bin of its own.
    expectSameAsStock(
        [](osg::Group& kit)
        {
            kit.addChild(glass({0.3f, -1.0f, 0}, Red, false));
            kit.addChild(ball({-0.5f, 0, 0}, Green));
            osg::ref_ptr<osg::Group> inBin = group({&kit});
            inBin->getOrCreateStateSet()->setRenderBinDetails(-3, "RenderBin");
            return group(
                {inBin, ball({0.9f, 0.9f, 0}, Blue), glass({0.2f, -1.9f, 0.1f}, Blue, false)});
        },
        "lit.binsThatEscape");
}

TEST_F(LitSceneNodes, aPlainGeodeBesideTheGroupStaysOutsideOfIt)
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lit::Lighting::OFF);
    kit->addChild(ball({-0.9f, 0, 0}));
    osg::ref_ptr<osg::Group> scene = group({ball({0.9f, 0, 0}), kit, ball({0, 0, 1.4f})});
    const osg::ref_ptr<osg::Image> image = lit::picture(*scene);
    ASSERT_TRUE(image.valid());
    EXPECT_EQ(lit::planOf(*kit).counts.at("drawCalls"), 1.0);
    // The ball in the group is unlit, white up to its edge; those outside are shaded.
    const auto isFlat = [&](int left, int right)
    {
        unsigned int white = 0, shaded = 0;
        for (int y = 0; y < lit::Height; ++y)
            for (int x = left; x < right; ++x)
            {
                const osg::Vec4 color = image->getColor(x, y);
                white += color.r() > 0.99f && color.g() > 0.99f;
                shaded += color.r() > 0.25f && color.r() <= 0.95f && color.r() == color.g();
            }
        return white > 10 * shaded;
    };
    EXPECT_TRUE(isFlat(0, lit::Width / 2 - 22));
    EXPECT_FALSE(isFlat(lit::Width / 2 + 22, lit::Width));
}

TEST_F(LitSceneNodes, theSameGroupUnderTwoParentsIsDrawnTwice)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            kit.addChild(ball({-0.2f, 0, 0}, Green));
            kit.addChild(glass({0.2f, -0.9f, 0}, Red));
            osg::ref_ptr<osg::MatrixTransform> left =
                new osg::MatrixTransform(osg::Matrix::translate(-1, 0, 0));
            osg::ref_ptr<osg::MatrixTransform> right =
                new osg::MatrixTransform(osg::Matrix::translate(1, 0.3, 0));
            left->addChild(&kit);
            right->addChild(&kit);
            return group({left, right, ball({0, 1, 0.8f}, Blue)});
        },
        "lit.twoParents");
}

TEST_F(LitSceneNodes, theSameGroupTwiceHasTheLightsOfEachPlacePerPixel)
{
    // Two lights of short reach, one at each place: the lists of the two appearances differ.
    const auto scene = [](bool twice)
    {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        osg::ref_ptr<osg::Group> places = new osg::Group;
        for (unsigned int place = 0; place < 2; ++place)
        {
            osg::ref_ptr<osg::Node> source =
                lit::lightSource(1 + place, osg::Vec4(place ? 1 : -1, -1.3f, 0.3f, 1),
                                 place ? osg::Vec4(1, 0, 0, 1) : osg::Vec4(0, 1, 0, 1),
                                 *root->getOrCreateStateSet());
            static_cast<osg::LightSource*>(source.get())
                ->getLight()
                ->setQuadraticAttenuation(20.0f);
            static_cast<osg::LightSource*>(source.get())->getLight()->setConstantAttenuation(0.2f);
            root->addChild(source);
        }
        osg::ref_ptr<osgShadowVolume::LitScene> shared;
        for (unsigned int place = 0; place < 2; ++place)
        {
            if (!twice || !shared)
            {
                shared = lit::litScene(lit::Lighting::PIXEL);
                shared->addChild(ball({0, 0, 0}));
                shared->addChild(glass({0, -0.3f, 0.2f}, osg::Vec4(1, 1, 1, 0.7f)));
            }
            osg::ref_ptr<osg::MatrixTransform> at =
                new osg::MatrixTransform(osg::Matrix::translate(place ? 1 : -1, 0, 0));
            at->addChild(shared);
            places->addChild(at);
        }
        root->addChild(places);
        return root;
    };
    const osg::ref_ptr<osg::Image> shared = lit::picture(*scene(true));
    const osg::ref_ptr<osg::Image> apart = lit::picture(*scene(false));
    ASSERT_TRUE(shared.valid() && apart.valid());
    EXPECT_TRUE(support::CompareImage()(shared, apart, "lit.twicePerPixel"));
}

TEST_F(LitSceneNodes, nestedGroupsDrawOnce)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            osg::ref_ptr<osgShadowVolume::LitScene> inner = lit::litScene(lit::Lighting::VERTEX);
            inner->addChild(ball({0.8f, 0, 0}, Red));
            inner->addChild(glass({0, -1, 0}, Blue));
            kit.addChild(inner);
            kit.addChild(ball({-0.8f, 0, 0}, Green));
            return group({&kit});
        },
        "lit.nested");
}

TEST_F(LitSceneNodes, clearNodesInTheGroupSetTheBackground)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            osg::ref_ptr<osg::ClearNode> clear = new osg::ClearNode;
            clear->setClearColor(osg::Vec4(0.7f, 0.1f, 0.4f, 1));
            clear->addChild(ball({0, 0, 0}));
            kit.addChild(clear);
            return group({&kit});
        },
        "lit.clearNode");
}

TEST_F(LitSceneNodes, lodSwitchBillboardAndOcclusionQueryAreFollowed)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            osg::ref_ptr<osg::LOD> lod = new osg::LOD;
            lod->addChild(ball({-1.2f, 0, 0}, Red), 0, 5);
            lod->addChild(ball({-1.0f, 0, 0.3f}, Green), 5, 1e6);
            osg::ref_ptr<osg::Switch> choice = new osg::Switch;
            choice->addChild(ball({0.2f, 0, 0.9f}, Red), false);
            choice->addChild(ball({0.3f, 0, 1.1f}, Blue), true);
            osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
            osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
                osg::Vec3(-0.4f, 0, -0.4f), osg::Vec3(0.8f, 0, 0), osg::Vec3(0, 0, 0.8f));
            billboard->addDrawable(quad, osg::Vec3(0.9f, 0, -0.4f));
            osg::ref_ptr<osg::OcclusionQueryNode> query = new osg::OcclusionQueryNode;
            query->addChild(ball({-0.2f, -1, -0.6f}, Green));
            kit.addChild(lod);
            kit.addChild(choice);
            kit.addChild(billboard);
            kit.addChild(query);
            return group({&kit});
        },
        "lit.nodes", 4);
}

TEST_F(LitSceneNodes, pagedChildrenAreLitWhenTheyArrive)
{
    support::TemporaryFolder folder;
    const std::string tile = folder.file("tile.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*ball({0.3f, 0, 0.2f}, Green), tile));
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->setCenter(osg::Vec3(0, 0, 0));
    paged->setRadius(2.0f);
    paged->setFileName(0, tile);
    paged->setRange(0, 0.0f, 1e6f);
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lit::Lighting::VERTEX);
    kit->addChild(paged);
    for (int wait = 0; wait < 6000 && paged->getNumChildren() == 0; ++wait)
    {
        lit::picture(*kit, 1);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_EQ(paged->getNumChildren(), 1u) << "the pager loaded nothing in 30 s";
    const osg::ref_ptr<osg::Image> actual = lit::picture(*kit);
    EXPECT_GT(lit::planOf(*kit).counts.at("leaves.program"), 0.0);
    osg::ref_ptr<osg::Group> plain = group({ball({0.3f, 0, 0.2f}, Green)});
    EXPECT_TRUE(support::CompareImage()(actual, lit::picture(*plain), "lit.paged"));
}

TEST_F(LitSceneNodes, animatedModelsMoveAndAreFollowed)
{
    osg::ref_ptr<osg::MatrixTransform> turn = new osg::MatrixTransform;
    turn->setDataVariance(osg::Object::DYNAMIC);
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lit::Lighting::VERTEX);
    turn->addChild(ball({0.8f, 0, 0}));
    kit->addChild(turn);
    osg::ref_ptr<osg::Group> stock = group({turn});
    for (int step = 0; step < 4; ++step)
    {
        turn->setMatrix(osg::Matrix::rotate(step * 0.7, osg::Vec3(0, 1, 0)));
        const osg::ref_ptr<osg::Image> expected = lit::picture(*stock, 1),
                                       actual = lit::picture(*kit, 1);
        EXPECT_TRUE(support::CompareImage()(actual, expected, "lit.animated"));
    }
}

TEST_F(LitSceneNodes, camerasThatRenderToTexturesWorkInsideAndOutsideOfTheGroup)
{
    for (const bool inside : {false, true})
        expectSameAsStock(
            [inside](osg::Group& kit)
            {
                osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
                texture->setTextureSize(64, 64);
                texture->setInternalFormat(GL_RGBA);
                texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
                osg::ref_ptr<osg::Camera> camera = new osg::Camera;
                camera->setRenderOrder(osg::Camera::PRE_RENDER);
                camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
                camera->attach(osg::Camera::COLOR_BUFFER, texture);
                camera->setViewport(0, 0, 64, 64);
                camera->setClearColor(osg::Vec4(0.5f, 0.4f, 0, 1));
                camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
                camera->setViewMatrixAsLookAt({0, -4, 1}, {0, 0, 0}, {0, 0, 1});
                camera->setProjectionMatrixAsPerspective(30, 1, 1, 20);
                camera->addChild(ball({0, 0, 0}, Red));
                osg::ref_ptr<osg::Geode> quad = new osg::Geode;
                quad->addDrawable(osg::createTexturedQuadGeometry(
                    osg::Vec3(-1, 0, -1), osg::Vec3(2, 0, 0), osg::Vec3(0, 0, 2)));
                quad->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
                kit.addChild(quad);
                if (inside)
                    kit.addChild(camera);
                return inside ? group({&kit}) : group({camera, &kit});
            },
            inside ? "lit.rttInside" : "lit.rttOutside", 3);
}

TEST_F(LitSceneNodes, postRenderCamerasInTheGroupDrawOverIt)
{
    expectSameAsStock(
        [](osg::Group& kit)
        {
            osg::ref_ptr<osg::Camera> hud = new osg::Camera;
            hud->setRenderOrder(osg::Camera::POST_RENDER);
            hud->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
            hud->setViewMatrixAsLookAt({0, -12, 3}, {0, 0, 0}, {0, 0, 1});
            hud->setProjectionMatrixAsPerspective(30, double(lit::Width) / lit::Height, 1, 30);
            hud->setClearMask(GL_DEPTH_BUFFER_BIT);
            hud->addChild(ball({1.5f, 0, 0.8f}, Blue));
            kit.addChild(ball({0, 0, 0}, Green));
            kit.addChild(hud);
            return group({&kit});
        },
        "lit.postRender");
}

TEST_F(LitSceneNodes, severalViewsEachHaveAPlan)
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lit::Lighting::PIXEL);
    kit->addChild(ball({0, 0, 0}));
    const auto camera =
        support::CameraSpec::perspective({0, -8, 0}, {0, 0, 0}, {0, 0, 1}, 30.0, 1.0, 1.0, 20.0);
    const support::WindowViews views(
        *kit, 128, 64, {{camera, 0, 0, 64, 64, "left"}, {camera, 64, 0, 64, 64, "right"}});
    ASSERT_EQ(kit->getPlans().size(), 2u);
    EXPECT_EQ(kit->getPlans()[0].view, "left");
    EXPECT_EQ(kit->getPlans()[1].view, "right");
    EXPECT_EQ(kit->getPlans()[1].counts.at("variants.failed"), 0.0);
}

TEST_F(LitSceneNodes, contextsCloseAndOpenAgainWithTheSamePicture)
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lit::Lighting::PIXEL);
    kit->addChild(ball({0, 0, 0}));
    const osg::ref_ptr<osg::Image> first = lit::picture(*kit);
    for (int i = 0; i < 3; ++i)
    {
        support::HeadlessViewer other({lit::Width, lit::Height});
        const osg::ref_ptr<osg::Image> image =
            other.render(kit, lit::camera(), lit::Width, lit::Height, 2);
        EXPECT_TRUE(support::CompareImage()(image, first, "lit.secondContext"));
    }
    kit->releaseGLObjects(lit::viewer().getViewer().getCamera()->getGraphicsContext()->getState());
    EXPECT_TRUE(support::CompareImage()(lit::picture(*kit), first, "lit.afterRelease"));
    kit->releaseGLObjects();
    EXPECT_TRUE(support::CompareImage()(lit::picture(*kit), first, "lit.afterReleaseOfAll"));
}

namespace
{

/// Moves the vertices of a DYNAMIC geometry in the update, as an animation does.
class Wobble : public osg::DrawableUpdateCallback
{
public:
    void update(osg::NodeVisitor*, osg::Drawable* drawable) override
    {
        auto& vertices = static_cast<osg::Vec3Array&>(*drawable->asGeometry()->getVertexArray());
        for (osg::Vec3& v : vertices)
            v.z() += (++_count & 64u) ? 0.001f : -0.001f;
        vertices.dirty();
        drawable->dirtyBound();
    }

private:
    unsigned int _count = 0;
};

/// Looks at State's count of dynamic objects when a camera has drawn.
class CountAtEnd : public osg::Camera::DrawCallback
{
public:
    void operator()(osg::RenderInfo& renderInfo) const override
    {
        if (renderInfo.getState()->getDynamicObjectCount() != 0)
            wrong = renderInfo.getState()->getDynamicObjectCount();
        ++draws;
    }
    mutable std::atomic<unsigned int> wrong{0}, draws{0};
};

} // namespace

TEST_F(LitSceneNodes, dynamicDrawablesAreDrawnUnderAllThreadingModels)
{
    for (auto model :
         {osgViewer::ViewerBase::SingleThreaded, osgViewer::ViewerBase::CullDrawThreadPerContext,
          osgViewer::ViewerBase::DrawThreadPerContext,
          osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext})
    {
        osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lit::Lighting::PIXEL);
        for (int i = 0; i < 24; ++i)
        {
            osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
                osg::Vec3(-1, 0.05f * i, -1), osg::Vec3(2, 0, 0), osg::Vec3(0, 0, 2));
            quad->setDataVariance(osg::Object::DYNAMIC);
            quad->setUpdateCallback(new Wobble);
            osg::ref_ptr<osg::Geode> geode = new osg::Geode;
            geode->addDrawable(quad);
            if (i % 3 == 0)
                makeTransparent(*geode);
            if (i % 5 == 0)
                geode->getOrCreateStateSet()->setDataVariance(osg::Object::DYNAMIC);
            kit->addChild(geode);
        }
        support::HeadlessSettings settings{lit::Width, lit::Height};
        settings.threading = model;
        support::HeadlessViewer viewer(settings);
        osg::ref_ptr<CountAtEnd> count = new CountAtEnd;
        viewer.getViewer().getCamera()->setPostDrawCallback(count);
        EXPECT_TRUE(viewer.render(kit, lit::camera(), lit::Width, lit::Height, 40).valid());
        EXPECT_GE(count->draws, 40u);
        // Where one thread culls and draws, OSG does not set the count before it counts down.
        if (model >= osgViewer::ViewerBase::DrawThreadPerContext)
        {
            EXPECT_EQ(count->wrong, 0u) << "threading model " << model;
        }
    }
}
