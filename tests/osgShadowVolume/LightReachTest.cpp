// SPDX-License-Identifier: MIT
#include "RandomLights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using osgShadowVolume::attenuationAt;
using osgShadowVolume::brightness;
using osgShadowVolume::EyeLight;
using osgShadowVolume::reaches;
using osgShadowVolume::reachOf;
using osgShadowVolume::thresholdFor;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
const double NotANumber = std::numeric_limits<double>::quiet_NaN();

/// Whether a point lies in the cone of a spot, as a fragment decides it.
bool isInCone(const EyeLight& light, const glm::dvec3& point)
{
    if (light.type != EyeLight::Spot)
        return true;
    const glm::dvec3 d = point - light.position;
    return glm::dot(d, light.spotDirection) >=
           glm::length(d) * std::cos(glm::radians(double(light.spotCutoffDegrees)));
}

/// What the light changes at a point, at most.
double share(const EyeLight& light, const glm::dvec3& point)
{
    if (light.type == EyeLight::Directional)
        return brightness(light);
    return isInCone(light, point)
               ? brightness(light) * attenuationAt(light, glm::length(point - light.position))
               : 0.0;
}

EyeLight pointLight(float constant, float linear, float quadratic)
{
    EyeLight light;
    light.type = EyeLight::Point;
    light.diffuse = glm::vec3(1.0f);
    light.constantAttenuation = constant;
    light.linearAttenuation = linear;
    light.quadraticAttenuation = quadratic;
    return light;
}

} // namespace

TEST(LightReach, isTheDistanceAtWhichTheLightAddsTheThreshold)
{
    RandomLights random(1);
    unsigned int finite = 0;
    for (int i = 0; i < 20000; ++i)
    {
        EyeLight light = random.light(glm::dvec3(-10.0), glm::dvec3(10.0));
        light.type = EyeLight::Point;
        const double threshold = random.scale(1e-6, 1.0);
        const double reach = reachOf(light, threshold);
        if (reach == 0.0)
        {
            EXPECT_LE(share(light, light.position), threshold * (1.0 + 1e-6)) << i;
            continue;
        }
        if (!std::isfinite(reach))
            continue;
        ++finite;
        const double there = brightness(light) * attenuationAt(light, reach);
        EXPECT_NEAR(there / threshold, 1.0, 1e-6) << i;
    }
    EXPECT_GT(finite, 5000u);
}

TEST(LightReach, noPointThatGetsMoreThanTheThresholdIsOutOfReach)
{
    RandomLights random(2);
    const glm::dvec3 low(-20.0), high(20.0);
    unsigned int lit = 0, left = 0;
    for (int i = 0; i < 200000; ++i)
    {
        const EyeLight light = random.light(low, high);
        const double threshold = random.scale(1e-5, 1.0);
        const double reach = reachOf(light, threshold);
        // A point of the sphere, in its inside or on its surface.
        const glm::dvec3 center = random.point(low, high);
        const double radius = random.below(10) ? random.scale(1e-6, 20.0) : 0.0;
        const double depth = random.below(2) ? 1.0 : random.uniform(0.0, 1.0);
        const glm::dvec3 point = center + random.direction() * radius * depth;
        const bool reached = reaches(light, reach, center, radius);
        left += !reached;
        if (share(light, point) > threshold * (1.0 + 1e-9))
        {
            ++lit;
            ASSERT_TRUE(reached) << "case " << i << ", type " << int(light.type) << ", reach "
                                 << reach << ", distance " << glm::length(center - light.position)
                                 << ", radius " << radius;
        }
    }
    EXPECT_GT(lit, 20000u);
    EXPECT_GT(left, 20000u) << "a test that always says yes proves nothing";
}

