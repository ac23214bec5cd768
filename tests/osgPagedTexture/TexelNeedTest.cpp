// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TexelNeed.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

using namespace osgPagedTexture;

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// A square of two units around the origin, facing z, with one whole texture on it.
TexelSurface square()
{
    TexelSurface surface;
    surface.low = {-1.0, -1.0, 0.0};
    surface.high = {1.0, 1.0, 0.0};
    surface.uvDensity = 0.25;
    surface.axis = {0.0, 0.0, 1.0};
    return surface;
}

TexelView viewFrom(double distance)
{
    TexelView view;
    view.toEye = glm::translate(glm::dmat4(1.0), {0.0, 0.0, -distance});
    view.pixelsX = view.pixelsY = 500.0;
    view.corner = 1.2;
    return view;
}

TEST(TexelNeedTest, aSurfaceFarAwayCoversThePixelsOfItsProjection)
{
    const double pixels = 1000.0 / 100.0; // Of a side of two units.
    EXPECT_NEAR(pixelsOfTexture(square(), viewFrom(100.0)), pixels * pixels, 0.1 * pixels * pixels);
}

TEST(TexelNeedTest, twiceTheDistanceIsOneLevel)
{
    const TexelTexture texture{1024, 1024};
    const double nearer = neededLevel(texture, pixelsOfTexture(square(), viewFrom(100.0)));
    const double farther = neededLevel(texture, pixelsOfTexture(square(), viewFrom(200.0)));
    EXPECT_NEAR(farther - nearer, 1.0, 0.05);
}

TEST(TexelNeedTest, aSurfaceSeenFromTheEdgeNeedsLess)
{
    TexelView view = viewFrom(100.0);
    view.toEye = view.toEye * glm::rotate(glm::dmat4(1.0), 1.4, {1.0, 0.0, 0.0});
    EXPECT_LT(pixelsOfTexture(square(), view), 0.3 * pixelsOfTexture(square(), viewFrom(100.0)));
}

TEST(TexelNeedTest, aSurfaceWithTheEyeInItNeedsAll)
{
    EXPECT_EQ(pixelsOfTexture(square(), viewFrom(0.0)), Infinity);
    EXPECT_EQ(neededLevel({8192, 8192}, Infinity), 0.0);
}

TEST(TexelNeedTest, whereTheEyeWillBeCounts)
{
    TexelView view = viewFrom(100.0);
    view.moved = {0.0, 0.0, -50.0};
    EXPECT_NEAR(pixelsOfTexture(square(), view), pixelsOfTexture(square(), viewFrom(50.0)), 1e-9);
}

TEST(TexelNeedTest, parallelRaysKnowNoDistance)
{
    TexelView view = viewFrom(3.0);
    view.isParallel = true;
    view.pixelsX = view.pixelsY = 10.0;
    EXPECT_NEAR(pixelsOfTexture(square(), view), 400.0, 1e-9);
    view.toEye = glm::scale(view.toEye, glm::dvec3(2.0));
    EXPECT_NEAR(pixelsOfTexture(square(), view), 1600.0, 1e-9);
}

TEST(TexelNeedTest, anisotropyAndBiasShiftTheLevel)
{
    EXPECT_NEAR(neededLevel({1024, 1024}, 64.0 * 64.0), 4.0, 1e-12);
    EXPECT_NEAR(neededLevel({1024, 1024, 16.0}, 64.0 * 64.0), 2.0, 1e-12);
    EXPECT_NEAR(neededLevel({1024, 1024, 1.0, 1.5}, 64.0 * 64.0), 5.5, 1e-12);
}

TEST(TexelNeedTest, extremeTexturesAndPixelsGiveALevelThatThereIs)
{
    for (const int width : {0, 1, 2, 3, 16384})
        for (const int height : {1, 16384})
            for (const double pixels : {0.0, 1e-300, 1.0, 1e300, Infinity, NaN})
            {
                const double level = neededLevel({width, height}, pixels);
                EXPECT_GE(level, 0.0);
                EXPECT_LE(level, 14.0);
            }
}

TEST(TexelNeedTest, whatIsNotKnownNeedsAll)
{
    TexelSurface surface = square();
    for (const double density : {0.0, -1.0, NaN, Infinity})
    {
        surface.uvDensity = density;
        EXPECT_EQ(pixelsOfTexture(surface, viewFrom(100.0)), Infinity) << density;
    }
    surface = square();
    surface.high.x = -2.0;
    EXPECT_EQ(pixelsOfTexture(surface, viewFrom(100.0)), Infinity);
    TexelView view = viewFrom(100.0);
    view.toEye[0][0] = NaN;
    EXPECT_EQ(pixelsOfTexture(square(), view), Infinity);
}

/// The truth by small areas: no point of a surface covers more than the bound.
TEST(TexelNeedTest, noPatchOfARandomSurfaceCoversMoreThanTheBound)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int seen = 0;
    for (int round = 0; round < 20000; ++round)
    {
        TexelSurface surface = square();
        surface.low = {-2.0, -1.0, -0.5};
        surface.high = {2.0, 1.0, 0.5};
        surface.axis = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        TexelView view = viewFrom(0.0);
        const double scale = std::exp2(4.0 * unit(random));
        view.toEye = glm::translate(glm::dmat4(1.0), {8.0 * unit(random), 8.0 * unit(random),
                                                      -8.0 + 7.0 * unit(random)}) *
                     glm::rotate(glm::dmat4(1.0), 4.0 * unit(random),
                                 glm::dvec3(unit(random), unit(random), 1.1)) *
                     glm::scale(glm::dmat4(1.0), glm::dvec3(scale));
        view.corner = 1.5;
        const glm::dvec3 place(2.0 * unit(random), unit(random), 0.5 * unit(random));
        const glm::dvec3 eye(view.toEye * glm::dvec4(place, 1.0));
        if (eye.z > -0.01 || glm::length(eye) > view.corner * -eye.z)
            continue; // Not in view.
        ++seen;
        const glm::dvec3 normal =
            glm::normalize(glm::dmat3(view.toEye) * surface.axis); // Uniform scale.
        const double truth = scale * scale * 500.0 * 500.0 * std::abs(glm::dot(normal, eye)) /
                             std::pow(-eye.z, 3.0) / surface.uvDensity;
        EXPECT_GE(pixelsOfTexture(surface, view), truth * (1.0 - 1e-9));
    }
    EXPECT_GT(seen, 1000);
}

} // namespace
