// SPDX-License-Identifier: MIT
#include "LitPictures.h"

#include <support/InventorModels.h>
#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>

#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Texture2D>
#include <osgDB/ReadFile>

#include <cmath>
#include <fstream>
#include <limits>

using lit::ball;
using lit::expectSameAsStock;
using lit::Lighting;

namespace
{

const float NotANumber = std::numeric_limits<float>::quiet_NaN();

using Edit = std::function<void(osg::Geometry&)>;

/// A square of 16x16 quads that faces the camera, with unit normals; `edit` changes it.
osg::ref_ptr<osg::Geode> square(const Edit& edit = [](osg::Geometry&) {})
{
    constexpr unsigned int N = 16;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> coords = new osg::Vec2Array;
    osg::ref_ptr<osg::DrawElementsUShort> quads = new osg::DrawElementsUShort(GL_QUADS);
    for (unsigned int y = 0; y <= N; ++y)
        for (unsigned int x = 0; x <= N; ++x)
        {
            coords->push_back(osg::Vec2(x / float(N), y / float(N)));
            vertices->push_back(
                osg::Vec3(2 * coords->back().x() - 1, 0, 2 * coords->back().y() - 1));
            normals->push_back(osg::Vec3(0, -1, 0));
        }
    for (unsigned int y = 0; y < N; ++y)
        for (unsigned int x = 0; x < N; ++x)
            for (unsigned int corner : {0u, 1u, N + 2, N + 1})
                quads->push_back(static_cast<GLushort>(y * (N + 1) + x + corner));
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->setTexCoordArray(0, coords);
    geometry->addPrimitiveSet(quads);
    edit(*geometry);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

osg::Vec3Array& normalsOf(osg::Geometry& geometry)
{
    return static_cast<osg::Vec3Array&>(*geometry.getNormalArray());
}

osg::Vec3Array& verticesOf(osg::Geometry& geometry)
{
    return static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
}

/// Draws per pixel into floats; no channel is NaN or infinite.
void expectFinitePixels(const lit::Build& build, const support::CameraSpec& camera = lit::camera())
{
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    const osg::ref_ptr<osg::Node> scene = build(*kit);
    // OSG sets a camera's float target up once: pictures of both kinds need a viewer each.
    support::HeadlessViewer viewer({lit::Width, lit::Height});
    ASSERT_TRUE(viewer.isValid()) << viewer.getError();
    viewer.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    const osg::ref_ptr<osg::Image> image =
        viewer.renderFloat(scene, camera, lit::Width, lit::Height);
    ASSERT_TRUE(image.valid());
    const float* values = reinterpret_cast<const float*>(image->data());
    unsigned int bad = 0;
    for (int i = 0; i < lit::Width * lit::Height; ++i)
    {
        const float* c = values + 4 * i;
        if (std::isfinite(c[0] + c[1] + c[2] + c[3]))
            continue;
        if (!bad++)
            ADD_FAILURE() << "pixel " << i % lit::Width << "," << i / lit::Width << " is " << c[0]
                          << " " << c[1] << " " << c[2] << " " << c[3];
    }
    EXPECT_EQ(bad, 0u) << "pixels are not finite";
}

/// The same as stock under lighting=vertex, and finite per pixel.
void expectSound(const lit::Build& build, const std::string& name)
{
    expectSameAsStock(build, "extreme." + name);
    expectFinitePixels(build);
}

lit::Build child(const std::function<osg::ref_ptr<osg::Node>()>& make)
{
    return [make](osg::Group& kit)
    {
        kit.addChild(make());
        return osg::ref_ptr<osg::Node>(&kit);
    };
}

/// The square under one light that `edit` changes.
lit::Build underLight(const std::function<void(osg::Light&)>& edit)
{
    return [edit](osg::Group& kit)
    {
        osg::ref_ptr<osg::Node> source = lit::lightSource(
            1, osg::Vec4(0, -2, 0, 1), osg::Vec4(0.7f, 0.6f, 0.2f, 1), *kit.getOrCreateStateSet());
        edit(*static_cast<osg::LightSource*>(source.get())->getLight());
        kit.addChild(source);
        kit.addChild(square());
        kit.getStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
        return osg::ref_ptr<osg::Node>(&kit);
    };
}

class Extreme : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(lit::viewer()); }
    support::NotifyCapture _notify;
};

} // namespace

