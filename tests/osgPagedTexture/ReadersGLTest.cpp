// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osg/BlendFunc>
#include <osg/PagedLOD>
#include <osg/TextureRectangle>
#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <thread>

namespace
{

using osgPagedTexture::PagedScene;

/// Texels on the GPU are as in the file here; mip levels are averaged in linear light.
const support::CompareImage Alike{8.0 / 255.0, 0.01, 24.0 / 255.0};
const char* const Plain = "compression=none,wait=on";

class ReadersGLTest : public testing::Test
{
protected:
    /// A square with a picture that the model names.
    osg::ref_ptr<osg::Node> makeModel(int channels, bool read)
    {
        const std::string name = "picture" + std::to_string(channels) + ".png";
        paged::writePicture(_folder, name, 200, 150, channels);
        const osg::ref_ptr<osg::Texture2D> texture = paged::makeTexture(_folder.file(name));
        if (read)
        {
            osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(_folder.file(name));
            image->setFileName("");
            texture->setImage(image);
        }
        return paged::makeSquare({0.0f, 4.0f, 0.0f}, texture);
    }

    osg::ref_ptr<osg::Image> draw(osg::Node* node)
    {
        return _viewer.render(node, paged::lookAlong(), 320, 240);
    }

    void expectAlike(const std::string& file, double textures = 1.0)
    {
        const osg::ref_ptr<osg::Node> plain = osgDB::readRefNodeFile(file);
        ASSERT_TRUE(plain) << file;
        const osg::ref_ptr<PagedScene> scene = paged::read(file, Plain);
        const osg::ref_ptr<osg::Image> actual = draw(scene);
        EXPECT_TRUE(Alike(actual, draw(plain), "paged.reader")) << file;
        EXPECT_EQ(paged::countOf(*scene, "textures"), textures) << file;
        EXPECT_EQ(paged::countOf(*scene, "textures.resident"), textures) << file;
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(ReadersGLTest, eachFormatOfOsgPagesItsImageFiles)
{
    OSGKITS_NEED_GL(_viewer);
    for (const int channels : {3, 4})
        for (const char* const format : {"osgt", "osgb", "osgx"})
        {
            const std::string file = _folder.file(std::string("model.") + format);
            ASSERT_TRUE(osgDB::writeNodeFile(*makeModel(channels, false), file));
            expectAlike(file);
        }
}

TEST_F(ReadersGLTest, imagesInTheModelItselfArePagedToo)
{
    OSGKITS_NEED_GL(_viewer);
    for (const int channels : {1, 2, 3, 4})
        for (const char* const format : {"osgt", "osgb", "ive"})
        {
            const std::string file = _folder.file(std::string("inside.") + format);
            ASSERT_TRUE(osgDB::writeNodeFile(*makeModel(channels, true), file));
            expectAlike(file);
        }
}

TEST_F(ReadersGLTest, inventorAndWavefrontModelsArePaged)
{
    OSGKITS_NEED_GL(_viewer);
    paged::writePicture(_folder, "wall.jpg", 256, 256);
    const std::string inventor = _folder.write("model.iv", R"(#Inventor V2.1 ascii
Separator { Texture2 { filename "wall.jpg" }
  Coordinate3 { point [ -1 -1 -4, 1 -1 -4, 1 1 -4, -1 1 -4 ] }
  TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1 ] }
  IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] textureCoordIndex [ 0, 1, 2, 3, -1 ] } }
)");
    expectAlike(inventor);
    _folder.write("model.mtl", "newmtl wall\nKd 1 1 1\nmap_Kd wall.jpg\n");
    const std::string wavefront = _folder.write("model.obj", R"(mtllib model.mtl
usemtl wall
v -1 -1 -4
v 1 -1 -4
v 1 1 -4
v -1 1 -4
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
)");
    expectAlike(wavefront);
}

