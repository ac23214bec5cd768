// SPDX-License-Identifier: MIT
#include "PrimitiveScenes.h"

#include <osgLabels/UnitMesh.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#ifdef OSGKITS_SHADOWVOLUME
#include <osgShadowVolume/ShadowedScene.h>
#endif

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/ValueObject>
#include <osgDB/ReadFile>

#include <gtest/gtest.h>

using namespace osgLabels;

namespace
{

/// An ordinary Geometry of the same triangles in the same place as object `i` of the batch.
osg::ref_ptr<osg::Geometry> geometryOf(const PrimitiveBatch& batch, unsigned int i, int level)
{
    const ObjectRecord record = batch.getRecord(i);
    const UnitMesh mesh =
        makeUnitMesh(kindOf(record), LevelSides[std::min(level, levelsOf(shapeOf(record)) - 1)]);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    for (const SurfacePoint& unit : mesh.points)
    {
        const SurfacePoint point = placePoint(record, unit);
        vertices->push_back({point.position.x, point.position.y, point.position.z});
        normals->push_back({point.normal.x, point.normal.y, point.normal.z});
    }
    const osg::Vec4ub color = batch.getPrimitive(i).color;
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(1);
    (*colors)[0].set(color.r() / 255.0f, color.g() / 255.0f, color.b() / 255.0f, 1.0f);
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawElementsUShort(
        GL_TRIANGLES, unsigned(mesh.triangles.size()), mesh.triangles.data()));
    return geometry;
}

/// All of a batch of one cell as Geometries, below the cell's own transform.
osg::ref_ptr<osg::Group> geometriesOf(const PrimitiveBatch& batch, int level)
{
    EXPECT_EQ(batch.getNumCells(), 1u);
    const PrimitiveBatch::Content content = batch.getContent();
    osg::ref_ptr<osg::MatrixTransform> root =
        new osg::MatrixTransform(osg::Matrix::translate(content.cells[0].center));
    for (unsigned int i = 0; i < batch.getNumObjects(); ++i)
        root->addChild(geometryOf(batch, i, level));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    root->getOrCreateStateSet()->setAttribute(material);
    return root;
}

constexpr int Width = 640, Height = 200;

support::CameraSpec cameraAt(const osg::Vec3d& at, double distance = 22.0)
{
    return support::CameraSpec::perspective(at + osg::Vec3d(13.5, -distance, 0.4 * distance),
                                            at + osg::Vec3d(13.5, 0.0, 0.0), {0.0, 0.0, 1.0}, 25.0,
                                            double(Width) / Height, 1.0, 1000.0);
}

/// Both make the same vertices, by CPU and by GPU: an edge that passes through the middle of a
/// pixel may take it or not. All others agree to one step.
const support::CompareImage SamePicture{1.0 / 255.0, 0.0008, 1.0};

class PrimitiveBatchGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    osg::ref_ptr<osg::Image> picture(osg::Node* node, const support::CameraSpec& camera)
    {
        return _viewer.render(node, camera, Width, Height);
    }

    static support::HeadlessSettings settings()
    {
        support::HeadlessSettings settings;
        settings.width = Width;
        settings.height = Height;
        return settings;
    }

    support::NotifyCapture _capture;
    support::HeadlessViewer _viewer{settings()};
};

} // namespace

TEST_F(PrimitiveBatchGLTest, looksAsGeometriesOfTheSameTrianglesInEachLevel)
{
    const auto batch = batchOf(rowOfShapes());
    for (int level = 0; level < NumLevels; ++level)
    {
        batch->setLevel(level);
        const auto actual = picture(batch, cameraAt({}));
        const auto expected = picture(geometriesOf(*batch, level), cameraAt({}));
        EXPECT_TRUE(SamePicture(actual, expected, "primitivesLevel" + std::to_string(level)));
        if (level == 0)
            support::writeImage(*actual, "primitives");
    }
}

TEST_F(PrimitiveBatchGLTest, looksTheSameFarFromTheOrigin)
{
    const osg::Vec3d far(1e7, -2e7, 3e6);
    const auto actual = picture(batchOf(rowOfShapes(far)), cameraAt(far));
    const auto expected = picture(batchOf(rowOfShapes()), cameraAt({}));
    EXPECT_TRUE(SamePicture(actual, expected, "primitivesFar"));
}

