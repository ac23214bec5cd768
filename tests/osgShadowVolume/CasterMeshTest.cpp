// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/CasterMesh.h>

#include <osg/Geometry>
#include <osg/ShapeDrawable>
#include <osgAnimation/Bone>
#include <osgAnimation/MorphGeometry>
#include <osgAnimation/RigGeometry>
#include <osgAnimation/Skeleton>
#include <osgParticle/ParticleSystem>
#include <osgText/Text>
#include <osgUtil/UpdateVisitor>

#include <gtest/gtest.h>

#include <limits>
#include <thread>

using namespace osgShadowVolume;

namespace
{

/// The corners of a 3 x 2 grid of squares, as a strip of three columns and more.
osg::ref_ptr<osg::Vec3Array> points(unsigned int count)
{
    osg::ref_ptr<osg::Vec3Array> array = new osg::Vec3Array;
    for (unsigned int i = 0; i < count; ++i)
        array->push_back(osg::Vec3(float(i / 2), float(i % 2), 0.1f * float(i * i)));
    return array;
}

osg::ref_ptr<osg::Geometry> geometryOf(osg::PrimitiveSet* primitives, osg::Array* vertices)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(primitives);
    return geometry;
}

osg::ref_ptr<CasterMesh> meshOf(const osg::Drawable* drawable)
{
    osg::ref_ptr<CasterMesh> mesh = new CasterMesh;
    mesh->build({drawable});
    return mesh;
}

std::size_t trianglesOf(const osg::Drawable* drawable)
{
    return meshOf(drawable)->getEdges().triangles.size();
}

template <class Elements> osg::ref_ptr<Elements> ascending(GLenum mode, unsigned int count)
{
    osg::ref_ptr<Elements> elements = new Elements(mode);
    for (unsigned int i = 0; i < count; ++i)
        elements->push_back(static_cast<typename Elements::value_type>(i));
    return elements;
}

/// A Drawable that is no Geometry but knows its triangles.
class Plate : public osg::Drawable
{
public:
    bool supports(const osg::PrimitiveFunctor&) const override { return true; }
    void accept(osg::PrimitiveFunctor& functor) const override
    {
        const osg::Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        functor.setVertexArray(4, corners);
        functor.drawArrays(GL_QUADS, 0, 4);
    }
    void drawImplementation(osg::RenderInfo&) const override {}
};

class Opaque : public osg::Drawable
{
public:
    void drawImplementation(osg::RenderInfo&) const override {}
};

} // namespace

TEST(CasterMeshTest, allPrimitiveTypesAreRead)
{
    struct Case
    {
        GLenum mode;
        std::size_t triangles;
    };
    for (const Case& c :
         {Case{GL_TRIANGLES, 4}, Case{GL_TRIANGLE_STRIP, 10}, Case{GL_TRIANGLE_FAN, 10},
          Case{GL_QUADS, 6}, Case{GL_QUAD_STRIP, 10}, Case{GL_POLYGON, 10}, Case{GL_POINTS, 0},
          Case{GL_LINES, 0}, Case{GL_LINE_STRIP, 0}, Case{GL_LINE_LOOP, 0}})
    {
        const auto read = [&](osg::PrimitiveSet* set)
        { return trianglesOf(geometryOf(set, points(12))); };
        EXPECT_EQ(read(new osg::DrawArrays(c.mode, 0, 12)), c.triangles) << c.mode;
        EXPECT_EQ(read(ascending<osg::DrawElementsUByte>(c.mode, 12)), c.triangles) << c.mode;
        EXPECT_EQ(read(ascending<osg::DrawElementsUShort>(c.mode, 12)), c.triangles) << c.mode;
        EXPECT_EQ(read(ascending<osg::DrawElementsUInt>(c.mode, 12)), c.triangles) << c.mode;
        osg::ref_ptr<osg::DrawArrayLengths> lengths = new osg::DrawArrayLengths(c.mode, 0);
        lengths->push_back(12);
        EXPECT_EQ(read(lengths), c.triangles) << c.mode;
        EXPECT_EQ(whyNoCaster(*geometryOf(new osg::DrawArrays(c.mode, 0, 12), points(12))),
                  c.triangles ? NoCaster::CASTS : NoCaster::POINTS_AND_LINES);
    }
}

