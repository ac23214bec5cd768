// SPDX-License-Identifier: MIT
// What is kept from frame to frame, where viewers count frames of their own and scenes change.
#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/Mirrors.h>
#include <osgShadowVolume/SilhouetteCache.h>

#include <osg/Geometry>

#include <gtest/gtest.h>

using namespace osgShadowVolume;

namespace
{

/// Frame numbers of two viewers, one of which has run for long.
constexpr unsigned int Old = 10000, Young = 3;

osg::ref_ptr<osg::Geometry> square()
{
    return osg::createTexturedQuadGeometry({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
}

NamedMirror mirrorOf(const osg::ref_ptr<osg::Geometry>& geometry)
{
    return {geometry, osg::Matrixd(), 1.0, "pane"};
}

MeshLight lightOver(const CasterMesh& mesh)
{
    return toMeshLight(mesh.getEdges(), {0.5, 0.5, 3.0, 1.0});
}

} // namespace

TEST(SilhouetteCacheTest, viewersLeaveEachOthersVolumesAlone)
{
    const osg::ref_ptr<CasterMesh> mesh = new CasterMesh;
    mesh->build({square()});
    SilhouetteCache cache;
    const auto old = cache.get(mesh, lightOver(*mesh), 0, Old);
    const auto young = cache.get(mesh, lightOver(*mesh), 1, Young);
    for (unsigned int frame = 1; frame < 5; ++frame)
    {
        EXPECT_EQ(cache.get(mesh, lightOver(*mesh), 0, Old + frame), old);
        EXPECT_EQ(cache.get(mesh, lightOver(*mesh), 1, Young + frame), young);
    }
}

TEST(SilhouetteCacheTest, whatAViewerHasNotUsedForSomeFramesIsForgotten)
{
    const osg::ref_ptr<CasterMesh> mesh = new CasterMesh, other = new CasterMesh;
    mesh->build({square()});
    other->build({square()});
    for (const unsigned int later : {Old + 10, Young}) // the viewer has started anew
    {
        SilhouetteCache cache;
        const auto first = cache.get(mesh, lightOver(*mesh), 0, Old);
        cache.get(other, lightOver(*other), 0, later);
        EXPECT_NE(cache.get(mesh, lightOver(*mesh), 0, later), first);
    }
}

TEST(MirrorPoolTest, viewersLeaveEachOthersCamerasAlone)
{
    MirrorPool pool;
    const MirrorLayout layout{64, 48, 0};
    const osg::ref_ptr<MirrorCamera> old = pool.acquire(0, layout), young = pool.acquire(1, layout);
    pool.release(0, old, Old);
    pool.release(1, young, Young);
    pool.evict(0, Old + 1);
    pool.evict(1, Young + 1);
    EXPECT_EQ(pool.acquire(1, layout), young);
    EXPECT_EQ(pool.acquire(0, layout), old);
    pool.release(0, old, Old + 1);
    pool.evict(0, Old + 10);
    EXPECT_NE(pool.acquire(0, layout), old);
}

TEST(MirrorShapesTest, exchangedAndDirtyArraysMakeANewShape)
{
    MirrorShapes shapes;
    const osg::ref_ptr<osg::Geometry> geometry = square();
    const auto widthOf = [&]() -> double
    {
        std::string error;
        const auto shape = shapes.get(mirrorOf(geometry), error);
        return shape ? glm::distance(shape->corners[0], shape->corners[2]) : -1.0;
    };
    EXPECT_NEAR(widthOf(), std::sqrt(2.0), 1e-6);
    osg::ref_ptr<osg::Vec3Array> larger = new osg::Vec3Array;
    for (const osg::Vec3& p : {osg::Vec3(0, 3, 0), {0, 0, 0}, {3, 0, 0}, {3, 3, 0}})
        larger->push_back(p);
    geometry->setVertexArray(larger);
    EXPECT_NEAR(widthOf(), 3.0 * std::sqrt(2.0), 1e-6);
    (*larger)[2].x() = (*larger)[3].x() = 4.0f;
    larger->dirty();
    EXPECT_NEAR(widthOf(), 5.0, 1e-6);
    geometry->removePrimitiveSet(0);
    EXPECT_EQ(widthOf(), -1.0);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
    EXPECT_NEAR(widthOf(), 5.0, 1e-6);
    EXPECT_EQ(shapes.getSize(), 1u);
}

TEST(MirrorShapesTest, shapesOfDeadDrawablesAndThoseUnusedAreForgotten)
{
    MirrorShapes shapes;
    std::string error;
    const osg::ref_ptr<osg::Geometry> used = square(), unused = square();
    osg::ref_ptr<osg::Geometry> dying = square();
    for (const auto& geometry : {used, unused, dying})
        shapes.get(mirrorOf(geometry), error);
    dying = nullptr;
    unsigned int frame = 1;
    shapes.evict(frame++);
    EXPECT_EQ(shapes.getSize(), 2u);
    for (; frame <= 60; ++frame)
    {
        shapes.get(mirrorOf(used), error);
        shapes.evict(frame);
        shapes.evict(frame); // a second view of the same frame
    }
    EXPECT_EQ(shapes.getSize(), 2u);
    shapes.evict(frame);
    EXPECT_EQ(shapes.getSize(), 1u);
}
