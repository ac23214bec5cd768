// SPDX-License-Identifier: MIT
#include <osgPagedTexture/FrameTimes.h>
#include <osgPagedTexture/UploadPace.h>

#include <gtest/gtest.h>

#include <limits>

namespace
{

using osgPagedTexture::FrameTimes;
using osgPagedTexture::UploadPace;

/// Milliseconds that frames take where uploads run at `rate` bytes a millisecond.
double worstFrame(UploadPace& pace, double rate, double budget, int frames)
{
    double worst = 0.0;
    for (int frame = 0; frame < frames; ++frame)
    {
        pace.begin(budget);
        while (const std::uint64_t bytes = pace.piece())
            pace.took(bytes, double(bytes) / rate);
        worst = std::max(worst, pace.getSpent());
    }
    return worst;
}

TEST(UploadPaceTest, framesStayWithinTheirTimeFromTheFirstOneOn)
{
    for (const double rate : {1e3, 1e4, 1e5, 1e6, 1e7})
    {
        UploadPace pace;
        EXPECT_LE(worstFrame(pace, rate, 2.0, 100), 2.0 + UploadPace::LeastPiece / rate) << rate;
    }
}

TEST(UploadPaceTest, mostOfTheTimeIsUsed)
{
    UploadPace pace;
    worstFrame(pace, 1e6, 2.0, 20);
    pace.begin(2.0);
    while (const std::uint64_t bytes = pace.piece())
        pace.took(bytes, double(bytes) / 1e6);
    EXPECT_GT(pace.getSpent(), 1.5);
}

TEST(UploadPaceTest, aFrameTakesAsManySmallTexturesAsItHasTimeFor)
{
    for (const double call : {0.005, 0.02, 0.2})
        for (const bool knowsLargeOnes : {false, true})
        {
            UploadPace pace;
            if (knowsLargeOnes)
                worstFrame(pace, 1e6, 0.3, 20);
            for (int frame = 0; frame < 5; ++frame)
            {
                pace.begin(0.3);
                while (pace.piece() > 0)
                    pace.took(700, call);
                EXPECT_LE(pace.getSpent(), 0.3);
                EXPECT_GE(pace.getSpent(), std::max(call, knowsLargeOnes ? 0.2 : 0.12));
            }
        }
}

TEST(UploadPaceTest, aDriverThatGetsSlowIsFollowedAtOnce)
{
    UploadPace pace;
    worstFrame(pace, 1e7, 2.0, 50);
    EXPECT_LE(worstFrame(pace, 1e6, 2.0, 1), 12.0);
    EXPECT_LE(worstFrame(pace, 1e6, 2.0, 10), 4.0);
}

TEST(UploadPaceTest, eachFrameGoesOnHoweverShortItsTimeIs)
{
    UploadPace pace;
    for (const double budget : {0.0, -1.0, 1e-9, std::numeric_limits<double>::quiet_NaN()})
    {
        pace.begin(budget);
        EXPECT_EQ(pace.piece(), UploadPace::LeastPiece);
        pace.took(pace.piece(), 0.1);
        EXPECT_EQ(pace.piece(), 0u);
    }
}

TEST(UploadPaceTest, whatElseUploadsDoKeepsNoFrameFromItsFirstPiece)
{
    UploadPace pace;
    for (int frame = 0; frame < 3; ++frame)
    {
        pace.begin(2.0);
        pace.took(0, 5.0);
        EXPECT_GE(pace.piece(), UploadPace::LeastPiece);
        pace.took(pace.piece(), 0.01);
        EXPECT_EQ(pace.piece(), 0u) << "5 ms are more than all";
    }
}

TEST(UploadPaceTest, timesThatAreNoNumbersChangeNothing)
{
    UploadPace pace;
    EXPECT_EQ(pace.getRate(), 0.0);
    pace.took(1000000, 1.0);
    const double rate = pace.getRate();
    pace.begin(2.0);
    for (const double time : {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(), 0.0, -1.0})
        pace.took(1000, time);
    EXPECT_EQ(pace.getRate(), rate);
    EXPECT_EQ(pace.getSpent(), 0.0);
    pace.begin(std::numeric_limits<double>::infinity());
    EXPECT_EQ(pace.piece(), UploadPace::LargestPiece);
}

TEST(FrameTimesTest, percentilesAreOfTheLastFrames)
{
    FrameTimes times(100);
    EXPECT_EQ(times.getPercentile(99.0), 0.0);
    for (int i = 1; i <= 250; ++i)
        times.add(i);
    times.add(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(times.getCount(), 100u);
    EXPECT_EQ(times.getPercentile(0.0), 151.0);
    EXPECT_EQ(times.getPercentile(50.0), 200.0);
    EXPECT_EQ(times.getPercentile(99.0), 249.0);
    EXPECT_EQ(times.getLargest(), 250.0);
    EXPECT_EQ(times.getValues().front(), 151.0);
    EXPECT_EQ(times.getValues().back(), 250.0);
}

} // namespace