TEST(CasterMeshTest, indicesMeanTheSameTriangles)
{
    const osg::ref_ptr<CasterMesh> arrays =
        meshOf(geometryOf(new osg::DrawArrays(GL_TRIANGLE_STRIP, 2, 7), points(12)));
    osg::ref_ptr<osg::DrawElementsUShort> elements = new osg::DrawElementsUShort(GL_TRIANGLE_STRIP);
    for (GLushort i = 2; i < 9; ++i)
        elements->push_back(i);
    const osg::ref_ptr<CasterMesh> indexed = meshOf(geometryOf(elements, points(12)));
    EXPECT_EQ(arrays->getEdges().vertices, indexed->getEdges().vertices);
    EXPECT_EQ(arrays->getEdges().triangles, indexed->getEdges().triangles);
}

TEST(CasterMeshTest, quadsOfStripsAreDividedFromTheFirstCornerToTheFourth)
{
    const auto diagonalOf = [](osg::PrimitiveSet* set)
    {
        const osg::ref_ptr<CasterMesh> mesh = meshOf(geometryOf(set, points(4)));
        const std::vector<std::uint32_t>& indices = mesh->getEdges().groups.at(0).indices;
        // The edge with two opposite vertices; the order of the corners is that of the vertices.
        for (std::size_t i = 0; i < indices.size(); i += 4)
            if (indices[i + 3] != indices[i])
                return std::make_pair(indices[i], indices[i + 1]);
        return std::make_pair(0u, 0u);
    };
    EXPECT_EQ(diagonalOf(new osg::DrawArrays(GL_QUAD_STRIP, 0, 4)), std::make_pair(0u, 3u));
    EXPECT_EQ(diagonalOf(ascending<osg::DrawElementsUByte>(GL_QUAD_STRIP, 4)),
              std::make_pair(0u, 3u));
    EXPECT_EQ(diagonalOf(ascending<osg::DrawElementsUInt>(GL_QUAD_STRIP, 4)),
              std::make_pair(0u, 3u));
}

TEST(CasterMeshTest, verticesOfAllTypesAreRead)
{
    const auto check = [](auto* array, auto x, auto y, auto... rest)
    {
        osg::ref_ptr<osg::Array> held = array;
        using Value = typename std::decay_t<decltype(*array)>::ElementDataType;
        array->push_back(Value(0, 0, rest...));
        array->push_back(Value(x, 0, rest...));
        array->push_back(Value(0, y, rest...));
        const osg::ref_ptr<CasterMesh> mesh =
            meshOf(geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 3), array));
        ASSERT_EQ(mesh->getEdges().triangles.size(), 1u) << array->className();
        EXPECT_EQ(mesh->getEdges().vertices[2].x, float(x)) << array->className();
    };
    check(new osg::Vec2Array, 1.5f, 2.0f);
    check(new osg::Vec3Array, 1.5f, 2.0f, 3.0f);
    check(new osg::Vec4Array, 1.5f, 2.0f, 3.0f, 1.0f);
    check(new osg::Vec2dArray, 1.5, 2.0);
    check(new osg::Vec3dArray, 1.5, 2.0, 3.0);
    check(new osg::Vec4dArray, 1.5, 2.0, 3.0, 1.0);
    check(new osg::Vec3sArray, short(7), short(2), short(3));
    check(new osg::Vec3bArray, GLbyte(7), GLbyte(2), GLbyte(3));
    check(new osg::Vec3iArray, 7, 2, 3);
}