TEST_F(ReadersGLTest, stanfordModelsArePaged)
{
    OSGKITS_NEED_GL(_viewer);
    paged::writePicture(_folder, "wall.jpg", 256, 256);
    expectAlike(_folder.write("model.ply", R"(ply
format ascii 1.0
comment TextureFile wall.jpg
element vertex 4
property float x
property float y
property float z
property float nx
property float ny
property float nz
property float texture_u
property float texture_v
element face 2
property list uchar int vertex_indices
end_header
-1 4 -1 0 -1 0 0 0
1 4 -1 0 -1 0 1 0
1 4 1 0 -1 0 1 1
-1 4 1 0 -1 0 0 1
3 0 1 2
3 0 2 3
)"));
}

TEST_F(ReadersGLTest, readersSeeTheTrueTranslucency)
{
    paged::writePicture(_folder, "opaque.png", 64, 64, 3);
    paged::writePicture(_folder, "glass.png", 64, 64, 4);
    for (const char* const name : {"opaque", "glass"})
    {
        const std::string file =
            _folder.write(std::string(name) + ".iv",
                          std::string("#Inventor V2.1 ascii\nSeparator { Texture2 { filename \"") +
                              name + ".png\" } Cube { } }\n");
        const osg::ref_ptr<PagedScene> paged = paged::read(file);
        struct Blending : osg::NodeVisitor
        {
            Blending() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
            void apply(osg::Node& node) override
            {
                if (const osg::StateSet* state = node.getStateSet())
                    blends = blends || state->getMode(GL_BLEND) & osg::StateAttribute::ON;
                traverse(node);
            }
            void apply(osg::Drawable& node) override { apply(static_cast<osg::Node&>(node)); }
            bool blends = false;
        } blending;
        paged->accept(blending);
        EXPECT_EQ(blending.blends, std::string(name) == "glass") << name;
    }
}

TEST_F(ReadersGLTest, texturesThatAreNotFlatKeepTheirImages)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string picture = paged::writePicture(_folder, "picture.png", 64, 48);
    const osg::ref_ptr<osg::Texture2D> named = paged::makeTexture(picture);
    osg::ref_ptr<osg::TextureRectangle> rectangle = new osg::TextureRectangle(named->getImage());
    osg::ref_ptr<osg::Geode> square = paged::makeSquare({0.0f, 4.0f, 0.0f}, nullptr);
    square->getOrCreateStateSet()->setTextureAttributeAndModes(0, rectangle);
    ASSERT_TRUE(osgDB::writeNodeFile(*square, _folder.file("rectangle.osgt")));
    const osg::ref_ptr<PagedScene> scene = paged::read(_folder.file("rectangle.osgt"));
    const auto* texture = dynamic_cast<const osg::Texture*>(
        scene->getChild(0)->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    ASSERT_TRUE(texture && texture->getImage(0));
    EXPECT_EQ(texture->getImage(0)->s(), 64);
    EXPECT_EQ(texture->getImage(0)->t(), 48);
    EXPECT_EQ(paged::countOf(*scene, "textures"), 0.0);
}

TEST_F(ReadersGLTest, parametersOfTheModelsTexturesStay)
{
    const std::string picture = paged::writePicture(_folder, "picture.png", 64, 64);
    const osg::ref_ptr<osg::Texture2D> texture = paged::makeTexture(picture);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::MIRROR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture->setMaxAnisotropy(4.0f);
    texture->setBorderColor(osg::Vec4d(1.0, 0.5, 0.25, 1.0));
    ASSERT_TRUE(
        osgDB::writeNodeFile(*paged::makeSquare({}, texture), _folder.file("parameters.osgt")));
    const osg::ref_ptr<PagedScene> scene = paged::read(_folder.file("parameters.osgt"));
    const auto* paged = dynamic_cast<const osg::Texture2D*>(
        scene->getChild(0)->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    ASSERT_TRUE(paged && paged->getSubloadCallback());
    EXPECT_EQ(paged->getWrap(osg::Texture::WRAP_S), osg::Texture::MIRROR);
    EXPECT_EQ(paged->getFilter(osg::Texture::MAG_FILTER), osg::Texture::NEAREST);
    EXPECT_EQ(paged->getMaxAnisotropy(), 4.0f);
    EXPECT_EQ(paged->getBorderColor(), osg::Vec4d(1.0, 0.5, 0.25, 1.0));
    EXPECT_FALSE(paged->getImage()->isImageTranslucent());
    EXPECT_EQ(paged->getImage()->getFileName(), picture) << "so that it is written to files";
}

TEST_F(ReadersGLTest, theRegistryIsAsBeforeAndOtherThreadsReadImagesMeanwhile)
{
    const std::string picture = paged::writePicture(_folder, "picture.png", 64, 64);
    struct Meanwhile : osgDB::ReadFileCallback
    {
        osgDB::ReaderWriter::ReadResult readNode(const std::string& name,
                                                 const osgDB::Options* options) override
        {
            std::thread other(
                [this]
                {
                    const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(picture);
                    side = image ? image->s() : 0;
                });
            other.join();
            return osgDB::ReadFileCallback::readNode(name, options);
        }
        std::string picture;
        int side = 0;
    };
    const osg::ref_ptr<Meanwhile> before = new Meanwhile;
    before->picture = picture;
    ASSERT_TRUE(osgDB::writeNodeFile(*paged::makeSquare({}, paged::makeTexture(picture)),
                                     _folder.file("model.osgt")));
    osgDB::Registry* registry = osgDB::Registry::instance();
    registry->setReadFileCallback(before);
    const osg::ref_ptr<PagedScene> scene = paged::read(_folder.file("model.osgt"));
    EXPECT_EQ(registry->getReadFileCallback(), before.get());
    EXPECT_EQ(before->side, 64) << "another thread was given a stand-in";
    registry->setReadFileCallback(nullptr);
    EXPECT_EQ(paged::countOf(*scene, "textures"), 1.0);
    EXPECT_FALSE(scene->readModel(_folder.file("missing.osgt")).validNode());
    EXPECT_EQ(registry->getReadFileCallback(), nullptr);
}

TEST_F(ReadersGLTest, whatPagedLodsReadLaterIsPagedToo)
{
    OSGKITS_NEED_GL(_viewer);
    ASSERT_TRUE(osgDB::writeNodeFile(*makeModel(3, false), _folder.file("tile.osgt")));
    osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->setDatabasePath(_folder.getPath().string() + "/");
    lod->setFileName(0, "tile.osgt");
    lod->setRange(0, 0.0f, 1e6f);
    lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    lod->setCenter(osg::Vec3(0.0f, 4.0f, 0.0f));
    lod->setRadius(2.0);
    ASSERT_TRUE(osgDB::writeNodeFile(*lod, _folder.file("lod.osgt")));
    const osg::ref_ptr<PagedScene> scene = paged::read(_folder.file("lod.osgt"), Plain);
    for (int i = 0; i < 6000 && paged::countOf(*scene, "textures") == 0.0; ++i)
    {
        draw(scene);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    for (int i = 0; i < 3; ++i)
        draw(scene);
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 1.0);
    const osg::ref_ptr<osg::Node> plain = osgDB::readRefNodeFile(_folder.file("tile.osgt"));
    const osg::ref_ptr<osg::Image> actual = draw(scene);
    EXPECT_TRUE(Alike(actual, draw(plain), "paged.lod"));
}
