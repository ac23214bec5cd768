// SPDX-License-Identifier: MIT
#include "RandomLights.h"

#include <osgShadowVolume/LightScreen.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using osgShadowVolume::EyeLight;
using osgShadowVolume::EyeSphere;
using osgShadowVolume::hidesItsShadows;
using osgShadowVolume::ScreenBounds;
using osgShadowVolume::screenBounds;
using osgShadowVolume::sphereOf;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
const glm::dvec4 Viewport(10, 20, 640, 480);

glm::dmat4 randomProjection(RandomLights& random)
{
    const double near = random.scale(1e-2, 5.0), far = near * random.scale(2.0, 1e5);
    double left = random.uniform(-2.0, 0.5), right = left + random.scale(0.1, 3.0);
    const double bottom = random.uniform(-2.0, 0.5), top = bottom + random.scale(0.1, 3.0);
    if (random.below(4) == 0)
        std::swap(left, right); // mirrored
    if (random.below(3) == 0)
        return glm::ortho(10 * left, 10 * right, 10 * bottom, 10 * top, near - 5.0, far);
    return glm::frustum(near * left, near * right, near * bottom, near * top, near, far);
}

/// Window coordinates of a point; false where it is not shown.
bool toWindow(const glm::dvec3& point, const glm::dmat4& projection, glm::dvec3& window)
{
    const glm::dvec4 clip = projection * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0) || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w ||
        std::abs(clip.z) > clip.w)
        return false;
    const glm::dvec3 half = 0.5 * (glm::dvec3(clip) / clip.w + 1.0);
    window = {Viewport.x + half.x * Viewport.z, Viewport.y + half.y * Viewport.w, half.z};
    return true;
}

EyeLight positional(const glm::dvec3& position)
{
    EyeLight light;
    light.type = EyeLight::Point;
    light.position = position;
    return light;
}

} // namespace

TEST(LightScreen, eachPointOfTheSphereThatShowsLiesInTheRectangleAndInItsDepths)
{
    RandomLights random(1);
    unsigned int shown = 0, nowhere = 0, partly = 0;
    for (int i = 0; i < 40000; ++i)
    {
        const glm::dmat4 projection = randomProjection(random);
        glm::dvec3 way = random.direction();
        if (random.below(4))
            way = glm::normalize(glm::dvec3(way.x, way.y, -2.0));
        const double distance = random.scale(0.01, 100.0);
        const EyeSphere sphere{way * distance, distance * random.scale(0.01, 5.0)};
        const auto bounds = screenBounds(sphere, projection, Viewport);
        nowhere += !bounds;
        partly += bounds && bounds->width < 640;
        for (int j = 0; j < 100; ++j)
        {
            const double depth = random.below(2) ? 1.0 : random.uniform(0.0, 1.0);
            const glm::dvec3 point = sphere.center + random.direction() * sphere.radius * depth;
            glm::dvec3 window;
            if (!toWindow(point, projection, window))
                continue;
            ++shown;
            ASSERT_TRUE(bounds) << i;
            ASSERT_GE(window.x, bounds->x) << i;
            ASSERT_LE(window.x, bounds->x + bounds->width) << i;
            ASSERT_GE(window.y, bounds->y) << i;
            ASSERT_LE(window.y, bounds->y + bounds->height) << i;
            ASSERT_GE(window.z, bounds->nearDepth) << i;
            ASSERT_LE(window.z, bounds->farDepth) << i;
        }
    }
    EXPECT_GT(shown, 100000u);
    EXPECT_GT(nowhere, 10000u) << "a rectangle that always covers all proves nothing";
    EXPECT_GT(partly, 2000u);
}