TEST(LightReach, farFromTheOriginNothingChanges)
{
    RandomLights random(3);
    const glm::dvec3 low(1e7), high(1e7 + 40.0);
    int lit = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const EyeLight light = random.light(low, high);
        const double threshold = random.scale(1e-5, 1.0);
        const glm::dvec3 center = random.point(low, high);
        const double radius = random.scale(1e-3, 20.0);
        const glm::dvec3 point = center + random.direction() * radius * 0.999999;
        // Doubles hold 1e7 to 2e-9: points that close to the edge are either.
        if (share(light, point) > threshold * 1.0001)
        {
            ASSERT_TRUE(reaches(light, reachOf(light, threshold), center, radius)) << i;
            ++lit;
        }
    }
    EXPECT_GT(lit, 1000);
}

TEST(LightReach, withoutAttenuationOrWithoutAThresholdItIsEndless)
{
    EXPECT_EQ(reachOf(pointLight(1, 0, 0), 0.01), Infinity);
    EXPECT_EQ(reachOf(pointLight(0, 0, 0), 0.01), Infinity);
    EXPECT_EQ(reachOf(pointLight(1, 1, 1), 0.0), Infinity);
    EXPECT_EQ(reachOf(pointLight(1, 1, 1), -1.0), Infinity);
    EXPECT_EQ(reachOf(EyeLight{}, 0.01), 0.0) << "a black light";
    EyeLight sun;
    sun.diffuse = glm::vec3(1e-6f);
    EXPECT_EQ(reachOf(sun, 0.01), Infinity);
}

TEST(LightReach, knownValues)
{
    EXPECT_NEAR(reachOf(pointLight(0, 1, 0), 0.01), 100.0, 1e-9);
    EXPECT_NEAR(reachOf(pointLight(0, 0, 1), 0.01), 10.0, 1e-9);
    EXPECT_NEAR(reachOf(pointLight(1, 0, 1), 1.0 / 101.0), 10.0, 1e-9);
    EXPECT_EQ(reachOf(pointLight(200, 1, 1), 0.01), 0.0) << "it never adds that much";
    EXPECT_NEAR(reachOf(pointLight(0, 1, 1e-30f), 0.01), 100.0, 1e-9);
}

TEST(LightReach, whatIsNotANumberReachesEverything)
{
    EXPECT_EQ(reachOf(pointLight(1, float(NotANumber), 0), 0.01), Infinity);
    EXPECT_EQ(reachOf(pointLight(1, 0, float(NotANumber)), 0.01), Infinity);
    EXPECT_EQ(reachOf(pointLight(1, 1, 1), NotANumber), Infinity);
    EXPECT_FALSE(reachOf(pointLight(float(NotANumber), 1, 0), 0.01) < 1e300);
    EXPECT_FALSE(reachOf(pointLight(float(NotANumber), 1, 1), 0.01) < 1e300);
    EyeLight light = pointLight(1, 1, 1);
    light.diffuse.y = float(NotANumber);
    EXPECT_TRUE(reaches(light, reachOf(light, 0.01), glm::dvec3(1e9), 1.0));
}

TEST(LightReach, infiniteParametersGiveAnAnswer)
{
    EXPECT_EQ(attenuationAt(pointLight(0, 0, 0), 5.0), 1e30);
    EXPECT_EQ(attenuationAt(pointLight(-1, 0, 0), 5.0), 1e30);
    EXPECT_EQ(attenuationAt(pointLight(0, 1, 0), 0.0), 1e30);
    EXPECT_EQ(attenuationAt(pointLight(float(Infinity), 1, 0), 1.0), 0.0);
    EXPECT_EQ(reachOf(pointLight(float(Infinity), 1, 1), 0.01), 0.0);
    EyeLight bright = pointLight(1, 1, 1);
    bright.diffuse = glm::vec3(float(Infinity));
    EXPECT_EQ(reachOf(bright, 0.01), Infinity);
}

TEST(LightReach, aLightThatTakesAwayCountsLikeOneThatAdds)
{
    EyeLight light = pointLight(1, 0, 1);
    light.diffuse = glm::vec3(-1.0f, 0.0f, 0.0f);
    EXPECT_EQ(brightness(light), 1.0);
    EXPECT_GT(reachOf(light, 0.01), 9.0);
}

