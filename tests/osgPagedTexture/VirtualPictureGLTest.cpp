// SPDX-License-Identifier: MIT
// At rest a virtual texture shows what a plain one shows.
#include "VirtualScenes.h"

#include <osgPagedTexture/TileFolders.h>

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osg/GLExtensions>
#include <osg/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace
{

using osgPagedTexture::FolderLayout;
using osgPagedTexture::TileFolderWriter;
using osgPagedTexture::TileGrid;
using osgPagedTexture::TileStoreSettings;
using osgPagedTexture::VirtualScene;

[[maybe_unused]] const bool filtersExactly = (virtuals::filterExactly(), true);

/// GL rounds weights of texels and levels to 1/256 or more, each in its own place, so that a
/// channel may round the other way in each of the two mixes.
const support::CompareImage Same{1.0 / 255.0, 0.0005, 3.0 / 255.0};

support::CameraSpec lookFrom(const osg::Vec3d& eye, const osg::Vec3d& center = {})
{
    return support::CameraSpec::perspective(eye, center, {0.0, 1.0, 0.0}, 50.0, 4.0 / 3.0, 1e-4,
                                            1e4);
}

class VirtualPictureGLTest : public testing::Test
{
protected:
    std::string build(const virtuals::Levels& levels, int side = 64, int border = 2)
    {
        const std::string path = _folder.file("atlas" + std::to_string(_stores++));
        virtuals::buildStore(path, levels, side, border);
        return path;
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
    int _stores = 0;
};

} // namespace

TEST_F(VirtualPictureGLTest, atRestThePictureIsThatOfAPlainTexture)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(1024, 1024);
    const auto plain = virtuals::makeFloor(virtuals::makePlainTexture(levels), 10.0f);
    const auto scene = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(build(levels)), 10.0f));
    for (const double height : {1e-3, 0.5, 2.0, 7.3, 12.0, 30.0, 200.0})
    {
        const auto camera = lookFrom({0.0, 0.0, height});
        const auto expected = _viewer.render(plain, camera, 320, 240);
        const auto actual = virtuals::settle(_viewer, *scene, scene, camera);
        EXPECT_TRUE(Same(actual, expected, "virtual.above" + std::to_string(height)));
        EXPECT_EQ(virtuals::countOf(*scene, "levels.missing"), 0.0) << "no proof";
    }
    EXPECT_GT(virtuals::countOf(*scene, "pages.uploaded"), 100.0) << "no proof";
}

// Deep Zoom's tiles end with the picture, at the right and below, and its levels are numbered from
// the coarsest.
TEST_F(VirtualPictureGLTest, foldersOfLibVTAndDeepZoomShowTheSame)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(1024, 512);
    const auto plain = virtuals::makeFloor(virtuals::makePlainTexture(levels), 10.0f);
    for (const auto& [name, layout, edge] :
         {std::tuple{"libvt", FolderLayout::LibVT, TileGrid::Edge::Padded},
          std::tuple{"web.dzi", FolderLayout::DeepZoom, TileGrid::Edge::Clipped}})
    {
        TileStoreSettings settings;
        settings.format = "png";
        settings.grid = TileGrid(1024, 512, 64, 2, edge);
        TileFolderWriter writer(_folder.file(name), layout, settings, {});
        virtuals::writeTiles(writer, settings.grid, levels);
        const auto scene = virtuals::makeScene(
            virtuals::makeFloor(virtuals::makeVirtualTexture(_folder.file(name)), 10.0f));
        for (const osg::Vec3d& eye : {osg::Vec3d(3.0, 2.0, 3.0), osg::Vec3d(0.0, -14.0, 8.0)})
        {
            const auto camera = lookFrom(eye);
            EXPECT_TRUE(Same(virtuals::settle(_viewer, *scene, scene, camera),
                             _viewer.render(plain, camera, 320, 240),
                             std::string("virtual.") + name));
            EXPECT_EQ(virtuals::countOf(*scene, "levels.missing"), 0.0) << "no proof";
        }
    }
}

