// SPDX-License-Identifier: MIT
#include <osgPagedTexture/EyeMotion.h>

#include <gtest/gtest.h>

#include <cmath>

using osgPagedTexture::EyeMotion;

namespace
{

constexpr double Pi = 3.14159265358979323846;

/// From the scene to an eye at `place` that looks along y, turned left by `angle`.
osg::Matrixd eyeAt(const osg::Vec3d& place, double angle)
{
    const osg::Vec3d ahead(-std::sin(angle), std::cos(angle), 0.0);
    return osg::Matrixd::lookAt(place, place + ahead, osg::Vec3d(0, 0, 1));
}

/// Largest difference of two matrices' elements.
double differenceOf(const osg::Matrixd& a, const osg::Matrixd& b)
{
    double difference = 0.0;
    for (int i = 0; i < 16; ++i)
        difference = std::max(difference, std::abs(a.ptr()[i] - b.ptr()[i]));
    return difference;
}

TEST(EyeMotionTest, anEyeThatFliesAndTurnsEvenlyIsWhereItWillBe)
{
    const osg::Vec3d velocity(3.0, 10.0, -1.0);
    const double turn = 0.5; // Radians a second.
    EyeMotion motion;
    for (int i = 0; i <= 120; ++i)
        motion.see(eyeAt(velocity * (i / 60.0), turn * i / 60.0), i / 60.0);
    for (const double seconds : {0.25, 1.0, 2.0})
    {
        const osg::Matrixd expected = eyeAt(velocity * (2.0 + seconds), turn * (2.0 + seconds));
        const osg::Matrixd now = eyeAt(velocity * 2.0, turn * 2.0);
        // exp(-20) of the first frame's rest is left in the mean.
        EXPECT_LT(differenceOf(now * motion.after(seconds), expected), 1e-5) << seconds;
    }
}

TEST(EyeMotionTest, anEyeAtRestIsStill)
{
    EyeMotion motion;
    EXPECT_TRUE(motion.isStill());
    for (int i = 0; i < 10; ++i)
        motion.see(eyeAt({1, 2, 3}, 0.7), i);
    EXPECT_TRUE(motion.isStill());
    EXPECT_EQ(motion.placeAfter(10.0), osg::Vec3d());
}

TEST(EyeMotionTest, aJumpIsForgottenWithinASecond)
{
    EyeMotion motion;
    for (int i = 0; i < 120; ++i)
        motion.see(eyeAt({i < 30 ? 0.0 : 1000.0, 0, 0}, 0.0), i / 60.0);
    EXPECT_LT(motion.placeAfter(1.0).length(), 0.1);
}

TEST(EyeMotionTest, noEyeTurnsFurtherThanBackwards)
{
    EyeMotion motion;
    for (int i = 0; i < 60; ++i)
        motion.see(eyeAt({}, 3.0 * i / 60.0), i / 60.0);
    // Half of a circle turns y of the scene, which was ahead, to behind.
    const osg::Matrixd turned = motion.after(100.0);
    EXPECT_NEAR(turned(0, 0), std::cos(Pi), 1e-6);
    EXPECT_NEAR(turned(1, 1), 1.0, 1e-6);
}

TEST(EyeMotionTest, timesThatDoNotGrowAreNoMotion)
{
    EyeMotion motion;
    for (int i = 0; i < 10; ++i)
        motion.see(eyeAt({double(i), 0, 0}, 0.1 * i), 5.0);
    EXPECT_TRUE(motion.isStill());
}

} // namespace
