// SPDX-License-Identifier: MIT
#include "AtlasSamples.h"
#include "CapturedWall.h"

#include <osgPagedTexture/AtlasModel.h>
#include <osgPagedTexture/PictureFile.h>

#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/TexMat>
#include <osg/Texture2D>
#include <osg/ValueObject>
#include <osgDB/ReadFile>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

using namespace osgPagedTexture;

namespace
{

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer made;
    return made;
}

osg::ref_ptr<osg::Image> draw(osg::Node* node)
{
    lookUpNearest(*node);
    const support::CameraSpec camera = support::CameraSpec::perspective(
        node->getBound().center() + osg::Vec3d(0.3, -1, 0.2) * node->getBound().radius() * 2.2,
        node->getBound().center(), {0, 0, 1}, 35.0, 320.0 / 240.0, 0.1, 100.0);
    return viewer().render(node, camera, 320, 240);
}

class AtlasModelGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        OSGKITS_NEED_GL(viewer());
        Pixels pixels(50, 40, 3);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 50; ++x)
                for (int c = 0; c < 3; ++c)
                    pixels.row(y)[3 * x + c] = static_cast<std::uint8_t>(c == 0   ? 5 * x
                                                                         : c == 1 ? 6 * y
                                                                                  : x * y % 256);
        _photograph = _folder.file("photograph.png");
        writePictureFile(_photograph, pixels);
    }

    /// Draws a graph before and after it has atlas coordinates and compares the pictures.
    AtlasModelReport checkLook(osg::Node* node, const std::string& name, bool tight = false)
    {
        // A copy: what has been drawn has buffers, which a model that was only read has not.
        const osg::ref_ptr<osg::Node> drawn =
            static_cast<osg::Node*>(node->clone(osg::CopyOp::DEEP_COPY_ALL));
        const osg::ref_ptr<osg::Image> before = draw(drawn);
        ModelPhotos model;
        model.model = node;
        collectPhotos(model, false);
        const std::string folder = _folder.getPath().string();
        const AtlasLayout layout = layoutOf(model, folder, tight);
        AtlasModelSettings settings;
        settings.overview = paintAtlas(layout, folder);
        const AtlasModelReport report = moveToAtlas(model, layout, folder, settings);
        const osg::ref_ptr<osg::Image> after = draw(model.model);
        support::writeImage(*after, name);
        support::CompareImage compare;
        // Which of two pixels of a photograph is the nearest one is decided by the last bits.
        compare.share = 0.01;
        compare.hardLimit = 1.0;
        EXPECT_TRUE(compare(after.get(), before.get(), name));
        atlasPixels = layout.width * layout.height;
        return report;
    }

    void checkSquare(osg::Texture::WrapMode wrap, const osg::Vec2 (&corners)[4],
                     const std::string& name, std::size_t leastSplit)
    {
        const AtlasModelReport report =
            checkLook(texturedSquare(_photograph, wrap, corners), "AtlasModelGLTest." + name);
        EXPECT_EQ(report.drawables, 1u);
        EXPECT_GE(report.split, leastSplit);
        EXPECT_TRUE(report.left.empty());
    }

    support::TemporaryFolder _folder;
    std::string _photograph;
    std::int64_t atlasPixels = 0;
};

TEST_F(AtlasModelGLTest, aScannedWallLooksTheSameWithAtlasCoordinates)
{
    const std::string path = CapturedWall(40, 30, 160, 128).write(_folder.getPath().string());
    const AtlasModelReport report =
        checkLook(osgDB::readRefNodeFile(path).get(), "AtlasModelGLTest.wall");
    EXPECT_EQ(report.triangles, 40u * 30u * 2u);
    EXPECT_EQ(report.written, report.triangles);
    // Floats have 24 bits; an atlas of 500 pixels needs 9 of them.
    EXPECT_LT(report.largestRounding, 1e-4);
}