TEST_F(Extreme, emptyModelsDrawTheBackground)
{
    for (Lighting lighting : {Lighting::PIXEL, Lighting::VERTEX, Lighting::OFF})
    {
        osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(lighting);
        osg::ref_ptr<osg::Group> plain = new osg::Group;
        const osg::ref_ptr<osg::Image> background = lit::picture(*plain);
        EXPECT_TRUE(
            (support::CompareImage{0, 0, 0}(lit::picture(*kit), background, "extreme.empty")));
        kit->addChild(new osg::Geode);
        kit->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        osg::ref_ptr<osg::Geode> bare = new osg::Geode;
        bare->addDrawable(new osg::Geometry);
        kit->addChild(bare);
        EXPECT_TRUE(
            (support::CompareImage{0, 0, 0}(lit::picture(*kit), background, "extreme.empty")));
    }
}

TEST_F(Extreme, missingAndTruncatedFilesAreErrorsOfTheirReader)
{
    support::TemporaryFolder folder;
    EXPECT_FALSE(osgDB::readRefNodeFile(folder.file("missing.iv.shadowvolume")).valid());
    const support::NotifyCapture::Lines missing = _notify.takeWarnings();
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_NE(missing[0].find("missing.iv.shadowvolume: file not found"), std::string::npos)
        << missing[0];

    std::ifstream king(support::inventorModel("chess/king.iv"));
    const std::string whole((std::istreambuf_iterator<char>(king)),
                            std::istreambuf_iterator<char>());
    ASSERT_GT(whole.size(), 200u);
    for (const std::size_t size :
         {std::size_t(0), std::size_t(9), whole.size() / 2, whole.size() - 3})
    {
        const std::string file = folder.write("cut.iv", whole.substr(0, size));
        const bool stock = osgDB::readRefNodeFile(file).valid();
        // Coin reads some cut files as far as they go: then the kit lights what there is.
        osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file + ".shadowvolume");
        EXPECT_EQ(node.valid(), stock) << size << " bytes";
        if (node)
        {
            EXPECT_TRUE(lit::picture(*node).valid());
        }
        _notify.takeWarnings();
    }
}

TEST_F(Extreme, modelsWithoutNormalsAreLitAsStockDoes)
{
    expectSound(child([] { return square([](osg::Geometry& g) { g.setNormalArray(nullptr); }); }),
                "noNormals");
}

TEST_F(Extreme, zeroNormalsGetAmbientLight)
{
    const auto build = child(
        []
        {
            return square(
                [](osg::Geometry& g)
                {
                    for (std::size_t i = 0; i < normalsOf(g).size(); i += 2)
                        normalsOf(g)[i] = osg::Vec3(0, 0, 0);
                });
        });
    expectSound(build, "zeroNormals");
    expectFinitePixels(
        [&](osg::Group& kit)
        {
            kit.getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
            return build(kit);
        });
}

TEST_F(Extreme, verticesThatAreNotNumbersSpoilOnlyTheirTriangles)
{
    const auto build = child(
        []
        {
            return square(
                [](osg::Geometry& g)
                {
                    verticesOf(g)[20] = osg::Vec3(NotANumber, NotANumber, NotANumber);
                    normalsOf(g)[90] = osg::Vec3(NotANumber, 0, 0);
                });
        });
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    const osg::ref_ptr<osg::Image> image = lit::picture(*build(*kit));
    ASSERT_TRUE(image.valid());
    lit::planOf(*kit);
    osg::ref_ptr<osgShadowVolume::LitScene> sound = lit::litScene(Lighting::PIXEL);
    sound->addChild(square());
    // Two of 289 vertices: 8 of 256 quads are wrong, of a square on a third of the picture.
    EXPECT_LT(support::difference(*image, *lit::picture(*sound), 2.0 / 255.0).getShareOver(), 0.03);
    // A drawable of nothing else has no bound.
    osg::ref_ptr<osgShadowVolume::LitScene> nothing = lit::litScene(Lighting::PIXEL);
    nothing->addChild(square(
        [](osg::Geometry& g)
        {
            for (osg::Vec3& v : verticesOf(g))
                v = osg::Vec3(NotANumber, NotANumber, NotANumber);
        }));
    EXPECT_TRUE(lit::picture(*nothing).valid());
    // An infinite vertex gives an infinite bound, which OSG culls, with the kit as without.
    const auto endless = child(
        []
        {
            return square([](osg::Geometry& g)
                          { verticesOf(g)[40].x() = std::numeric_limits<float>::infinity(); });
        });
    osg::ref_ptr<osg::Group> plain = new osg::Group;
    osg::ref_ptr<osgShadowVolume::LitScene> lit = lit::litScene(Lighting::VERTEX);
    const osg::ref_ptr<osg::Image> stock = lit::picture(*endless(*plain));
    EXPECT_TRUE(support::CompareImage()(lit::picture(*endless(*lit)), stock, "extreme.infinite"));
    _notify.takeWarnings(); // OSG itself tells of bounds that are not numbers
}