TEST_F(VirtualPictureGLTest, bordersOfPagesShowNoSeamAtAnyAngleAndLevel)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(1024, 1024, 5);
    const auto plain = virtuals::makeFloor(virtuals::makePlainTexture(levels), 10.0f);
    const auto scene = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(build(levels)), 10.0f));
    const auto bordered = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(build(levels)), 10.0f), "show=pages");
    unsigned int atBorders = 0;
    double worst = 0.0, worstInside = 0.0;
    for (const double lift : {10.0, 30.0, 60.0, 85.0})
        for (const double distance : {1.0, 6.0, 25.0})
        {
            const double angle = lift * 0.017453292519943295;
            const auto camera =
                lookFrom({0.3 * distance, -distance * std::cos(angle), distance * std::sin(angle)});
            const auto expected = _viewer.render(plain, camera, 320, 240);
            const auto actual = virtuals::settle(_viewer, *scene, scene, camera);
            const auto marked = virtuals::settle(_viewer, *bordered, bordered, camera);
            for (unsigned int y = 0; y < 240; ++y)
                for (unsigned int x = 0; x < 320; ++x)
                {
                    bool isBorder = false;
                    int error = 0;
                    for (unsigned int c = 0; c < 3; ++c)
                    {
                        isBorder =
                            isBorder || std::abs(marked->data(x, y)[c] - actual->data(x, y)[c]) > 8;
                        error = std::max(error,
                                         std::abs(actual->data(x, y)[c] - expected->data(x, y)[c]));
                    }
                    atBorders += isBorder;
                    (isBorder ? worst : worstInside) =
                        std::max(isBorder ? worst : worstInside, double(error));
                }
            // Where a pixel's footprint is six times as long as wide GL's logarithm and derivatives
            // put it up to a tenth of a level elsewhere.
            const support::CompareImage alike =
                lift < 20.0 ? support::CompareImage{2.0 / 255.0, 0.01, 16.0 / 255.0} : Same;
            EXPECT_TRUE(alike(actual, expected,
                              "virtual.seams" + std::to_string(int(lift)) + "-" +
                                  std::to_string(int(distance))));
        }
    EXPECT_GT(atBorders, 5000u) << "no proof";
    EXPECT_LE(worst, std::max(worstInside, 1.0));
    RecordProperty("atBorders", int(worst));
    RecordProperty("inside", int(worstInside));
}

TEST_F(VirtualPictureGLTest, outsideOfZeroToOneWrapModesCount)
{
    OSGKITS_NEED_GL(_viewer);
    // Alike at both edges: where a picture repeats, GL filters across the edge, and pages end
    // there.
    virtuals::Levels levels = virtuals::makeLevels(512, 512, 3);
    osgPagedTexture::Pixels picture = levels[0];
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            for (int c = 0; c < 3; ++c)
                picture.row(y)[3 * x + c] =
                    std::uint8_t(127.5 + 60.0 * std::cos(x * 0.012271846 * (c + 1)) +
                                 60.0 * std::cos(y * 0.024543693));
    levels = virtuals::makeLevels(picture);
    const std::string store = build(levels);
    for (const auto mode :
         {osg::Texture::REPEAT, osg::Texture::MIRROR, osg::Texture::CLAMP_TO_EDGE})
    {
        const osg::ref_ptr<osg::Texture2D> plainTexture = virtuals::makePlainTexture(levels);
        const auto virtualTexture = virtuals::makeVirtualTexture(store);
        for (osg::Texture2D* texture : {plainTexture.get(), (osg::Texture2D*)virtualTexture.get()})
        {
            texture->setWrap(osg::Texture::WRAP_S, mode);
            texture->setWrap(osg::Texture::WRAP_T, mode);
        }
        const auto plain = virtuals::makeFloor(plainTexture, 10.0f, 2.6f);
        const auto scene = virtuals::makeScene(virtuals::makeFloor(virtualTexture, 10.0f, 2.6f));
        for (const double height : {3.0, 11.0, 40.0})
        {
            const auto camera = lookFrom({0.4, -0.3, height});
            const auto expected = _viewer.render(plain, camera, 320, 240);
            const auto actual = virtuals::settle(_viewer, *scene, scene, camera);
            EXPECT_TRUE(Same(actual, expected,
                             "virtual.wrap" + std::to_string(int(mode)) + "-" +
                                 std::to_string(int(height))));
        }
    }
}

TEST_F(VirtualPictureGLTest, anisotropicFilteringIsSharperAndHasNoSeams)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(1024, 1024, 8);
    const osg::ref_ptr<osg::Texture2D> texture = virtuals::makePlainTexture(levels);
    texture->setMaxAnisotropy(8.0f);
    const auto plain = virtuals::makeFloor(texture, 10.0f);
    const std::string store = build(levels);
    const auto sharp = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f), "aniso=8");
    const auto blurred =
        virtuals::makeScene(virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f));
    const auto camera = lookFrom({0.0, -7.0, 1.0}, {0.0, -2.0, 0.0});
    const auto expected = _viewer.render(plain, camera, 320, 240);
    const auto actual = virtuals::settle(_viewer, *sharp, sharp, camera);
    const auto without = virtuals::settle(_viewer, *blurred, blurred, camera);
    // GL leaves open how it samples: pictures are alike, not equal.
    const support::CompareImage alike{8.0 / 255.0, 0.05, 48.0 / 255.0};
    EXPECT_TRUE(alike(actual, expected, "virtual.aniso"));
    EXPECT_GT(support::difference(*without, *expected, 8.0 / 255.0).getShareOver(),
              support::difference(*actual, *expected, 8.0 / 255.0).getShareOver());
}

