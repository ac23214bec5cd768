// SPDX-License-Identifier: MIT
#include "VolumePictures.h"

#include <support/NotifyCapture.h>

#include <osgShadowVolume/CasterCache.h>

#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Switch>
#include <osgAnimation/Bone>
#include <osgAnimation/MorphGeometry>
#include <osgAnimation/RigGeometry>
#include <osgAnimation/Skeleton>

using namespace volumeScene;
using floorScene::fromAbove;
using osgShadowVolume::CasterCache;
using osgShadowVolume::ShadowedScene;
using Picture = osg::ref_ptr<osg::Image>;
using osgViewer::ViewerBase;

// Casters that move, change and come and go.

namespace
{

class ShadowMotion : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(floorScene::viewer()); }

    support::NotifyCapture _notify;
    osg::ref_ptr<CasterCache> _cache = CasterCache::instance();
};

/// A square of side 1 above (x, y), whose shadow lies 2 to the left.
osg::ref_ptr<osg::Vec3Array> square(float x, float y)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec2& corner :
         {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)})
        vertices->push_back(osg::Vec3(x + corner.x() - 0.5f, y + corner.y() - 0.5f, 2));
    return vertices;
}

osg::ref_ptr<osg::Geometry> squareGeometry(float x, float y)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(square(x, y));
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    normals->assign(4, osg::Vec3(0, 0, 1)); // osgAnimation skins one a vertex
    geometry->setNormalArray(normals);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
    return geometry;
}

osg::ref_ptr<osg::Geode> geodeOf(osg::Drawable* drawable)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(drawable);
    return geode;
}

osg::ref_ptr<ShadowedScene> floorAndLight()
{
    const auto scene = shadowed();
    scene->addChild(floorScene::floorGeode());
    scene->addChild(floorScene::lightSource(0, osg::Vec4(1, 0, 1, 0)));
    return scene;
}

/// Where the middle of the dark pixels lies on the floor.
osg::Vec2d shadowOf(const osg::Image& image)
{
    osg::Vec2d sum;
    int count = 0;
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x)
            if (floorScene::red(image, x, y) < 20)
            {
                sum += floorScene::placeOf(x, y);
                ++count;
            }
    return count ? sum / count : osg::Vec2d(100, 100);
}

/// The shadow of a unit square at this place; a pixel is 1/32 wide.
void expectShadowAt(const Picture& picture, double x, double y, const std::string& name)
{
    ASSERT_TRUE(picture);
    keep(picture, name);
    EXPECT_NEAR(darkShare(*picture), 1.0 / 64.0, 0.0008) << name;
    EXPECT_LT((shadowOf(*picture) - osg::Vec2d(x, y)).length(), 0.04) << name;
}

/// Moves the vertices of a square in each update.
class Wander : public osg::Drawable::UpdateCallback
{
public:
    void update(osg::NodeVisitor* visitor, osg::Drawable* drawable) override
    {
        const unsigned int frame = visitor->getFrameStamp()->getFrameNumber();
        auto* vertices = static_cast<osg::Vec3Array*>(drawable->asGeometry()->getVertexArray());
        *vertices = *square(xAt(frame), 1.0f);
        vertices->dirty();
        drawable->dirtyBound();
    }
    static float xAt(unsigned int frame) { return 0.25f * float(frame % 8); }
};

/// Turns a transform in each update.
class Slide : public osg::NodeCallback
{
public:
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override
    {
        const unsigned int frame = visitor->getFrameStamp()->getFrameNumber();
        static_cast<osg::MatrixTransform*>(node)->setMatrix(
            osg::Matrix::translate(Wander::xAt(frame), -2, 0));
        traverse(node, visitor);
    }
};

} // namespace

