// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <osgPagedTexture/BlockFormat.h>
#include <osgPagedTexture/ImageFile.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <fstream>

using namespace osgPagedTexture;

namespace
{

DecodedImage readAt(const std::string& path, int reduction, bool linearLight = true)
{
    ReadSettings settings;
    settings.reduction = reduction;
    settings.linearLight = linearLight;
    return readImageFile(path, settings);
}

std::string fileText(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The picture that EXIF's orientation shows of a stored one, by the definition: which stored
/// corner is at the top left, and whether rows run down.
Pixels shown(const Pixels& stored, int orientation)
{
    const bool turned = orientation >= 5;
    Pixels result(turned ? stored.height : stored.width, turned ? stored.width : stored.height,
                  stored.channels);
    for (int y = 0; y < result.height; ++y)
    {
        for (int x = 0; x < result.width; ++x)
        {
            const int right = stored.width - 1, low = stored.height - 1;
            const int columns[] = {x, right - x, right - x, x, y, y, right - y, right - y};
            const int rows[] = {y, y, low - y, low - y, x, low - x, low - x, x};
            const int column = columns[orientation - 1], row = rows[orientation - 1];
            for (int c = 0; c < stored.channels; ++c)
            {
                result.row(result.height - 1 - y)[x * stored.channels + c] =
                    stored.row(low - row)[column * stored.channels + c];
            }
        }
    }
    return result;
}

} // namespace

class ImageFileTest : public testing::Test
{
protected:
    support::TemporaryFolder folder;
};

TEST_F(ImageFileTest, AJpegComesBackWithItsBottomRowFirst)
{
    const Pixels picture = samplePicture(200, 120, 3);
    const DecodedImage image = readImageFile(folder.write("a.jpg", encodeJpeg(picture)));
    EXPECT_FALSE(image.degraded) << image.warning;
    EXPECT_GT(psnr(image.pixels, picture), 35.0); // upside down it is 15
    EXPECT_EQ(image.fullWidth, 200);
    EXPECT_EQ(image.fullHeight, 120);
}

TEST_F(ImageFileTest, EveryOrientationIsShownAsExifDefinesIt)
{
    const Pixels picture = samplePicture(64, 40, 3);
    for (int orientation = 1; orientation <= 8; ++orientation)
    {
        JpegOptions options;
        options.orientation = orientation;
        const std::string path = folder.write("o.jpg", encodeJpeg(picture, options));
        const Pixels expected = shown(picture, orientation);
        EXPECT_GT(psnr(readImageFile(path).pixels, expected), 33.0) << orientation;
        EXPECT_GT(psnr(readAt(path, 2).pixels, boxMean(expected, 4, false)), 33.0) << orientation;
        const ImageInfo info = readImageInfo(path);
        EXPECT_EQ(info.width, expected.width) << orientation;
        EXPECT_EQ(info.height, expected.height) << orientation;
    }
}

TEST_F(ImageFileTest, AnOrientationBetweenTheScansOfAJpegDoesNotCount)
{
    const Pixels picture = samplePicture(64, 40, 3);
    JpegOptions options;
    options.orientation = 6;
    const std::string turned = encodeJpeg(picture, options);
    const std::size_t segment = turned.find("\xFF\xE1"), bytes = segment + 2;
    const std::size_t length = static_cast<unsigned char>(turned[bytes]) * 256 +
                               static_cast<unsigned char>(turned[bytes + 1]) + 2;
    options = {};
    options.progressive = true;
    std::string text = encodeJpeg(picture, options);
    const std::size_t second = text.find("\xFF\xDA", text.find("\xFF\xDA") + 2);
    ASSERT_NE(second, std::string::npos) << "no proof";
    text.insert(second, turned, segment, length);
    const std::string path = folder.write("late.jpg", text);
    EXPECT_EQ(readImageInfo(path).width, 64);
    const DecodedImage image = readImageFile(path);
    ASSERT_EQ(image.pixels.width, 64);
    EXPECT_GT(psnr(image.pixels, picture), 33.0);
}

TEST_F(ImageFileTest, AReducedPictureHasTheSizeOfItsMipLevel)
{
    for (int width : {1, 7, 8, 9, 100, 133})
    {
        const Pixels picture = samplePicture(width, 57, 3);
        const std::string jpeg = folder.write("a.jpg", encodeJpeg(picture));
        const std::string png = folder.file("a.png");
        writePicture(png, picture);
        for (int level = 0; level < levelCount(width, 57); ++level)
        {
            for (const std::string& path : {jpeg, png})
            {
                const Pixels pixels = readAt(path, level).pixels;
                EXPECT_EQ(pixels.width, levelSide(width, level)) << path << level;
                EXPECT_EQ(pixels.height, levelSide(57, level)) << path << level;
            }
        }
    }
}

TEST_F(ImageFileTest, AReducedJpegIsNearTheMeanOfItsPixels)
{
    const Pixels picture = samplePicture(256, 192, 3);
    const std::string path = folder.write("a.jpg", encodeJpeg(picture));
    for (int level = 1; level <= 5; ++level)
    {
        EXPECT_GT(psnr(readAt(path, level, false).pixels, boxMean(picture, 1 << level, false)),
                  38.0)
            << level;
    }
}

TEST_F(ImageFileTest, OddSizesKeepTheirPlace)
{
    // A ramp over the whole width: a column that were dropped or drawn in would shift it.
    Pixels ramp(1001, 9, 1);
    for (int i = 0; i < 1001 * 9; ++i)
    {
        ramp.bytes[i] = static_cast<std::uint8_t>(i % 1001 / 4);
    }
    const std::string jpeg = folder.write("a.jpg", encodeJpeg(ramp, {100}));
    writePicture(folder.file("a.png"), ramp);
    for (const std::string& path : {jpeg, folder.file("a.png")})
    {
        const Pixels pixels = readAt(path, 3, false).pixels;
        ASSERT_EQ(pixels.width, 125);
        for (int x = 0; x < 124; ++x) // the last holds less than a whole DCT block
        {
            EXPECT_NEAR(pixels.row(0)[x], (x + 0.5) * 1001 / 125 / 4 - 0.5, 1.0) << path << x;
        }
    }
}

TEST_F(ImageFileTest, OtherFilesAreAveragedInLinearLightOrPlain)
{
    const Pixels picture = samplePicture(96, 64, 3);
    for (const char* name : {"a.png", "a.tif", "a.bmp", "a.tga"})
    {
        writePicture(folder.file(name), picture);
        for (bool linear : {false, true})
        {
            // 1: sums are rounded in another order.
            EXPECT_LE(largestDifference(readAt(folder.file(name), 2, linear).pixels,
                                        boxMean(picture, 4, linear)),
                      1)
                << name << linear;
        }
        EXPECT_EQ(largestDifference(readImageFile(folder.file(name)).pixels, picture), 0) << name;
    }
}

TEST_F(ImageFileTest, TiledFilesReadAsScanLinesDo)
{
    const Pixels picture = samplePicture(150, 100, 4);
    writePicture(folder.file("a.tif"), picture, "uint8", true);
    EXPECT_EQ(largestDifference(readImageFile(folder.file("a.tif")).pixels, picture), 0);
}

TEST_F(ImageFileTest, TransparentTexelsLendNoColour)
{
    Pixels picture(2, 2, 4);
    picture.bytes = {255, 0, 0, 255, 0, 255, 0, 0, 0, 255, 0, 0, 255, 0, 0, 255};
    writePicture(folder.file("a.png"), picture);
    const std::vector<std::uint8_t> expected = {255, 0, 0, 128};
    EXPECT_EQ(readAt(folder.file("a.png"), 1).pixels.bytes, expected);
}

TEST_F(ImageFileTest, SixteenBitsBecomeEight)
{
    const Pixels picture = samplePicture(40, 30, 3);
    for (const char* name : {"a.png", "a.tif"})
    {
        writePicture(folder.file(name), picture, "uint16");
        EXPECT_EQ(largestDifference(readImageFile(folder.file(name)).pixels, picture), 0) << name;
    }
}

TEST_F(ImageFileTest, FloatingPointIsTakenAsLinearLight)
{
    Pixels picture(8, 8, 3);
    std::fill(picture.bytes.begin(), picture.bytes.end(), 64); // 0.251 of full light
    writePicture(folder.file("a.exr"), picture, "half");
    EXPECT_NEAR(readImageFile(folder.file("a.exr")).pixels.bytes[0], 137, 1);
}

TEST_F(ImageFileTest, GreyStaysOneChannel)
{
    const Pixels picture = samplePicture(50, 40, 1);
    const std::string path = folder.write("a.jpg", encodeJpeg(picture));
    EXPECT_GT(psnr(readImageFile(path).pixels, picture), 35.0);
    writePicture(folder.file("a.png"), picture);
    EXPECT_EQ(readImageInfo(folder.file("a.png")).channels, 1);
}

TEST_F(ImageFileTest, CmykBecomesRgbWithAndWithoutAdobesMarker)
{
    const Pixels picture = samplePicture(80, 64, 3);
    for (bool adobe : {true, false})
    {
        JpegOptions options;
        options.cmyk = true;
        options.adobe = adobe;
        const std::string path = folder.write("a.jpg", encodeJpeg(picture, options));
        EXPECT_GT(psnr(readImageFile(path).pixels, picture), 33.0) << adobe;
        EXPECT_EQ(readImageInfo(path).channels, 3);
    }
}

TEST_F(ImageFileTest, ProgressiveJpegsReadAsBaselineOnes)
{
    const Pixels picture = samplePicture(120, 90, 3);
    JpegOptions options;
    const Pixels plain = readImageFile(folder.write("a.jpg", encodeJpeg(picture, options))).pixels;
    options.progressive = true;
    const std::string path = folder.write("b.jpg", encodeJpeg(picture, options));
    EXPECT_EQ(largestDifference(readImageFile(path).pixels, plain), 0);
    EXPECT_EQ(readImageInfo(path).decoderBytes, 120u * 90 * 3 * 2);
}

TEST_F(ImageFileTest, TheContentTellsTheFormatNotTheExtension)
{
    const Pixels picture = samplePicture(32, 32, 3);
    folder.write("jpeg.png", encodeJpeg(picture));
    writePicture(folder.file("a.png"), picture);
    folder.write("png.jpg", fileText(folder.file("a.png")));
    EXPECT_EQ(readImageInfo(folder.file("jpeg.png")).format, "jpeg");
    EXPECT_EQ(readImageInfo(folder.file("png.jpg")).format, "png");
    EXPECT_EQ(largestDifference(readImageFile(folder.file("png.jpg")).pixels, picture), 0);
}

TEST_F(ImageFileTest, OnlyAlphaThatIsUsedMakesTranslucent)
{
    Pixels picture = samplePicture(30, 20, 4);
    for (std::size_t i = 3; i < picture.bytes.size(); i += 4)
    {
        picture.bytes[i] = 255;
    }
    writePicture(folder.file("a.png"), picture);
    EXPECT_FALSE(readImageInfo(folder.file("a.png")).translucent);
    picture.row(19)[4 * 29 + 3] = 254;
    writePicture(folder.file("a.png"), picture);
    EXPECT_TRUE(readImageInfo(folder.file("a.png")).translucent);
    EXPECT_FALSE(
        readImageInfo(folder.write("a.jpg", encodeJpeg(samplePicture(9, 9, 3)))).translucent);
}

TEST_F(ImageFileTest, APictureOfOneRowIsRead)
{
    const Pixels picture = samplePicture(16384, 1, 3);
    writePicture(folder.file("a.png"), picture);
    EXPECT_EQ(largestDifference(readImageFile(folder.file("a.png")).pixels, picture), 0);
    const std::string path = folder.write("a.jpg", encodeJpeg(picture));
    EXPECT_EQ(readAt(path, 14).pixels.width, 1);
}