TEST(LightReach, aConeIsTestedAgainstTheWholeSphere)
{
    EyeLight spot = pointLight(1, 0, 0);
    spot.type = EyeLight::Spot;
    spot.spotDirection = {0.0, 0.0, -1.0};
    spot.spotCutoffDegrees = 10.0f;
    EXPECT_TRUE(reaches(spot, Infinity, {0.0, 0.0, -10.0}, 0.0));
    EXPECT_FALSE(reaches(spot, Infinity, {0.0, 0.0, 10.0}, 1.0)) << "behind it";
    EXPECT_FALSE(reaches(spot, Infinity, {5.0, 0.0, -10.0}, 1.0)) << "beside the cone";
    EXPECT_TRUE(reaches(spot, Infinity, {5.0, 0.0, -10.0}, 4.0)) << "the sphere touches the cone";
    EXPECT_TRUE(reaches(spot, Infinity, {0.0, 0.0, 10.0}, 11.0)) << "the light is in the sphere";
    spot.spotCutoffDegrees = 0.0f;
    EXPECT_TRUE(reaches(spot, Infinity, {0.0, 0.0, -10.0}, 0.0)) << "a cone of one line";
}

TEST(LightThreshold, whatLiesBeyondItsReachStaysWithinTheBudgetAtThePoints)
{
    RandomLights random(4);
    int leaving = 0;
    for (int round = 0; round < 50; ++round)
    {
        const glm::dvec3 low(-50.0), high(50.0);
        std::vector<EyeLight> lights(1 + random.below(3000));
        for (EyeLight& light : lights)
            light = random.light(low, high);
        std::vector<glm::dvec3> points(1 + random.below(32));
        for (glm::dvec3& point : points)
            point = random.point(low, high);
        const double budget = random.scale(1e-4, 1.0);
        const double threshold = thresholdFor(lights, points, budget);
        ASSERT_GE(threshold, 0.0);
        for (const glm::dvec3& point : points)
        {
            double left = 0.0;
            for (const EyeLight& light : lights)
                if (!reaches(light, reachOf(light, threshold), point, 0.0))
                    left += share(light, point);
            ASSERT_LE(left, budget * (1.0 + 1e-9)) << "round " << round;
            leaving += left > 0.0;
        }
    }
    EXPECT_GT(leaving, 100) << "or nothing is left out";
}

TEST(LightThreshold, largeNumbersOfLightsAreSampled)
{
    RandomLights random(5);
    std::vector<EyeLight> lights(65536);
    for (EyeLight& light : lights)
    {
        light = random.light(glm::dvec3(-50.0), glm::dvec3(50.0));
        light.type = EyeLight::Point;
        light.quadraticAttenuation = 10.0f;
    }
    std::vector<glm::dvec3> points(16);
    for (glm::dvec3& point : points)
        point = random.point(glm::dvec3(-50.0), glm::dvec3(50.0));
    const double budget = 0.5 / 255.0;
    const double threshold = thresholdFor(lights, points, budget);
    EXPECT_GT(threshold, 0.0);
    for (const glm::dvec3& point : points)
    {
        double left = 0.0;
        for (const EyeLight& light : lights)
            if (!reaches(light, reachOf(light, threshold), point, 0.0))
                left += share(light, point);
        // A sample of 1 in 16 knows the sum to some percent.
        EXPECT_LE(left, budget * 1.25);
    }
}

TEST(LightThreshold, nothingMayBeLeftOutWithoutPoints)
{
    EXPECT_EQ(thresholdFor({pointLight(1, 1, 1)}, {}, 0.01), 0.0);
    EXPECT_EQ(thresholdFor({}, {glm::dvec3(0.0)}, 0.01), 0.0);
    EXPECT_EQ(thresholdFor({pointLight(1, 1, 1)}, {glm::dvec3(0.0)}, 0.0),
              thresholdFor({pointLight(1, 1, 1)}, {glm::dvec3(0.0)}, 0.0));
}
