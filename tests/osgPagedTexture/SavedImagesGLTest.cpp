// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

using osgPagedTexture::PagedScene;

namespace
{

class SavedImagesGLTest : public testing::Test
{
protected:
    /// A model with a picture in itself, paged.
    osg::ref_ptr<PagedScene> readEmbedding(GLenum format)
    {
        const int channels = int(osg::Image::computeNumComponents(format));
        _picture = paged::makePicture(96, 80, channels, 5);
        _picture->setPixelFormat(format);
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(_picture);
        const std::string file = _folder.file("embedding.osgb");
        EXPECT_TRUE(osgDB::writeNodeFile(*paged::makeSquare({0.0f, 4.0f, 0.0f}, texture), file));
        return paged::read(file, "compression=none,wait=on");
    }

    static osg::ref_ptr<osg::Image> imageIn(osg::Node& node)
    {
        struct Finder : osg::NodeVisitor
        {
            Finder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
            void apply(osg::Node& each) override
            {
                osg::StateAttribute* attribute =
                    each.getStateSet()
                        ? each.getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE)
                        : nullptr;
                if (attribute)
                    image = attribute->asTexture()->getImage(0);
                traverse(each);
            }
            osg::ref_ptr<osg::Image> image;
        } finder;
        node.accept(finder);
        return finder.image;
    }

    osg::ref_ptr<osg::Image> _picture;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(SavedImagesGLTest, picturesOfTheModelItselfAreWrittenBackTexelByTexel)
{
    for (const GLenum format :
         {GL_LUMINANCE, GL_RED, GL_LUMINANCE_ALPHA, GL_RGB, GL_BGR, GL_RGBA, GL_BGRA})
        for (const char* const extension : {"osgt", "osgb", "ive"})
        {
            const osg::ref_ptr<PagedScene> scene = readEmbedding(format);
            ASSERT_EQ(imageIn(*scene)->s(), 4) << "no proof: it is not paged";
            const std::string file = _folder.file(std::string("saved.") + extension);
            ASSERT_TRUE(osgDB::writeNodeFile(*scene->getChild(0), file));
            EXPECT_EQ(imageIn(*scene)->s(), 4) << "in memory the stand-in stays";
            const osg::ref_ptr<osg::Node> saved = osgDB::readRefNodeFile(file);
            ASSERT_TRUE(saved) << file;
            const osg::ref_ptr<osg::Image> image = imageIn(*saved);
            ASSERT_TRUE(image && image->data()) << file << format;
            EXPECT_EQ(image->getPixelFormat(), format) << file;
            ASSERT_EQ(image->s(), 96);
            ASSERT_EQ(image->t(), 80);
            for (int y = 0; y < 80; ++y)
                EXPECT_EQ(std::memcmp(image->data(0, unsigned(y)), _picture->data(0, unsigned(y)),
                                      std::size_t(96) * osg::Image::computeNumComponents(format)),
                          0)
                    << file << y;
        }
}

TEST_F(SavedImagesGLTest, picturesOfFilesAreNamedInWhatIsWritten)
{
    paged::writePicture(_folder, "wall.png", 128, 128);
    const std::string model = _folder.file("model.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(
        *paged::makeSquare({0.0f, 4.0f, 0.0f}, paged::makeTexture("wall.png")), model));
    const osg::ref_ptr<PagedScene> scene = paged::read(model);
    for (const char* const extension : {"osgt", "osgb", "osgx", "ive"})
    {
        const std::string file = _folder.file(std::string("named.") + extension);
        ASSERT_TRUE(osgDB::writeNodeFile(*scene->getChild(0), file));
        EXPECT_LT(std::filesystem::file_size(file), 20000u) << "it holds no pixels";
        const osg::ref_ptr<osg::Node> saved = osgDB::readRefNodeFile(file);
        ASSERT_TRUE(saved && imageIn(*saved)) << file;
        EXPECT_EQ(imageIn(*saved)->s(), 128) << file;
        EXPECT_NE(imageIn(*saved)->getFileName().find("wall.png"), std::string::npos) << file;
    }
    const osg::ref_ptr<osgDB::Options> all = new osgDB::Options("WriteImageHint=IncludeData");
    all->setPluginStringData("WriteImageHint", "IncludeData");
    ASSERT_TRUE(osgDB::writeNodeFile(*scene->getChild(0), _folder.file("all.osgb"), all));
    EXPECT_GT(std::filesystem::file_size(_folder.file("all.osgb")), 128u * 128 * 3);
    std::filesystem::remove(_folder.file("wall.png"));
    const osg::ref_ptr<osg::Node> saved = osgDB::readRefNodeFile(_folder.file("all.osgb"));
    EXPECT_EQ(imageIn(*saved)->s(), 128);
}

TEST_F(SavedImagesGLTest, aSavedSceneWithItsOwnPictureShowsTheSame)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const osg::ref_ptr<PagedScene> scene = readEmbedding(GL_RGB);
    const osg::ref_ptr<osg::Image> expected = viewer.render(scene, paged::lookAlong(), 320, 240);
    ASSERT_TRUE(osgDB::writeNodeFile(*scene, _folder.file("saved.osgt")));
    EXPECT_TRUE(support::CompareImage({0.0, 0.0, 0.0})(
        viewer.render(scene, paged::lookAlong(), 320, 240), expected, "paged.saving"));
    const osg::ref_ptr<osg::Node> saved = osgDB::readRefNodeFile(_folder.file("saved.osgt"));
    ASSERT_TRUE(dynamic_cast<PagedScene*>(saved.get()));
    EXPECT_TRUE(support::CompareImage({0.0, 0.0, 0.0})(
        viewer.render(saved, paged::lookAlong(), 320, 240), expected, "paged.saved"));
}

TEST_F(SavedImagesGLTest, theRegistrysOwnCallbackIsAskedAndIsThereAgainAfterwards)
{
    struct Counting : osgDB::WriteFileCallback
    {
        osgDB::ReaderWriter::WriteResult writeNode(const osg::Node& node, const std::string& name,
                                                   const osgDB::Options* options) override
        {
            ++nodes;
            return osgDB::WriteFileCallback::writeNode(node, name, options);
        }
        int nodes = 0;
    };
    const osg::ref_ptr<Counting> counting = new Counting;
    osgDB::Registry* registry = osgDB::Registry::instance();
    registry->setWriteFileCallback(counting);
    {
        const osg::ref_ptr<PagedScene> scene = new PagedScene, other = new PagedScene;
        EXPECT_NE(registry->getWriteFileCallback(), counting);
        osgDB::writeNodeFile(*scene, _folder.file("empty.osgt"));
    }
    EXPECT_EQ(counting->nodes, 1);
    EXPECT_EQ(registry->getWriteFileCallback(), counting);
    registry->setWriteFileCallback(nullptr);
}