TEST_F(ShadowMotion, everyThreadingModelShowsMovingCastersOfTheirFrame)
{
    for (const auto threading :
         {ViewerBase::SingleThreaded, ViewerBase::CullDrawThreadPerContext,
          ViewerBase::DrawThreadPerContext, ViewerBase::CullThreadPerCameraDrawThreadPerContext})
    {
        support::HeadlessSettings settings{floorScene::Width, floorScene::Height};
        settings.threading = threading;
        support::HeadlessViewer viewer(settings);
        OSGKITS_NEED_GL(viewer);
        viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
        const auto scene = floorAndLight();
        const auto wandering = squareGeometry(0, 1);
        wandering->setDataVariance(osg::Object::DYNAMIC);
        wandering->setUpdateCallback(new Wander);
        scene->addChild(geodeOf(wandering));
        const auto sliding = moved({0, -2, 0}, geodeOf(squareGeometry(0, 0)));
        sliding->setDataVariance(osg::Object::DYNAMIC);
        sliding->setUpdateCallback(new Slide);
        scene->addChild(sliding);
        for (unsigned int frames = 1; frames < 12; ++frames)
        {
            const Picture picture = viewer.render(scene, fromAbove(), floorScene::Width,
                                                  floorScene::Height, 1 + frames % 3);
            ASSERT_TRUE(picture);
            const float x = Wander::xAt(viewer.getViewer().getFrameStamp()->getFrameNumber());
            // Both squares have moved by x; so the middle of their shadows.
            EXPECT_NEAR(darkShare(*picture), 2.0 / 64.0, 0.0016) << int(threading);
            EXPECT_LT((shadowOf(*picture) - osg::Vec2d(x - 2, -0.5)).length(), 0.04)
                << int(threading) << ", frame " << frames;
        }
    }
}

TEST_F(ShadowMotion, aMovedCasterCostsAMatrixOnly)
{
    const auto scene = floorAndLight();
    const auto transform = moved({0, 0, 0}, geodeOf(squareGeometry(0, 0)));
    scene->addChild(transform);
    expectShadowAt(render(*scene, fromAbove()), -2, 0, "motion.start");
    const std::size_t built = _cache->getBuilt();
    for (int i = 1; i < 6; ++i)
    {
        transform->setMatrix(osg::Matrix::translate(0.5 * i, 0.2 * i, 0));
        expectShadowAt(render(*scene, fromAbove()), -2 + 0.5 * i, 0.2 * i, "motion.moved");
    }
    EXPECT_EQ(_cache->getBuilt(), built);
    // Another light sees the same mesh.
    scene->addChild(floorScene::lightSource(1, osg::Vec4(-1, 0, 1, 0)));
    ASSERT_TRUE(render(*scene, fromAbove()));
    EXPECT_EQ(_cache->getBuilt(), built);
}

TEST_F(ShadowMotion, changedVerticesRebuildTheirMeshAlone)
{
    const auto scene = floorAndLight();
    const auto geometry = squareGeometry(0, 0);
    scene->addChild(moved({0, 0, 0}, geodeOf(geometry)));
    scene->addChild(moved({0, 20, 0}, geodeOf(squareGeometry(0, 0))));
    expectShadowAt(render(*scene, fromAbove()), -2, 0, "motion.before");
    const std::size_t built = _cache->getBuilt();
    auto* vertices = static_cast<osg::Vec3Array*>(geometry->getVertexArray());
    *vertices = *square(1, 2);
    vertices->dirty();
    geometry->dirtyBound();
    expectShadowAt(render(*scene, fromAbove(), 256, 256, 4), -1, 2, "motion.dirty");
    EXPECT_EQ(_cache->getBuilt(), built + 1);
    // Another array in its place, then other indices.
    geometry->setVertexArray(square(2, -1));
    expectShadowAt(render(*scene, fromAbove()), 0, -1, "motion.exchanged");
    EXPECT_EQ(_cache->getBuilt(), built + 2);
}