TEST(CasterMeshTest, fourthCoordinatesDivide)
{
    osg::ref_ptr<osg::Vec4Array> vertices = new osg::Vec4Array;
    vertices->push_back({0, 0, 0, 2});
    vertices->push_back({4, 0, 0, 2});
    vertices->push_back({0, 4, 2, 2});
    const osg::ref_ptr<CasterMesh> mesh =
        meshOf(geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 3), vertices));
    EXPECT_EQ(mesh->getBoundingBox()._max, osg::Vec3(2, 2, 1));
}

TEST(CasterMeshTest, genericAttribute0IsThePosition)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexAttribArray(0, points(6), osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 6));
    EXPECT_EQ(trianglesOf(geometry), 2u);
}

TEST(CasterMeshTest, indicesBeyondTheVerticesAreLeftOut)
{
    osg::ref_ptr<osg::DrawElementsUInt> elements = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (const unsigned int i : {0u, 1u, 2u, 1u, 2u, 4000000000u, 1u, 2u, 6u})
        elements->push_back(i);
    const osg::ref_ptr<CasterMesh> mesh = meshOf(geometryOf(elements, points(6)));
    EXPECT_EQ(mesh->getEdges().triangles.size(), 1u);
    EXPECT_EQ(mesh->getBadIndices(), 2u);
    const osg::ref_ptr<CasterMesh> beyond =
        meshOf(geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 9), points(6)));
    EXPECT_EQ(beyond->getBadIndices(), 1u);
}

TEST(CasterMeshTest, nothingIsAnEmptyMesh)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    EXPECT_EQ(trianglesOf(geometry), 0u);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 9));
    const osg::ref_ptr<CasterMesh> mesh = meshOf(geometry);
    EXPECT_TRUE(mesh->getPatches().empty());
    EXPECT_FALSE(mesh->getBoundingBox().valid());
}

TEST(CasterMeshTest, shapesAndDrawablesThatKnowTheirTrianglesCast)
{
    EXPECT_EQ(trianglesOf(osg::ref_ptr<osg::ShapeDrawable>(
                  new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 2.0f)))),
              12u);
    EXPECT_EQ(trianglesOf(osg::ref_ptr<Plate>(new Plate)), 2u);
}

TEST(CasterMeshTest, aBoxHas18EdgesOfTwoTriangles)
{
    osg::ref_ptr<osg::ShapeDrawable> box = new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 2.0f));
    const osg::ref_ptr<CasterMesh> mesh = meshOf(box);
    EXPECT_EQ(mesh->getEdges().vertices.size(), 8u);
    ASSERT_EQ(mesh->getPatches().size(), 1u);
    EXPECT_EQ(mesh->getPatches()[0]->getPrimitiveSet(0)->getNumIndices(), 18u * 4u);
    EXPECT_EQ(mesh->getLines()->getPrimitiveSet(0)->getNumIndices(), 18u * 4u);
    EXPECT_EQ(mesh->getTriangles()->getPrimitiveSet(0)->getNumIndices(), 12u * 3u);
    EXPECT_EQ(mesh->getExtrudable()->size(), 16u);
    EXPECT_EQ((*mesh->getExtrudable())[8].w(), 0.0f);
    EXPECT_EQ(mesh->getTriangles()->getVertexArray(), mesh->getLines()->getVertexArray());
    EXPECT_EQ(mesh->getTriangles()->getVertexArray()->getVertexBufferObject(),
              mesh->getPatches()[0]->getVertexArray()->getVertexBufferObject());
}

TEST(CasterMeshTest, textAndParticlesAndUnknownDrawablesCastNothing)
{
    osg::ref_ptr<osgText::Text> text = new osgText::Text;
    text->setText("shadow");
    EXPECT_EQ(whyNoCaster(*text), NoCaster::TEXT);
    EXPECT_EQ(trianglesOf(text), 0u);
    osg::ref_ptr<osgParticle::ParticleSystem> particles = new osgParticle::ParticleSystem;
    EXPECT_EQ(whyNoCaster(*particles), NoCaster::NO_TRIANGLES);
    EXPECT_EQ(whyNoCaster(*osg::ref_ptr<Opaque>(new Opaque)), NoCaster::NO_TRIANGLES);
}