TEST(LightScreen, theRectangleIsTight)
{
    RandomLights random(2);
    double area = 0.0, sampled = 0.0;
    for (int i = 0; i < 1000; ++i)
    {
        const glm::dmat4 projection = randomProjection(random);
        const EyeSphere sphere{random.direction() * random.scale(0.1, 20.0),
                               random.scale(0.1, 20.0)};
        glm::dvec3 low(1e9), high(-1e9);
        bool any = false;
        for (int j = 0; j < 20000; ++j)
        {
            glm::dvec3 window;
            const double depth = random.below(4) ? 1.0 : random.uniform(0.0, 1.0);
            if (!toWindow(sphere.center + random.direction() * sphere.radius * depth, projection,
                          window))
                continue;
            any = true;
            low = glm::min(low, window);
            high = glm::max(high, window);
        }
        const auto bounds = screenBounds(sphere, projection, Viewport);
        if (!any)
            continue;
        ASSERT_TRUE(bounds);
        area += double(bounds->width) * bounds->height;
        sampled += (high.x - low.x) * (high.y - low.y);
    }
    std::printf("[ area     ] %.1f %% of what samples of the spheres cover\n",
                100.0 * area / sampled);
    // Each axis is bounded for itself and samples miss the rim; twice the area would be a mistake.
    EXPECT_LT(area / sampled, 1.3);
}

TEST(LightScreen, knownRectangles)
{
    const glm::dmat4 projection = glm::frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0);
    const glm::dvec4 viewport(0, 0, 200, 100);
    // From the eye a sphere of radius 6 at a distance of 10 has the slope 6 / 8.
    const auto bounds = screenBounds({{0, 0, -10}, 6.0}, projection, viewport);
    ASSERT_TRUE(bounds);
    EXPECT_EQ(bounds->x, 100 - 75 - 1);
    EXPECT_EQ(bounds->width, 2 * 76);
    EXPECT_EQ(bounds->y, 50 - 38 - 1) << "37.5, to the next pixel outwards";
    EXPECT_EQ(bounds->height, 2 * 39);
    const double depthAt4 = 0.5 * (1.0 + (101.0 / 99.0) - 200.0 / 99.0 / 4.0);
    EXPECT_NEAR(bounds->nearDepth, depthAt4, 5e-6);
    EXPECT_FALSE(screenBounds({{0, 0, 10}, 6.0}, projection, viewport)) << "behind the eye";
    EXPECT_FALSE(screenBounds({{0, 0, -200}, 6.0}, projection, viewport)) << "beyond the far plane";
    EXPECT_FALSE(screenBounds({{30, 0, -10}, 6.0}, projection, viewport)) << "beside";
    const auto around = screenBounds({{0, 0, 0}, 6.0}, projection, viewport);
    ASSERT_TRUE(around);
    EXPECT_EQ(around->width, 200);
    EXPECT_LT(around->farDepth, 0.95) << "the depth is bounded even so";
}

TEST(LightScreen, whatIsNotFiniteOrHasNoNearPlaneCoversTheViewport)
{
    const glm::dmat4 projection = glm::frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0);
    const auto coversAll = [](const std::optional<ScreenBounds>& bounds)
    { return bounds && bounds->x == 10 && bounds->width == 640 && bounds->height == 480; };
    EXPECT_TRUE(coversAll(screenBounds({{0, 0, -10}, Infinity}, projection, Viewport)));
    EXPECT_TRUE(coversAll(screenBounds({{NAN, 0, -10}, 1.0}, projection, Viewport)));
    EXPECT_TRUE(coversAll(screenBounds({{0, 0, -10}, NAN}, projection, Viewport)));
    EXPECT_TRUE(coversAll(screenBounds({{0, 0, -10}, 1.0}, glm::dmat4(NAN), Viewport)));
    glm::dmat4 atTheEye = projection; // near = 0
    atTheEye[2][2] = -1.0;
    atTheEye[3][2] = 0.0;
    EXPECT_TRUE(coversAll(screenBounds({{0, 0, -10}, 1.0}, atTheEye, Viewport)));
    glm::dmat4 oblique = projection; // a near plane that is not at right angles to the view
    oblique[0][2] = 0.3;
    EXPECT_TRUE(coversAll(screenBounds({{0, 0, -10}, 1.0}, oblique, Viewport)));
}

