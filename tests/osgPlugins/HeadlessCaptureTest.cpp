// SPDX-License-Identifier: MIT
#include <osgPlugins/headless/Capture.h>

#include <gtest/gtest.h>

using osgHeadless::Capture;

TEST(HeadlessCaptureTest, firstWindowWritesTheFileItself)
{
    EXPECT_EQ(Capture::getFileName("dir.d/a.png", 0), "dir.d/a.png");
}

TEST(HeadlessCaptureTest, furtherWindowsPutTheirNumberBeforeTheExtension)
{
    EXPECT_EQ(Capture::getFileName("dir.d/a.png", 1), "dir.d/a_1.png");
    EXPECT_EQ(Capture::getFileName("a.b.png", 12), "a.b_12.png");
    EXPECT_EQ(Capture::getFileName("dir.d/a", 1), "dir.d/a_1");
}

TEST(HeadlessCaptureTest, percentDStandsForTheNumber)
{
    EXPECT_EQ(Capture::getFileName("a%d.png", 0), "a0.png");
    EXPECT_EQ(Capture::getFileName("a%03d.png", 7), "a007.png");
    EXPECT_EQ(Capture::getFileName("a%2dx.png", 123), "a123x.png");
}

TEST(HeadlessCaptureTest, otherPercentSignsAreOrdinary)
{
    EXPECT_EQ(Capture::getFileName("50%.png", 0), "50%.png");
    EXPECT_EQ(Capture::getFileName("%s%n.png", 1), "%s%n_1.png");
    EXPECT_EQ(Capture::getFileName("%99999999d.png", 0), "%99999999d.png");
}

TEST(HeadlessCaptureTest, numbersOfClosedWindowsAreUsedAgain)
{
    std::string error;
    {
        Capture first("/a/%d.png"), second("/a/%d.png");
        EXPECT_FALSE(second.write(error));
        EXPECT_NE(error.find("'/a/1.png'"), std::string::npos) << error;
    }
    Capture third("/a/%d.png");
    EXPECT_FALSE(third.write(error));
    EXPECT_EQ(error, "no frame was drawn, so '/a/0.png' is not written; let the viewer draw "
                     "(OSG_RUN_FRAME_COUNT of 1 or more)");
}