TEST(CasterMeshTest, geometriesOfOneCasterAreWelded)
{
    const osg::ref_ptr<osg::Geometry> left =
        geometryOf(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4), points(8));
    const osg::ref_ptr<osg::Geometry> right =
        geometryOf(new osg::DrawArrays(GL_TRIANGLE_STRIP, 2, 4), points(8));
    osg::ref_ptr<CasterMesh> mesh = new CasterMesh;
    mesh->build({left, right});
    EXPECT_EQ(mesh->getEdges().vertices.size(), 6u);
    EXPECT_EQ(mesh->getEdges().groups[0].indices.size(), 9u * 4u);
}

TEST(CasterMeshTest, linesOfManyOppositesComeInPairs)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (int i = 0; i < 5; ++i)
    {
        vertices->push_back({0, 0, 0});
        vertices->push_back({0, 0, 1});
        vertices->push_back({1, float(i), 0});
    }
    const osg::ref_ptr<CasterMesh> mesh =
        meshOf(geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 15), vertices));
    // Ten outer edges, and three pairs for the one with five opposite vertices.
    EXPECT_EQ(mesh->getLines()->getPrimitiveSet(0)->getNumIndices(), 13u * 4u);
}

TEST(CasterCacheTest, aMeshIsMadeOnceAndShared)
{
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    const osg::ref_ptr<osg::Geometry> geometry =
        geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 6), points(6));
    const osg::ref_ptr<CasterMesh> mesh = cache->get({geometry});
    EXPECT_EQ(cache->get({geometry}), mesh);
    EXPECT_EQ(cache->getBuilt(), 1u);
}

TEST(CasterCacheTest, changedVerticesAndIndicesMakeANewOne)
{
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    const osg::ref_ptr<osg::Vec3Array> vertices = points(6);
    const osg::ref_ptr<osg::DrawElementsUInt> elements =
        ascending<osg::DrawElementsUInt>(GL_TRIANGLES, 6);
    const osg::ref_ptr<osg::Geometry> geometry = geometryOf(elements, vertices);
    cache->get({geometry});
    vertices->front().z() = 9.0f;
    vertices->dirty();
    EXPECT_EQ(cache->get({geometry})->getBoundingBox().zMax(), 9.0f);
    elements->resize(3);
    elements->dirty();
    EXPECT_EQ(cache->get({geometry})->getEdges().triangles.size(), 1u);
    geometry->setVertexArray(points(6));
    EXPECT_LT(cache->get({geometry})->getBoundingBox().zMax(), 9.0f);
    geometry->setPrimitiveSet(0, new osg::DrawArrays(GL_TRIANGLES, 0, 6));
    EXPECT_EQ(cache->get({geometry})->getEdges().triangles.size(), 2u);
    EXPECT_EQ(cache->getBuilt(), 5u);
    EXPECT_EQ(cache->getSize(), 1u);
}

TEST(CasterCacheTest, unusedMeshesAndThoseOfDeadGeometriesAreForgotten)
{
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    osg::ref_ptr<osg::Geometry> used =
        geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 6), points(6));
    osg::ref_ptr<osg::Geometry> unused = osg::clone(used.get(), osg::CopyOp::DEEP_COPY_ALL);
    osg::ref_ptr<osg::Geometry> dying = osg::clone(used.get(), osg::CopyOp::DEEP_COPY_ALL);
    cache->get({unused});
    cache->get({dying});
    cache->get({used});
    EXPECT_EQ(cache->getSize(), 3u);
    dying = nullptr;
    unsigned int frame = 1;
    cache->evict(frame++);
    EXPECT_EQ(cache->getSize(), 2u);
    for (; frame <= CasterCache::FramesUnused; ++frame)
    {
        cache->get({used});
        cache->evict(frame);
        cache->evict(frame); // A second view of the same frame.
    }
    EXPECT_EQ(cache->getSize(), 2u);
    cache->evict(frame);
    EXPECT_EQ(cache->getSize(), 1u);
    cache->get({used});
    EXPECT_EQ(cache->getBuilt(), 3u);
}

