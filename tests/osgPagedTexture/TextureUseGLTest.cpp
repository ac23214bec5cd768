// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <osgPagedTexture/TextureUse.h>
#include <support/NotifyCapture.h>

#include <osg/TexEnvCombine>
#include <osg/ValueObject>
#include <osgDB/ObjectWrapper>

#include <gtest/gtest.h>

#include <cmath>

using osgPagedTexture::PagedScene;
using osgPagedTexture::TextureUse;

namespace
{

class TextureUseGLTest : public testing::Test
{
protected:
    /// Of a picture of so many channels in a unit; what else the test has put into `_stateSet` and
    /// `_texture` counts.
    TextureUse use(unsigned int unit, const std::string& name, int channels = 3)
    {
        return osgPagedTexture::useOf(*_texture, {{_stateSet.get()}, unit, _bumpUnit},
                                      {name, channels});
    }

    /// Of how many of a scene's textures the plan says that they are normals.
    static int normalsIn(const PagedScene& scene)
    {
        int count = 0;
        const std::vector<osgMultiRender::Plan> plans = scene.getPlans();
        for (const osgMultiRender::PlanEntry& entry : plans.at(0).entries)
            count += entry.subject.find(", normals") != std::string::npos;
        return count;
    }

    osg::ref_ptr<osg::StateSet> _stateSet = new osg::StateSet;
    osg::ref_ptr<osg::Texture2D> _texture = new osg::Texture2D;
    int _bumpUnit = -1;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(TextureUseGLTest, namesThatSayNormalMapAreKnown)
{
    for (const char* const name :
         {"wall_normal.png", "wall-Normals.jpg", "textures/wall_nrm.tga", "WallNormal.png",
          "Wall051_2K_NormalGL.jpg", "wall_normal_2k.png", "wall normal map.png", "normal.png",
          "wall_normal-ogl.png", "a.b_NormalMap.png", "wall_n.png", "wall_nm.png"})
        EXPECT_EQ(use(1, name), TextureUse::Normals) << name;
    for (const char* const name :
         {"wall.png", "normandy.jpg", "paranormal.png", "normal_people.jpg", "n.png", "", "_.png",
          "plan.png", "1234.png", "abnormal.jpg", "wall_n/front.png"})
        EXPECT_EQ(use(1, name), TextureUse::Color) << name;
    EXPECT_EQ(use(1, "wall_normal.png", 1), TextureUse::Color) << "grey holds no directions";
    EXPECT_EQ(use(0, "house_n.jpg"), TextureUse::Color) << "north";
    EXPECT_EQ(use(0, "house_normal.jpg"), TextureUse::Normals);
}

TEST_F(TextureUseGLTest, theNameOfTheSamplerCountsBeforeThatOfTheFile)
{
    _stateSet->addUniform(new osg::Uniform("u_normalMap", 2));
    _stateSet->addUniform(new osg::Uniform("diffuseTexture", 1));
    _stateSet->addUniform(new osg::Uniform("strength", 3.0f));
    EXPECT_EQ(use(2, "wall.png"), TextureUse::Normals);
    EXPECT_EQ(use(2, "wall.png", 1), TextureUse::Data) << "heights";
    EXPECT_EQ(use(1, "wall_normal.png"), TextureUse::Color);
    EXPECT_EQ(use(3, "wall.png"), TextureUse::Color);
}

TEST_F(TextureUseGLTest, environmentsOfDotProductsAndUnitsOfReadersTakeNormals)
{
    osg::ref_ptr<osg::TexEnvCombine> combine = new osg::TexEnvCombine;
    combine->setCombine_RGB(osg::TexEnvCombine::DOT3_RGB);
    _stateSet->setTextureAttribute(1, combine);
    EXPECT_EQ(use(1, "wall.png"), TextureUse::Normals);
    EXPECT_EQ(use(2, "wall.png"), TextureUse::Color);
    _bumpUnit = 2;
    EXPECT_EQ(use(2, "wall.png"), TextureUse::Normals);
    EXPECT_EQ(use(2, "wall.png", 1), TextureUse::Data);
}

TEST_F(TextureUseGLTest, theUsersValueWinsAndAWrongOneIsNamed)
{
    _texture->setUserValue("osgPagedTexture.use", std::string("color"));
    EXPECT_EQ(use(1, "wall_normal.png"), TextureUse::Color);
    _texture->setUserValue("osgPagedTexture.use", std::string("normalsxy"));
    EXPECT_EQ(use(0, "wall.png"), TextureUse::NormalsXY);
    _texture->setUserValue("osgPagedTexture.use", std::string("bumps"));
    EXPECT_EQ(use(1, "wall_normal.png"), TextureUse::Normals);
    const support::NotifyCapture::Lines warnings = _notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'bumps' is no use of a texture; say"), std::string::npos);
}

TEST_F(TextureUseGLTest, theReliefUnitOfWavefrontModelsHoldsNormals)
{
    paged::writePicture(_folder, "wall.png", 64, 64);
    paged::writePicture(_folder, "relief.png", 64, 64, 3, 2);
    _folder.write("model.mtl", "newmtl wall\nKd 1 1 1\nmap_Kd wall.png\nmap_Bump relief.png\n");
    const std::string model = _folder.write("model.obj", R"(mtllib model.mtl
usemtl wall
v -1 -1 -4
v 1 -1 -4
v 1 1 -4
vt 0 0
vt 1 0
vt 1 1
f 1/1 2/2 3/3
)");
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("DIFFUSE=0 BUMP=1");
    const osg::ref_ptr<PagedScene> scene = new PagedScene;
    ASSERT_TRUE(scene->readModel(model, options).validNode());
    EXPECT_EQ(paged::countOf(*scene, "textures"), 2.0);
    EXPECT_EQ(normalsIn(*scene), 1);
}

TEST_F(TextureUseGLTest, theReliefUnitOfOsgFxHoldsNormals)
{
    osgDB::ObjectWrapper* wrapper =
        osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper("osgFX::BumpMapping");
    ASSERT_TRUE(wrapper);
    const osg::ref_ptr<osg::Object> made = wrapper->createInstance();
    osg::Group* effect = made->asNode()->asGroup();
    const osg::ref_ptr<osg::Texture2D> relief =
        paged::makeTexture(paged::writePicture(_folder, "relief.png", 64, 64));
    osg::ref_ptr<osg::Geode> square = paged::makeSquare({}, nullptr);
    square->getOrCreateStateSet()->setTextureAttributeAndModes(0, relief); // Its default.
    relief->getImage()->allocateImage(64, 64, 1, GL_RGB, GL_UNSIGNED_BYTE);
    effect->addChild(square);
    const osg::ref_ptr<PagedScene> scene = osgPagedTexture::install(*effect);
    EXPECT_EQ(normalsIn(*scene), 1);
}

TEST_F(TextureUseGLTest, normalsOnTheGpuAreThoseOfTheFileAndStayUnitVectors)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    // A ball's normals; the square shows them as colours, level 0 to the pixel, then level 3.
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(128, 128, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
        {
            const osg::Vec2d p((x - 63.5) / 70.0, (y - 63.5) / 70.0);
            const double square = p.length2();
            osg::Vec3d normal(p.x(), p.y(), std::sqrt(std::max(0.0, 1.0 - square)));
            normal.normalize();
            for (int c = 0; c < 3; ++c)
                image->data(unsigned(x), unsigned(y))[c] =
                    static_cast<unsigned char>(std::lround((normal[c] + 1.0) * 127.5));
        }
    ASSERT_TRUE(osgDB::writeImageFile(*image, _folder.file("ball_normal.png")));
    const std::string model = _folder.file("ball.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(
        *paged::makeSquare({0.0f, 4.0f, 0.0f}, paged::makeTexture(_folder.file("ball_normal.png"))),
        model));
    const osg::ref_ptr<PagedScene> scene = paged::read(model, "wait=on");
    for (const double away : {0.0, -20.0})
    {
        const osg::ref_ptr<osg::Image> shown =
            viewer.render(scene, paged::lookAlong({0.0, away, 0.0}), 320, 240);
        const osg::Vec4 texel = shown->getColor(160u, 120u);
        EXPECT_NEAR(texel.b(), 1.0, 2.0 / 255.0) << away; // Straight up in the middle.
        const int side = away == 0.0 ? 30 : 6;
        osg::Vec3d normal;
        for (int c = 0; c < 3; ++c)
            normal[c] = 2.0 * shown->getColor(unsigned(160 + side), 120u)[c] - 1.0;
        // A step of 8 bits in each component, and BC7's error, measured up to 2 of them.
        EXPECT_NEAR(normal.length(), 1.0, 3.0 / 127.5) << away;
        EXPECT_GT(normal.x(), 0.2) << away;
    }
    EXPECT_EQ(normalsIn(*scene), 1);
    EXPECT_GE(paged::countOf(*scene, "gpu.bytes.peak"), 128 * 128) << "BC1 would have half of it";
}