TEST_F(ShadowMotion, skinnedMeshesCastWhatTheyShow)
{
    osg::ref_ptr<osgAnimation::Skeleton> skeleton = new osgAnimation::Skeleton;
    osg::ref_ptr<osgAnimation::Bone> bone = new osgAnimation::Bone("bone");
    skeleton->addChild(bone);
    osg::ref_ptr<osgAnimation::RigGeometry> rig = new osgAnimation::RigGeometry;
    rig->setSourceGeometry(squareGeometry(0, 0));
    osg::ref_ptr<osgAnimation::VertexInfluenceMap> influences =
        new osgAnimation::VertexInfluenceMap;
    osgAnimation::VertexInfluence& influence = (*influences)["bone"];
    influence.setName("bone");
    for (unsigned int i = 0; i < 4; ++i)
        influence.push_back(osgAnimation::VertexIndexWeight(i, 1.0f));
    rig->setInfluenceMap(influences);
    skeleton->addChild(geodeOf(rig));
    const auto scene = floorAndLight();
    scene->addChild(skeleton);
    expectShadowAt(render(*scene, fromAbove()), -2, 0, "motion.rest");
    for (const osg::Vec2d& place : {osg::Vec2d(0.5, 0), osg::Vec2d(0.3, 0.4)})
    {
        bone->setMatrixInSkeletonSpace(osg::Matrix::translate(place.x(), place.y(), 0));
        const Picture picture = render(*scene, fromAbove(), 256, 256, 3);
        const auto* shown = static_cast<const osg::Vec3Array*>(rig->getVertexArray());
        const osg::Vec3 middle = ((*shown)[0] + (*shown)[2]) * 0.5f;
        EXPECT_NEAR(middle.x(), place.x(), 1e-5f);
        EXPECT_NEAR(middle.y(), place.y(), 1e-5f);
        expectShadowAt(picture, -2 + place.x(), place.y(), "motion.skinned");
    }
}

TEST_F(ShadowMotion, morphedMeshesCastWhatTheyShow)
{
    osg::ref_ptr<osgAnimation::MorphGeometry> morph =
        new osgAnimation::MorphGeometry(*squareGeometry(0, 0));
    morph->setVertexArray(square(0, 0));
    morph->setDataVariance(osg::Object::DYNAMIC);
    morph->addMorphTarget(squareGeometry(1, 1), 0.0f);
    morph->setMorphNormals(false);
    const auto scene = floorAndLight();
    scene->addChild(geodeOf(morph));
    for (const float weight : {0.0f, 1.0f, 0.5f})
    {
        morph->setWeight(0, weight);
        morph->transformSoftwareMethod();
        morph->dirtyBound();
        const auto* shown = static_cast<const osg::Vec3Array*>(morph->getVertexArray());
        const osg::Vec3 middle = ((*shown)[0] + (*shown)[2]) * 0.5f;
        EXPECT_NEAR(middle.x(), weight, 1e-5f);
        expectShadowAt(render(*scene, fromAbove()), middle.x() - 2, middle.y(), "motion.morphed");
    }
}

TEST_F(ShadowMotion, switchedOffChildrenAndOtherLevelsCastNothing)
{
    const auto scene = floorAndLight();
    osg::ref_ptr<osg::Switch> choice = new osg::Switch;
    choice->addChild(geodeOf(squareGeometry(0, 0)), true);
    choice->addChild(geodeOf(squareGeometry(0, 2)), false);
    scene->addChild(choice);
    expectShadowAt(render(*scene, fromAbove()), -2, 0, "motion.switch");
    choice->setSingleChildOn(1);
    expectShadowAt(render(*scene, fromAbove()), -2, 2, "motion.switched");
    choice->setAllChildrenOff();
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->setRangeMode(osg::LOD::DISTANCE_FROM_EYE_POINT);
    lod->setCenter(osg::Vec3());
    lod->setRadius(4.0f);
    lod->addChild(geodeOf(squareGeometry(0, -1)), 0.0f, 22.0f);
    lod->addChild(geodeOf(squareGeometry(1, -1)), 22.0f, 1000.0f);
    scene->addChild(lod);
    expectShadowAt(render(*scene, fromAbove()), -2, -1, "motion.near");
    support::CameraSpec farther = fromAbove();
    farther.view = osg::Matrixd::lookAt(osg::Vec3d(0, 0, 30), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    expectShadowAt(render(*scene, farther), -1, -1, "motion.far");
}