TEST_F(PrimitiveBatchGLTest, chosenLevelsLookLikeTheFinestOne)
{
    const auto batch = batchOf(rowOfShapes());
    for (double distance : {22.0, 60.0, 150.0})
    {
        batch->setLevel(-1);
        const auto actual = picture(batch, cameraAt({}, distance));
        batch->setLevel(0);
        const auto expected = picture(batch, cameraAt({}, distance));
        // Silhouettes move by up to half a pixel, and shading with them; surfaces stay.
        support::CompareImage similar{24.0 / 255.0, 0.02, 1.0};
        EXPECT_TRUE(similar(actual, expected, "primitivesChosen" + std::to_string(int(distance))));
    }
}

TEST_F(PrimitiveBatchGLTest, changedColorsShowInTheNextFrame)
{
    const auto batch = batchOf(rowOfShapes());
    const auto before = picture(batch, cameraAt({}));
    for (unsigned int i = 0; i < batch->getNumObjects(); ++i)
        batch->setColor(i, {255, 0, 0, 255});
    const auto red = picture(batch, cameraAt({}));
    batch->setLevel(0);
    const auto expected = picture(geometriesOf(*batch, 0), cameraAt({}));
    EXPECT_TRUE(SamePicture(picture(batch, cameraAt({})), expected, "primitivesRed"));
    EXPECT_FALSE(SamePicture(red, before, "primitivesNotRed"));
}

TEST_F(PrimitiveBatchGLTest, transparentObjectsBlend)
{
    auto row = rowOfShapes();
    const auto opaque = picture(batchOf(row), cameraAt({}));
    for (Primitive& primitive : row)
        primitive.color.a() = 0;
    const auto nothing = picture(batchOf(row), cameraAt({}));
    const auto empty = picture(batchOf({}), cameraAt({}));
    EXPECT_TRUE(SamePicture(nothing, empty, "primitivesInvisible"));
    EXPECT_FALSE(SamePicture(opaque, empty, "primitivesOpaque"));
}

TEST_F(PrimitiveBatchGLTest, whatFilesHoldLooksTheSame)
{
    const auto batch = batchOf(rowOfShapes());
    const osg::ref_ptr<PrimitiveBatch> copy = new PrimitiveBatch;
    ASSERT_EQ(copy->setContent(batch->getContent()), "");
    const auto actual = picture(copy, cameraAt({}));
    EXPECT_TRUE(SamePicture(actual, picture(batch, cameraAt({})), "primitivesCopied"));
}

TEST_F(PrimitiveBatchGLTest, releasedObjectsAreMadeAgain)
{
    const auto batch = batchOf(rowOfShapes());
    const auto before = picture(batch, cameraAt({}));
    for (int i = 0; i < 3; ++i)
    {
        batch->releaseGLObjects();
        EXPECT_TRUE(SamePicture(picture(batch, cameraAt({})), before, "primitivesReleased"));
    }
}

TEST_F(PrimitiveBatchGLTest, looksTheSameWithVertexArrayObjects)
{
    const auto batch = batchOf(rowOfShapes());
    const auto before = picture(batch, cameraAt({}));
    for (const auto& run : batch->getRuns())
        run->setUseVertexArrayObject(true);
    const osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(batch);
    EXPECT_TRUE(SamePicture(_viewer.render(both, cameraAt({}), Width, Height, 3), before,
                            "primitivesVertexArrays"));
}

TEST_F(PrimitiveBatchGLTest, manyPagesAndCellsAreDrawn)
{
    // More than RecordPage::MaxObjects: two pages; a wall of quads without a gap.
    osg::ref_ptr<PrimitiveBatch> wall = new PrimitiveBatch;
    for (int i = 0; i < 240 * 120; ++i)
    {
        Primitive quad;
        quad.shape = Shape::Quad;
        quad.size.set(0.51f, 0.51f, 0.0f);
        quad.position.set(i % 240 - 119.5, 0.0, i / 240 - 59.5);
        quad.rotation.makeRotate(0.5 * osg::PI, osg::Vec3d(1.0, 0.0, 0.0));
        wall->add(quad);
    }
    wall->build();
    EXPECT_EQ(wall->getContent().pages.size(), 2u);
    const auto image =
        picture(wall, support::CameraSpec::perspective({0.0, -100.0, 0.0}, {}, {0.0, 0.0, 1.0},
                                                       50.0, double(Width) / Height, 1.0, 1000.0));
    for (int y = 0; y < Height; ++y)
    {
        for (int x = Width / 6; x < 5 * Width / 6; ++x)
        {
            ASSERT_GT(int(image->data(x, y)[0]), 150) << x << " " << y;
        }
    }
}

