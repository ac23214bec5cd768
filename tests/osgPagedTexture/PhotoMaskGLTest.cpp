// SPDX-License-Identifier: MIT
#include "ExactMask.h"
#include "PhotoMeshes.h"

#include <osgPagedTexture/ModelPhotos.h>
#include <osgPagedTexture/PhotoMask.h>

#include <support/HeadlessViewer.h>
#include <support/InventorModels.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

using namespace osgPagedTexture;

namespace
{

MaskRenderer& renderer()
{
    // Made once: programs are compiled once. Never destroyed, as a context in static storage would
    // be closed after its driver.
    static MaskRenderer* const made =
        new MaskRenderer(*[]
                         {
                             osg::ref_ptr<osg::GraphicsContext> context = makeOffscreenContext();
                             return context.release();
                         }());
    return *made;
}

bool hasGL(std::string& error)
{
    try
    {
        renderer();
        return true;
    }
    catch (const MaskError& failure)
    {
        error = failure.what();
        return false;
    }
}

class PhotoMaskGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        std::string error;
        if (hasGL(error))
            return;
        if (support::isGLRequired())
            FAIL() << error;
        GTEST_SKIP() << "NOT TESTED: " << error;
    }

    static ExactMask::Difference check(const Photo& photo, const MaskSettings& settings = {})
    {
        const PhotoMask mask = renderer().render(photo, settings);
        EXPECT_NO_GL_ERRORS();
        const ExactMask::Difference difference = ExactMask(photo).compare(mask.pixels);
        EXPECT_EQ(difference.wrong, 0u);
        // Floats and the grid of 1/256 of a pixel: far fewer than the pixels so near to an edge.
        EXPECT_LE(difference.atEdges, difference.edges);
        return difference;
    }

    static PhotoSurface triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c, PhotoWrap wrap)
    {
        PhotoSurface surface;
        surface.wrapS = surface.wrapT = wrap;
        surface.coordinates = {a, b, c};
        return surface;
    }
};

TEST_F(PhotoMaskGLTest, aMillionTrianglesAreThePixelsOfAnExactRasterizer)
{
    const Photo photo = photoOf(4064, 2704, jitteredGrid(1000, 667, 0.75));
    ASSERT_GT(photo.surfaces[0].coordinates.size(), 3000000u);
    const ExactMask::Difference difference = check(photo);
    EXPECT_GT(difference.used, 4064u * 2704u / 2);
    RecordProperty("used", std::to_string(difference.used));
    RecordProperty("withinReachOfAnEdge", std::to_string(difference.edges));
    RecordProperty("differentThere", std::to_string(difference.atEdges));
    std::printf("%zu used, %zu within 1/256 of an edge, %zu of them differ\n", difference.used,
                difference.edges, difference.atEdges);
}

TEST_F(PhotoMaskGLTest, trianglesThatShareEdgesLeaveNoGap)
{
    const PhotoMask mask = renderer().render(photoOf(997, 613, jitteredGrid(300, 200, 1.1)));
    EXPECT_EQ(mask.usedShare, 1.0);
}

TEST_F(PhotoMaskGLTest, piecesMakeTheSameMaskAsOneDrawing)
{
    const Photo photo = photoOf(1000, 700, jitteredGrid(30, 20, 0.5));
    MaskSettings settings;
    settings.largestPiece = 173;
    check(photo, settings);
    for (bool conservative : {false, true})
    {
        settings.conservative = conservative;
        settings.largestPiece = 173;
        const PhotoMask pieces = renderer().render(photo, settings);
        settings.largestPiece = 0;
        const PhotoMask whole = renderer().render(photo, settings);
        std::size_t different = 0;
        for (std::size_t i = 0; i < whole.pixels.bytes.size(); ++i)
            different += whole.pixels.bytes[i] != pieces.pixels.bytes[i];
        // Coordinates from another middle are rounded to other floats: pixels at edges.
        EXPECT_LE(different, 1000u * 700u / 10000u) << conservative;
    }
}