TEST(CasterCacheTest, aGeometryAtTheAddressOfADeadOneIsANewOne)
{
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    for (unsigned int count = 3; count < 60; count += 3)
    {
        const osg::ref_ptr<osg::Geometry> geometry =
            geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, int(count)), points(count));
        ASSERT_EQ(cache->get({geometry})->getEdges().triangles.size(), count / 3);
    }
}

TEST(CasterCacheTest, threadsGetTheSameBuiltMesh)
{
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    const osg::ref_ptr<osg::Geometry> geometry =
        geometryOf(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 50000), points(50000));
    std::vector<std::thread> threads;
    std::vector<std::size_t> triangles(4);
    std::vector<osg::ref_ptr<CasterMesh>> meshes(4);
    for (std::size_t i = 0; i < 4; ++i)
        threads.emplace_back(
            [&, i]
            {
                meshes[i] = cache->get({geometry});
                triangles[i] = meshes[i]->getEdges().triangles.size();
                meshes[i]->getTriangles();
            });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(triangles, std::vector<std::size_t>(4, 49998u));
    EXPECT_EQ(cache->getBuilt(), 1u);
}

TEST(CasterCacheTest, morphedVerticesAreFollowed)
{
    osg::ref_ptr<osgAnimation::MorphGeometry> morph = new osgAnimation::MorphGeometry;
    morph->setVertexArray(points(6));
    morph->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 6));
    osg::ref_ptr<osg::Geometry> target = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> moved = points(6);
    for (osg::Vec3& v : *moved)
        v.z() += 100.0f;
    target->setVertexArray(moved);
    morph->addMorphTarget(target, 0.0f);
    morph->setMorphNormals(false);
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    morph->transformSoftwareMethod();
    const float rest = cache->get({morph})->getBoundingBox().zMax();
    morph->setWeight(0, 1.0f);
    morph->transformSoftwareMethod();
    EXPECT_GT(cache->get({morph})->getBoundingBox().zMax(), rest + 50.0f);
}

TEST(CasterCacheTest, skinnedVerticesAreFollowed)
{
    osg::ref_ptr<osgAnimation::Skeleton> skeleton = new osgAnimation::Skeleton;
    osg::ref_ptr<osgAnimation::Bone> bone = new osgAnimation::Bone("bone");
    skeleton->addChild(bone);
    osg::ref_ptr<osgAnimation::RigGeometry> rig = new osgAnimation::RigGeometry;
    rig->setSourceGeometry(geometryOf(new osg::DrawArrays(GL_TRIANGLES, 0, 6), points(6)));
    osg::ref_ptr<osgAnimation::VertexInfluenceMap> influences =
        new osgAnimation::VertexInfluenceMap;
    osgAnimation::VertexInfluence& influence = (*influences)["bone"];
    influence.setName("bone");
    for (unsigned int i = 0; i < 6; ++i)
        influence.push_back(osgAnimation::VertexIndexWeight(i, 1.0f));
    rig->setInfluenceMap(influences);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(rig);
    skeleton->addChild(geode);
    osgUtil::UpdateVisitor update;
    osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
    update.setFrameStamp(stamp);
    skeleton->accept(update);
    osg::ref_ptr<CasterCache> cache = new CasterCache;
    const float rest = cache->get({rig})->getBoundingBox().zMax();
    bone->setMatrixInSkeletonSpace(osg::Matrix::translate(0, 0, 100));
    stamp->setFrameNumber(1);
    skeleton->accept(update);
    EXPECT_NEAR(cache->get({rig})->getBoundingBox().zMax(), rest + 100.0f, 1e-3f);
}
