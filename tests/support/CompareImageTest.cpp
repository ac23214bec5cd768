// SPDX-License-Identifier: MIT
#include <support/CompareImage.h>

#include <filesystem>
#include <limits>

namespace
{

osg::ref_ptr<osg::Image> gray(int width, int height, unsigned char value)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), value);
    return image;
}

} // namespace

using support::CompareImage;

TEST(CompareImage, equalPicturesPass)
{
    EXPECT_TRUE(CompareImage()(gray(8, 8, 7), gray(8, 8, 7), "equal"));
}

TEST(CompareImage, twoStepsEverywherePassThreeStepsDoNot)
{
    EXPECT_TRUE(CompareImage()(gray(8, 8, 12), gray(8, 8, 10), "twoSteps"));
    EXPECT_FALSE(CompareImage()(gray(8, 8, 13), gray(8, 8, 10), "threeSteps"));
}

TEST(CompareImage, onePixelInAThousandMayBeALittleOffButNotFarOff)
{
    osg::ref_ptr<osg::Image> image = gray(40, 25, 10);
    image->data(3, 4)[2] = 18;
    EXPECT_TRUE(CompareImage()(image, gray(40, 25, 10), "littleOff"));
    image->data(3, 4)[2] = 19;
    EXPECT_FALSE(CompareImage()(image, gray(40, 25, 10), "farOff"));
    image->data(3, 4)[2] = 18;
    image->data(5, 4)[0] = 18;
    EXPECT_FALSE(CompareImage()(image, gray(40, 25, 10), "twoOff"));
}

TEST(CompareImage, failureNamesTheWorstPixelAndWritesThreePictures)
{
    osg::ref_ptr<osg::Image> image = gray(8, 8, 10);
    image->data(3, 5)[1] = 110;
    const testing::AssertionResult result = CompareImage()(image, gray(8, 8, 10), "worstPixel");
    EXPECT_FALSE(result);
    const std::string message = result.message();
    EXPECT_NE(message.find("worst 100/255"), std::string::npos) << message;
    EXPECT_NE(message.find("at 3,5: (10 110 10 10) for (10 10 10 10)"), std::string::npos)
        << message;
    const std::string path = message.substr(message.rfind(' ') + 1);
    for (const char* kind : {"actual", "expected", "diff"})
    {
        std::string file = path;
        file.replace(file.find("actual"), 6, kind);
        EXPECT_TRUE(std::filesystem::remove(file)) << file;
    }
}

TEST(CompareImage, otherSizeAndMissingPictureAreFailures)
{
    EXPECT_FALSE(CompareImage()(gray(8, 8, 0), gray(8, 9, 0), "size"));
    EXPECT_FALSE(CompareImage()(nullptr, gray(8, 9, 0), "missing"));
}

TEST(CompareImage, floatsAreComparedUnclampedAndNotANumberIsFarOff)
{
    osg::ref_ptr<osg::Image> a = new osg::Image, b = new osg::Image;
    for (osg::Image* image : {a.get(), b.get()})
    {
        image->allocateImage(2, 1, 1, GL_RGBA, GL_FLOAT);
        std::fill_n(reinterpret_cast<float*>(image->data()), 8, 3.0f);
    }
    EXPECT_TRUE(CompareImage()(a, b, "floats"));
    reinterpret_cast<float*>(a->data())[5] = 4.0f;
    EXPECT_FALSE(CompareImage()(a, b, "floatsOff"));
    reinterpret_cast<float*>(a->data())[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(CompareImage()(a, b, "notANumber"));
}