TEST_F(PhotoMaskGLTest, aPictureBeyondTheLargestViewportIsWhole)
{
    const PhotoMask mask = renderer().render(photoOf(60000, 3, jitteredGrid(500, 2, 1.1)));
    EXPECT_EQ(mask.pixels.width, 60000);
    EXPECT_EQ(mask.usedShare, 1.0);
    check(photoOf(40000, 30, jitteredGrid(500, 2, 0.5)));
}

TEST_F(PhotoMaskGLTest, repeatsAndNegativeCoordinatesFallBackIntoThePhotograph)
{
    for (PhotoWrap wrap : {PhotoWrap::Repeat, PhotoWrap::Mirror})
    {
        check(photoOf(640, 480, triangle({-0.3f, 0.2f}, {0.4f, 0.3f}, {0.1f, 0.6f}, wrap)));
        check(photoOf(640, 480, triangle({2.6f, -3.7f}, {3.4f, -3.2f}, {2.9f, -2.9f}, wrap)));
        check(photoOf(640, 480, triangle({-2.0f, -2.0f}, {1.0f, -1.9f}, {-1.0f, -1.2f}, wrap)));
    }
    const PhotoMask mask = renderer().render(
        photoOf(64, 48, triangle({-9.0f, -9.0f}, {9.0f, -9.0f}, {0.0f, 9.0f}, PhotoWrap::Repeat)));
    EXPECT_EQ(mask.usedShare, 1.0);
    EXPECT_EQ(mask.whole, 1u);
}

TEST_F(PhotoMaskGLTest, clampedCoordinatesUseThePixelsOfTheEdge)
{
    check(photoOf(64, 48, triangle({-0.5f, 0.2f}, {0.4f, 0.3f}, {-0.1f, 0.9f}, PhotoWrap::Clamp)));
    check(photoOf(64, 48, triangle({0.5f, 0.5f}, {1.7f, 0.6f}, {1.2f, 1.9f}, PhotoWrap::Clamp)));
    const PhotoMask corner = renderer().render(
        photoOf(64, 48, triangle({2.0f, 2.0f}, {3.0f, 2.0f}, {2.0f, 3.0f}, PhotoWrap::Clamp)));
    EXPECT_EQ(corner.pixels.row(47)[63], 255);
    EXPECT_DOUBLE_EQ(corner.usedShare, 1.0 / (64 * 48));
}

TEST_F(PhotoMaskGLTest, coordinatesExactlyOnBordersCoverTheWholeAndNothingElse)
{
    PhotoSurface quad;
    quad.wrapS = quad.wrapT = PhotoWrap::Repeat;
    quad.coordinates = {{1, 1}, {2, 1}, {2, 2}, {1, 1}, {2, 2}, {1, 2}};
    EXPECT_EQ(renderer().render(photoOf(33, 21, quad)).usedShare, 1.0);

    PhotoSurface half;
    half.coordinates = {{0, 0}, {0.5f, 0}, {0.5f, 1}, {0, 0}, {0.5f, 1}, {0, 1}};
    const PhotoMask mask = renderer().render(photoOf(64, 64, half));
    EXPECT_EQ(mask.usedShare, 0.5);
    EXPECT_EQ(mask.pixels.row(5)[31], 255);
    EXPECT_EQ(mask.pixels.row(5)[32], 0);
}

TEST_F(PhotoMaskGLTest, hugeCoordinatesCountForTheWholePhotograph)
{
    for (float huge : {1e6f, 1e30f, std::numeric_limits<float>::max()})
    {
        const PhotoMask mask = renderer().render(
            photoOf(64, 48, triangle({0, 0}, {huge, 1.0f}, {-huge, 0.5f}, PhotoWrap::Repeat)));
        EXPECT_EQ(mask.usedShare, 1.0) << huge;
        EXPECT_EQ(mask.whole, 1u) << huge;
        // Clamped ones have one photograph only.
        const PhotoMask clamped = renderer().render(
            photoOf(64, 48, triangle({0, 0.25f}, {huge, 0.25f}, {huge, 0.75f}, PhotoWrap::Clamp)));
        EXPECT_EQ(clamped.whole, 0u);
        EXPECT_LT(clamped.usedShare, 0.1);
    }
}