TEST_F(Extreme, degenerateNonUniformAndNegativeScalesAreThoseOfStock)
{
    const std::pair<const char*, osg::Matrix> matrices[] = {
        {"flat", osg::Matrix::scale(1, 0, 1)},
        {"nonUniform", osg::Matrix::scale(0.3, 2.0, 1.1) * osg::Matrix::rotate(0.5, 0, 0, 1)},
        {"negative", osg::Matrix::scale(-1, 1, 1)},
        {"inverted", osg::Matrix::scale(-0.7, -0.8, -0.9)},
        {"sheared", osg::Matrix(1, 0.5, 0, 0, 0, 1, 0.3, 0, 0.2, 0, 1, 0, 0, 0, 0, 1)},
    };
    for (const auto& [name, matrix] : matrices)
        for (const bool normalize : {false, true})
        {
            const osg::Matrix& at = matrix;
            expectSound(
                [&](osg::Group& kit)
                {
                    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(at);
                    transform->addChild(ball({0, 0, 0}));
                    kit.addChild(transform);
                    if (normalize)
                        kit.getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
                    return osg::ref_ptr<osg::Node>(&kit);
                },
                std::string(name) + (normalize ? ".normalize" : ""));
        }
    // Nothing is left of it: no answer but that there is one.
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    osg::ref_ptr<osg::MatrixTransform> point =
        new osg::MatrixTransform(osg::Matrix::scale(0, 0, 0));
    point->addChild(ball({0, 0, 0}));
    kit->addChild(point);
    EXPECT_TRUE(lit::picture(*kit).valid());
    _notify.takeWarnings();
}

TEST_F(Extreme, farTinyAndHugeModelsAreLitAsNearOnes)
{
    // The same picture at each place and size; the eye goes along.
    const auto picture = [](double size, const osg::Vec3d& at)
    {
        osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(
            osg::Matrix::scale(size, size, size) * osg::Matrix::translate(at));
        osg::ref_ptr<osg::Node> source =
            lit::lightSource(1, osg::Vec4(-1.5f, -2, 1, 1), osg::Vec4(1, 0.8f, 0.3f, 1),
                             *kit->getOrCreateStateSet());
        static_cast<osg::LightSource*>(source.get())->getLight()->setSpotCutoff(25.0f);
        static_cast<osg::LightSource*>(source.get())
            ->getLight()
            ->setDirection(osg::Vec3(1.5f, 2, -1));
        place->addChild(source);
        place->addChild(ball({0, 0, 0}));
        kit->addChild(place);
        kit->getStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
        kit->getStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
        support::CameraSpec camera = support::CameraSpec::perspective(
            at + osg::Vec3d(0, -8, 3) * size, at, {0, 0, 1}, 30.0, double(lit::Width) / lit::Height,
            1.0 * size, 30.0 * size);
        return lit::viewer().render(kit, camera, lit::Width, lit::Height, 2);
    };
    const osg::ref_ptr<osg::Image> near = picture(1.0, {0, 0, 0});
    const support::CompareImage same;
    EXPECT_TRUE(same(picture(1.0, {1e7, -1e7, 1e7}), near, "extreme.far"));
    EXPECT_TRUE(same(picture(1e-6, {0, 0, 0}), near, "extreme.tiny"));
    EXPECT_TRUE(same(picture(1e9, {0, 0, 0}), near, "extreme.huge"));
    EXPECT_TRUE(same(picture(1e-3, {1e3, 1e3, 1e3}), near, "extreme.tinyAway"));
}

TEST_F(Extreme, spotsOfAnyConeAndExponent)
{
    for (const float cutoff : {0.0f, 1.0f, 45.0f, 90.0f, 180.0f})
        for (const float exponent : {0.0f, 1.0f, 128.0f})
            expectSound(underLight(
                            [=](osg::Light& light)
                            {
                                light.setDirection(osg::Vec3(0.1f, 1, 0.05f));
                                light.setSpotCutoff(cutoff);
                                light.setSpotExponent(exponent);
                            }),
                        "spot." + std::to_string(int(cutoff)) + "." +
                            std::to_string(int(exponent)));
    // No direction at all: a cone without an axis.
    expectFinitePixels(underLight(
        [](osg::Light& light)
        {
            light.setDirection(osg::Vec3(0, 0, 0));
            light.setSpotCutoff(30.0f);
        }));
}

TEST_F(Extreme, attenuationOfZeroSaturates)
{
    const auto build = underLight(
        [](osg::Light& light)
        {
            light.setConstantAttenuation(0.0f);
            light.setDiffuse(osg::Vec4(0.1f, 0, 0, 1));
        });
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::PIXEL);
    osg::ref_ptr<osg::Group> group = kit;
    const osg::ref_ptr<osg::Image> image = lit::picture(*build(*group));
    const osg::Vec4 middle = image->getColor(lit::Width / 2, lit::Height / 2);
    EXPECT_EQ(middle.r(), 1.0f) << "what is lit is as bright as can be";
    EXPECT_LT(middle.g(), 0.2f) << "and what is not lit stays dark";
    expectFinitePixels(build);
}