TEST(LightScreen, theSphereOfALightHoldsAllThatItLights)
{
    RandomLights random(3);
    for (int i = 0; i < 200000; ++i)
    {
        EyeLight light = random.light(glm::dvec3(-5.0), glm::dvec3(5.0));
        light.type = random.below(4) ? EyeLight::Spot : EyeLight::Point;
        const double reach = random.scale(0.01, 100.0);
        const EyeSphere sphere = sphereOf(light, reach);
        EXPECT_LE(sphere.radius, reach * (1.0 + 1e-12));
        const glm::dvec3 way = random.direction();
        if (light.type == EyeLight::Spot &&
            glm::dot(way, light.spotDirection) <
                std::cos(glm::radians(double(light.spotCutoffDegrees))))
            continue;
        const glm::dvec3 point =
            light.position + way * reach * (random.below(2) ? 1.0 : random.uniform(0.0, 1.0));
        ASSERT_LE(glm::length(point - sphere.center), sphere.radius * (1.0 + 1e-9) + 1e-12) << i;
    }
    EXPECT_EQ(sphereOf(positional({1, 2, 3}), Infinity).radius, Infinity);
    EXPECT_EQ(sphereOf(EyeLight{}, 5.0).radius, Infinity) << "directional";
}

TEST(LightScreen, whatShowsOfAHiddenShadowIsNarrowerThanHalfAPixel)
{
    RandomLights random(4);
    unsigned int hidden = 0, beside = 0;
    double widest = 0.0;
    for (int i = 0; i < 50000; ++i)
    {
        const glm::dmat4 projection = randomProjection(random);
        const bool isPerspective = projection[2][3] != 0.0;
        EyeLight light;
        if (isPerspective)
            light = positional(random.direction() * random.scale(1e-7, 1.0));
        else
            light.position =
                glm::normalize(glm::dvec3(0, 0, 1) + random.direction() * random.scale(1e-9, 0.1));
        if (!hidesItsShadows(light, projection, Viewport))
        {
            ++beside;
            continue;
        }
        ++hidden;
        for (int j = 0; j < 20; ++j)
        {
            // A point that shows, and one farther from the light on the same ray.
            const glm::dvec4 ndc(random.uniform(-1, 1), random.uniform(-1, 1),
                                 random.below(2) ? -1.0 : random.uniform(-1, 1), 1.0);
            const glm::dvec4 at = glm::inverse(projection) * ndc;
            const glm::dvec3 caster = glm::dvec3(at) / at.w;
            const glm::dvec3 way = isPerspective ? caster - light.position : -light.position;
            const glm::dvec3 receiver = caster + way * random.scale(1e-3, 1e6);
            glm::dvec3 from, to;
            if (!toWindow(caster, projection, from) || !toWindow(receiver, projection, to))
                continue;
            const glm::dvec2 moved = glm::abs(glm::dvec2(to) - glm::dvec2(from));
            widest = std::max({widest, moved.x, moved.y});
            ASSERT_LT(std::max(moved.x, moved.y), 0.5) << i;
        }
    }
    EXPECT_GT(hidden, 10000u);
    EXPECT_GT(beside, 10000u);
    EXPECT_GT(widest, 0.3) << "the tolerance is used";
}

TEST(LightScreen, onlyALightAtTheEyeHidesItsShadows)
{
    const glm::dmat4 perspective = glm::frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0);
    const glm::dmat4 orthographic = glm::ortho(-1.0, 1.0, -1.0, 1.0, 1.0, 100.0);
    EyeLight head;
    head.position = {0, 0, 1};
    EXPECT_TRUE(hidesItsShadows(positional({0, 0, 0}), perspective, Viewport));
    EXPECT_FALSE(hidesItsShadows(positional({0, 0.01, 0}), perspective, Viewport));
    EXPECT_FALSE(hidesItsShadows(head, perspective, Viewport)) << "OSG's headlight";
    EXPECT_TRUE(hidesItsShadows(head, orthographic, Viewport));
    EXPECT_FALSE(hidesItsShadows(positional({0, 0, 0}), orthographic, Viewport));
    head.position = {0, 0, -1};
    EXPECT_FALSE(hidesItsShadows(head, orthographic, Viewport)) << "from behind the scene";
    // One eye of a stereo pair: the projection holds the shift, and the eye with it.
    const glm::dmat4 shifted = glm::translate(perspective, glm::dvec3(0.1, 0.0, 0.0));
    EXPECT_TRUE(hidesItsShadows(positional({-0.1, 0, 0}), shifted, Viewport));
    EXPECT_FALSE(hidesItsShadows(positional({0, 0, 0}), shifted, Viewport));
    EXPECT_FALSE(hidesItsShadows(positional({NAN, 0, 0}), perspective, Viewport));
}