TEST_F(PhotoMaskGLTest, everyTouchedPixelIsInAConservativeMask)
{
    Photo photo = photoOf(400, 300, jitteredGrid(90, 70, 0.3));
    // A needle without area, between two rows of pixels' middles.
    photo.surfaces.push_back(
        triangle({0.1f, 0.5f}, {0.9f, 0.501f}, {0.5f, 0.5005f}, PhotoWrap::Clamp));
    MaskSettings settings;
    settings.conservative = true;
    const PhotoMask mask = renderer().render(photo, settings);
    // Points of all triangles lie in pixels of the mask.
    std::vector<std::uint8_t> near(mask.pixels.bytes.size());
    for (const PhotoSurface& surface : photo.surfaces)
    {
        for (std::size_t i = 0; i < surface.coordinates.size(); i += 3)
        {
            for (int sample = 0; sample < 66 * 66; ++sample)
            {
                const double a = (sample % 66) / 65.0, b = (sample / 66) / 65.0 * (1.0 - a);
                const glm::dvec2 point = a * glm::dvec2(surface.coordinates[i]) +
                                         b * glm::dvec2(surface.coordinates[i + 1]) +
                                         (1.0 - a - b) * glm::dvec2(surface.coordinates[i + 2]);
                const int x = std::min(int(point.x * 400), 399);
                const int y = std::min(int(point.y * 300), 299);
                ASSERT_EQ(mask.pixels.row(y)[x], 255) << x << ", " << y;
                near[std::size_t(y) * 400 + std::size_t(x)] = 1;
            }
        }
    }
    // And nothing more, but for pixels that are touched between the points.
    std::size_t extra = 0;
    for (std::size_t i = 0; i < near.size(); ++i)
        extra += mask.pixels.bytes[i] != 0 && !near[i];
    EXPECT_LT(extra, near.size() / 100);
    EXPECT_GT(mask.usedShare, renderer().render(photo).usedShare);
}

TEST_F(PhotoMaskGLTest, aMarginGrowsTheMaskAndGoesAroundWhereThePhotographRepeats)
{
    PhotoSurface pixel;
    pixel.coordinates = {{0, 0.5f}, {0.1f, 0.5f}, {0.1f, 0.6f}, {0, 0.5f}, {0.1f, 0.6f}, {0, 0.6f}};
    MaskSettings settings;
    settings.margin = 2;
    PhotoMask mask = renderer().render(photoOf(10, 10, pixel), settings);
    EXPECT_DOUBLE_EQ(mask.usedShare, 3 * 5 / 100.0);
    pixel.wrapS = PhotoWrap::Repeat;
    mask = renderer().render(photoOf(10, 10, pixel), settings);
    EXPECT_DOUBLE_EQ(mask.usedShare, 5 * 5 / 100.0);
    EXPECT_EQ(mask.pixels.row(5)[8], 255);
    EXPECT_EQ(mask.pixels.row(5)[7], 0);
    settings.margin = 65536;
    EXPECT_EQ(renderer().render(photoOf(10, 10, pixel), settings).usedShare, 1.0);
}

class InventorMaskGLTest : public PhotoMaskGLTest, public testing::WithParamInterface<std::string>
{
};

TEST_P(InventorMaskGLTest, isThatOfAnExactRasterizer)
{
    const ModelPhotos model = readModelPhotos(GetParam());
    for (const Photo& photo : model.photos)
    {
        const ExactMask::Difference difference = check(photo);
        std::printf("%s: %d x %d, %zu used, %zu within 1/256 of an edge, %zu of them differ\n",
                    photo.name.c_str(), photo.width, photo.height, difference.used,
                    difference.edges, difference.atEdges);
    }
}

std::string caseName(const testing::TestParamInfo<std::string>& each)
{
    return support::inventorCaseName(each.param);
}

INSTANTIATE_TEST_SUITE_P(Models, InventorMaskGLTest, testing::ValuesIn(support::inventorModels()),
                         caseName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(InventorMaskGLTest);

} // namespace