TEST_F(AtlasModelGLTest, usedPartsAloneLookTheSameAndNeedLessRoom)
{
    const std::string path = CapturedWall(40, 30, 160, 128).write(_folder.getPath().string());
    checkLook(osgDB::readRefNodeFile(path).get(), "AtlasModelGLTest.whole");
    const std::int64_t whole = atlasPixels;
    checkLook(osgDB::readRefNodeFile(path).get(), "AtlasModelGLTest.tight", true);
    EXPECT_LT(atlasPixels, whole * 3 / 4);
}

TEST_F(AtlasModelGLTest, coordinatesInsideAreOnlyMoved)
{
    checkSquare(osg::Texture::REPEAT, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "inside", 0);
}

TEST_F(AtlasModelGLTest, repeatsAreCutAtTheirBorders)
{
    checkSquare(osg::Texture::REPEAT, {{-1.3f, -0.4f}, {2.7f, 0.1f}, {3.2f, 2.5f}, {-0.8f, 2.0f}},
                "repeat", 2);
}

TEST_F(AtlasModelGLTest, mirroredRepeatsAreTurnedRound)
{
    checkSquare(osg::Texture::MIRROR, {{-1.3f, -0.4f}, {2.7f, 0.1f}, {3.2f, 2.5f}, {-0.8f, 2.0f}},
                "mirror", 2);
}

TEST_F(AtlasModelGLTest, clampedCoordinatesStretchTheEdge)
{
    checkSquare(osg::Texture::CLAMP_TO_EDGE,
                {{-0.5f, -0.4f}, {1.7f, -0.1f}, {1.9f, 1.5f}, {-0.3f, 1.2f}}, "clamp", 2);
}

TEST_F(AtlasModelGLTest, aTextureMatrixIsWorkedIn)
{
    const osg::ref_ptr<osg::Geometry> square =
        texturedSquare(_photograph, osg::Texture::REPEAT, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    square->getStateSet()->setTextureAttribute(
        0, new osg::TexMat(osg::Matrix::scale(1.5, 2.0, 1.0) *
                           osg::Matrix::translate(0.3, -0.2, 0.0)));
    EXPECT_EQ(checkLook(square, "AtlasModelGLTest.matrix").split, 2u);
}

TEST_F(AtlasModelGLTest, aDrawableWithTwoPhotographsOnTwoPathsIsCopied)
{
    Pixels other(30, 30, 3);
    std::fill(other.bytes.begin(), other.bytes.end(), std::uint8_t(90));
    const std::string second = _folder.file("sub/photograph.png");
    writePictureFile(second, other);
    const osg::Vec2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const osg::ref_ptr<osg::Geometry> square =
        texturedSquare(_photograph, osg::Texture::REPEAT, corners);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    for (const std::string& photograph : {_photograph, second})
    {
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(
            osg::Matrix::translate(photograph == second ? 2.5 : 0.0, 0.0, 0.0));
        place->setStateSet(
            texturedSquare(photograph, osg::Texture::REPEAT, corners)->getStateSet());
        place->addChild(square);
        root->addChild(place);
    }
    square->setStateSet(nullptr);
    EXPECT_EQ(checkLook(root, "AtlasModelGLTest.shared").drawables, 2u);
}

TEST_F(AtlasModelGLTest, aPhotographRepeatedTooOftenStaysATextureOfItsOwn)
{
    const AtlasModelReport report = checkLook(
        texturedSquare(_photograph, osg::Texture::REPEAT, {{0, 0}, {100, 0}, {100, 100}, {0, 100}}),
        "AtlasModelGLTest.often");
    EXPECT_EQ(report.drawables, 0u);
    ASSERT_EQ(report.left.size(), 1u);
    EXPECT_EQ(report.left[0].name, _photograph);
    EXPECT_EQ(report.left[0].reason, "a triangle repeats it more than 256 times");
}

} // namespace