TEST_F(Extreme, aLightAtAVertexIsDefined)
{
    for (const float y : {0.0f, -1e-20f, -1e-4f})
    {
        const auto build = underLight(
            [=](osg::Light& light)
            {
                light.setPosition(osg::Vec4(0, y, 0, 1));
                light.setLinearAttenuation(1.0f);
                light.setConstantAttenuation(0.0f);
            });
        expectFinitePixels(build);
        osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::VERTEX);
        EXPECT_TRUE(lit::picture(*build(*kit)).valid());
    }
}

TEST_F(Extreme, materialsBeyondTheUsualRange)
{
    for (const float shininess : {0.0f, 128.0f})
        expectSound(
            [=](osg::Group& kit)
            {
                osg::ref_ptr<osg::Material> material = new osg::Material;
                material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(4, 4, 4, 1));
                material->setEmission(osg::Material::FRONT_AND_BACK, osg::Vec4(-1, 0, 0.1f, 1));
                material->setShininess(osg::Material::FRONT_AND_BACK, shininess);
                kit.getOrCreateStateSet()->setAttribute(material);
                kit.addChild(ball({0, 0, 0}));
                return osg::ref_ptr<osg::Node>(&kit);
            },
            "material." + std::to_string(int(shininess)));
}

TEST_F(Extreme, picturesOfOnePixelAndOfTheLargestWidth)
{
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(16384, 1), std::pair(1, 512)})
    {
        support::HeadlessViewer viewer({width, height});
        ASSERT_TRUE(viewer.isValid()) << viewer.getError();
        const support::CameraSpec camera = support::CameraSpec::perspective(
            {0, -3, 0}, {0, 0, 0}, {0, 0, 1}, 10.0, 1.0, 0.5, 30.0);
        osg::ref_ptr<osg::Group> plain = new osg::Group;
        osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::VERTEX);
        plain->addChild(square());
        kit->addChild(square());
        viewer.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
        const osg::ref_ptr<osg::Image> stock = viewer.render(plain, camera, width, height, 2);
        EXPECT_TRUE(support::CompareImage()(viewer.render(kit, camera, width, height, 2), stock,
                                            "extreme.size" + std::to_string(width)));
        kit->setLighting(Lighting::PIXEL);
        const osg::ref_ptr<osg::Image> pixel = viewer.render(kit, camera, width, height, 2);
        EXPECT_GT(pixel->getColor(width / 2, height / 2).r(), 0.5f) << width;
    }
}

TEST_F(Extreme, texturesThatAreMissingLeaveTheSurfacePlain)
{
    const std::pair<const char*, std::function<osg::ref_ptr<osg::Texture2D>()>> missing[] = {
        {"noImage", [] { return osg::ref_ptr<osg::Texture2D>(new osg::Texture2D); }},
        {"emptyImage",
         [] { return osg::ref_ptr<osg::Texture2D>(new osg::Texture2D(new osg::Image)); }},
        {"noTexture", [] { return osg::ref_ptr<osg::Texture2D>(); }},
    };
    for (const auto& [name, make] : missing)
    {
        const auto& texture = make;
        expectSound(
            [&](osg::Group& kit)
            {
                osg::ref_ptr<osg::Geode> geode = square();
                if (osg::ref_ptr<osg::Texture2D> t = texture())
                    geode->getOrCreateStateSet()->setTextureAttribute(0, t);
                geode->getOrCreateStateSet()->setTextureMode(0, GL_TEXTURE_2D,
                                                             osg::StateAttribute::ON);
                kit.addChild(geode);
                return osg::ref_ptr<osg::Node>(&kit);
            },
            std::string("texture.") + name);
    }
    // A file that is not there.
    support::TemporaryFolder folder;
    const std::string file = folder.write(
        "textured.iv",
        "#Inventor V2.1 ascii\nSeparator { Texture2 { filename \"gone.png\" } Cube {} }\n");
    osg::ref_ptr<osg::Node> stock = osgDB::readRefNodeFile(file);
    osg::ref_ptr<osg::Node> kit = osgDB::readRefNodeFile(file + ".(lighting=vertex).shadowvolume");
    _notify.takeWarnings(); // the reader tells of the file
    // Coin refuses a model whose texture it can't find; other versions leave it out.
    ASSERT_EQ(stock.valid(), kit.valid());
    if (stock)
    {
        EXPECT_TRUE(support::CompareImage()(lit::picture(*kit), lit::picture(*stock),
                                            "extreme.textureFile"));
    }
}