#ifdef OSGKITS_SHADOWVOLUME
TEST_F(PrimitiveBatchGLTest, surfaceFunctionsLightItAsTheFixedFunctionDoes)
{
    const auto batch = batchOf(rowOfShapes());
    batch->setLevel(0);
    const auto expected = picture(geometriesOf(*batch, 0), cameraAt({}));
    const osg::ref_ptr<osgShadowVolume::LitScene> scene = new osgShadowVolume::LitScene;
    scene->setLighting(osgShadowVolume::LitScene::Lighting::VERTEX);
    scene->addChild(batch);
    const auto actual = picture(scene, cameraAt({}));
    EXPECT_TRUE(SamePicture(actual, expected, "primitivesLit"));
}

TEST_F(PrimitiveBatchGLTest, castsAndTakesShadowsAsGeometriesDo)
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(1);
    source->getLight()->setDiffuse({0.9f, 0.9f, 0.9f, 1.0f});
    source->getLight()->setPosition({-1.0f, -0.6f, 0.7f, 0.0f});
    const auto lit = [&](osg::Node* node)
    {
        osg::ref_ptr<osgShadowVolume::ShadowedScene> scene = new osgShadowVolume::ShadowedScene;
        scene->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        scene->addChild(source);
        scene->addChild(node);
        return picture(scene, cameraAt({}));
    };
    const auto batch = batchOf(rowOfShapes());
    // What casts is the level that visitors see.
    batch->setLevel(VisitorLevel);
    EXPECT_TRUE(
        SamePicture(lit(batch), lit(geometriesOf(*batch, VisitorLevel)), "primitivesShadowed"));
}

TEST_F(PrimitiveBatchGLTest, transparentObjectsBehindEachOtherHaveShadowsOfTheirOwn)
{
    // Three panes that add, in any order the same, over a black floor; a box beside them throws its
    // shadow slantwise through all.
    const auto lit = [&](osg::Node* panes)
    {
        osg::ref_ptr<osgShadowVolume::ShadowedScene> scene = new osgShadowVolume::ShadowedScene;
        panes->setUserValue("castShadow", false);
        osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
        sun->getLight()->setLightNum(1);
        sun->getLight()->setDiffuse({0.9f, 0.9f, 0.9f, 1.0f});
        sun->getLight()->setPosition({-0.9f, 0.2f, 1.0f, 0.0f});
        scene->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        scene->addChild(sun);
        osg::ref_ptr<osg::Group> black = new osg::Group;
        osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setAmbient(osg::Material::FRONT_AND_BACK, {0, 0, 0, 1});
        material->setDiffuse(osg::Material::FRONT_AND_BACK, {0, 0, 0, 1});
        black->getOrCreateStateSet()->setAttribute(material);
        black->addChild(new osg::ShapeDrawable(new osg::Box({13.5f, 0, -3.0f}, 40, 40, 0.1f)));
        black->addChild(new osg::ShapeDrawable(new osg::Box({11.0f, 0, 2.4f}, 1.5f)));
        scene->addChild(black);
        constexpr auto over = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
        osg::StateSet& state = *panes->getOrCreateStateSet();
        state.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE), over);
        state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false), over);
        state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        scene->addChild(panes);
        return picture(scene, cameraAt({}));
    };
    std::vector<Primitive> panes;
    for (int i = 0; i < 3; ++i)
    {
        Primitive pane;
        pane.shape = Shape::Quad;
        pane.size.set(8.0f, 5.0f, 0.0f);
        pane.position.set(13.5, 0.0, 0.9 * i - 1.2);
        pane.color = {static_cast<unsigned char>(i == 0 ? 230 : 0),
                      static_cast<unsigned char>(i == 1 ? 230 : 0),
                      static_cast<unsigned char>(i == 2 ? 230 : 0), 128};
        panes.push_back(pane);
    }
    const auto batch = batchOf(panes);
    batch->setLevel(VisitorLevel);
    const auto geometries = geometriesOf(*batch, VisitorLevel);
    const auto actual = lit(batch), expected = lit(geometries);
    support::writeImage(*actual, "primitivesLayers");
    EXPECT_TRUE(SamePicture(actual, expected, "primitivesPeeled"));
    // Each has a shadow that the others have not: all but one channel is lit there.
    int shares[3] = {};
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
            for (int c = 0; c < 3; ++c)
                shares[c] += expected->data(x, y)[c] < 160 &&
                             expected->data(x, y)[(c + 1) % 3] > 200 &&
                             expected->data(x, y)[(c + 2) % 3] > 200;
    for (const int share : shares)
        EXPECT_GT(share, 100);
}
#endif