TEST_F(VirtualPictureGLTest, sidesThatAreNoPowersOfTwoAndNoSquaresShowTheSame)
{
    OSGKITS_NEED_GL(_viewer);
    for (const auto& [width, height] :
         {std::pair(640, 200), std::pair(100, 999), std::pair(33, 47)})
    {
        const virtuals::Levels levels = virtuals::makeLevels(width, height, 4);
        // GL takes levels that are rounded down: only the full size is the same picture.
        const auto plain = virtuals::makeFloor(
            virtuals::makePlainTexture({levels.begin(), levels.begin() + 1}), 10.0f);
        plain->getStateSet()
            ->getTextureAttribute(0, osg::StateAttribute::TEXTURE)
            ->asTexture()
            ->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
        const auto scene = virtuals::makeScene(
            virtuals::makeFloor(virtuals::makeVirtualTexture(build(levels)), 10.0f));
        const auto camera = lookFrom({1.0, 0.5, 0.3}, {1.0, 0.5, 0.0});
        const auto expected = _viewer.render(plain, camera, 320, 240);
        const auto actual = virtuals::settle(_viewer, *scene, scene, camera);
        EXPECT_TRUE(Same(actual, expected, "virtual.side" + std::to_string(width)));
    }
}

TEST_F(VirtualPictureGLTest, withoutWaitingTheSamePictureComes)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(1024, 1024, 6);
    const std::string store = build(levels);
    const auto waiting =
        virtuals::makeScene(virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f));
    const auto going = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f), "", false);
    for (const double height : {1.0, 9.0, 3.0})
    {
        const auto camera = lookFrom({0.0, -height, height});
        const auto expected = virtuals::settle(_viewer, *waiting, waiting, camera);
        const auto actual = virtuals::settle(_viewer, *going, going, camera);
        EXPECT_TRUE(Same(actual, expected, "virtual.going" + std::to_string(int(height))));
    }
    // At rest nothing is drawn for feedback.
    EXPECT_EQ(virtuals::countOf(*going, "feedback"), 0.0);
}

TEST_F(VirtualPictureGLTest, withoutFencesTheSamePictureComes)
{
    OSGKITS_NEED_GL(_viewer);
    const std::string store = build(virtuals::makeLevels(1024, 1024, 7));
    const auto waiting =
        virtuals::makeScene(virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f));
    const auto camera = lookFrom({0.0, -3.0, 3.0});
    const auto expected = virtuals::settle(_viewer, *waiting, waiting, camera);
    auto* gl = osg::GLExtensions::Get(
        _viewer.getViewer().getCamera()->getGraphicsContext()->getState()->getContextID(), true);
    const auto fence = gl->glFenceSync;
    ASSERT_TRUE(fence) << "no proof";
    gl->glFenceSync = nullptr;
    const auto going = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(store), 10.0f), "", false);
    const auto actual = virtuals::settle(_viewer, *going, going, camera);
    gl->glFenceSync = fence;
    EXPECT_TRUE(Same(actual, expected, "virtual.noFences"));
    EXPECT_GT(virtuals::countOf(*going, "pages.uploaded"), 20.0) << "no proof";
}

TEST_F(VirtualPictureGLTest, compressedPagesDifferByTheEncodersError)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(512, 512, 2);
    const auto plain = virtuals::makeFloor(virtuals::makePlainTexture(levels), 10.0f);
    for (const char* const settings : {"compression=blocks", "compression=best"})
    {
        const auto scene = virtuals::makeScene(
            virtuals::makeFloor(virtuals::makeVirtualTexture(build(levels)), 10.0f), settings);
        const auto camera = lookFrom({0.0, -2.0, 5.0});
        const auto expected = _viewer.render(plain, camera, 320, 240);
        const auto actual = virtuals::settle(_viewer, *scene, scene, camera);
        // The picture has noise of 32 steps, which four colours a block can't hold.
        const support::CompareImage alike{32.0 / 255.0, 0.01, 64.0 / 255.0};
        EXPECT_TRUE(alike(actual, expected, std::string("virtual.") + settings));
    }
}
