// SPDX-License-Identifier: MIT
#include "RandomLights.h"

#include <osgShadowVolume/ShadowMapFit.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

using osgShadowVolume::boxOf;
using osgShadowVolume::EyeLight;
using osgShadowVolume::fitBudget;
using osgShadowVolume::fitMap;
using osgShadowVolume::Hexahedron;
using osgShadowVolume::MapBudget;
using osgShadowVolume::mapKindOf;
using osgShadowVolume::MapView;
using osgShadowVolume::ShadowMap;

namespace
{

Hexahedron cube(const glm::dvec3& at, double half)
{
    return boxOf(at - half, at + half, glm::dmat4(1.0));
}

EyeLight lamp(const glm::dvec3& position)
{
    EyeLight light;
    light.type = EyeLight::Point;
    light.position = position;
    return light;
}

EyeLight sun(const glm::dvec3& towards)
{
    EyeLight light;
    light.position = glm::normalize(towards);
    return light;
}

/// A camera anywhere: from eye coordinates to the world.
glm::dmat4 randomView(RandomLights& random, double scale = 1.0)
{
    const glm::dmat4 placed =
        glm::translate(glm::dmat4(1.0), random.point(glm::dvec3(-50.0), glm::dvec3(50.0)));
    return glm::scale(glm::rotate(placed, random.uniform(0.0, 7.0), random.direction()),
                      glm::dvec3(scale));
}

} // namespace

TEST(MapBudget, sizeIsHalvedUntilAllLayersFit)
{
    const MapBudget all = fitBudget({1, 6, 1}, 1024, 16384, 2048, 256u << 20);
    EXPECT_EQ(all.size, 1024u);
    EXPECT_EQ(all.layers, 8u);
    EXPECT_EQ(all.lights, 3u);
    EXPECT_FALSE(all.isSmaller);
    EXPECT_EQ(all.getBytes(), 32u << 20);
    const MapBudget half = fitBudget({1, 6, 1}, 1024, 16384, 2048, (32u << 20) - 1);
    EXPECT_EQ(half.size, 512u);
    EXPECT_TRUE(half.isSmaller);
    EXPECT_EQ(fitBudget({1}, 100, 16384, 2048, 5000).size, 25u) << "no power of two";
    EXPECT_EQ(fitBudget({1}, 4, 16384, 2048, 1u << 20).size, 16u) << "the smallest";
    EXPECT_EQ(fitBudget({1}, 100000, 4096, 2048, 1u << 30).size, 4096u) << "the driver's largest";
}

TEST(MapBudget, lightsBeyondTheLastLayerHaveNoMap)
{
    const MapBudget many = fitBudget(std::vector<unsigned int>(500, 6), 256, 16384, 256, 1u << 30);
    EXPECT_EQ(many.lights, 42u);
    EXPECT_EQ(many.layers, 252u);
    const MapBudget poor = fitBudget(std::vector<unsigned int>(500, 6), 256, 16384, 2048, 20000);
    EXPECT_EQ(poor.size, 16u);
    EXPECT_EQ(poor.layers, 18u);
    EXPECT_LE(poor.getBytes(), 20000u);
    const MapBudget none = fitBudget({6, 1}, 256, 16384, 2048, 100);
    EXPECT_EQ(none.lights, 0u);
    EXPECT_EQ(none.size, 0u);
    EXPECT_FALSE(none.isSmaller);
    EXPECT_EQ(fitBudget({}, 256, 16384, 2048, 1u << 20).layers, 0u);
}

TEST(ShadowMapFit, whereASurfaceLooksIsWhereACasterIsDrawn)
{
    RandomLights random(1);
    for (int i = 0; i < 2000; ++i)
    {
        EyeLight light = random.light(glm::dvec3(-5.0), glm::dvec3(5.0));
        MapView view;
        view.toWorld = randomView(random, random.scale(0.1, 10.0));
        view.casters = {cube(random.direction() * 4.0, 3.0)};
        const auto map = fitMap(light, view, 256, 1 + random.below(4));
        ASSERT_TRUE(map) << i;
        for (int j = 0; j < 50; ++j)
        {
            const glm::dvec3 point = random.point(glm::dvec3(-7.0), glm::dvec3(7.0));
            const ShadowMap::Place place = map->find(point);
            if (!place.isInside)
                continue;
            ASSERT_LT(place.face, map->getLayers());
            const glm::dvec4 clip = map->getMatrix(place.face) * glm::dvec4(point, 1.0);
            ASSERT_GT(clip.w, 0.0);
            const glm::dvec3 drawn = 0.5 * (glm::dvec3(clip) / clip.w + 1.0);
            ASSERT_NEAR(drawn.x, place.uv.x, 1e-9) << i;
            ASSERT_NEAR(drawn.y, place.uv.y, 1e-9) << i;
            ASSERT_LE(place.depth, drawn.z) << "the bias is towards the light";
            const double shifted = map->kind == ShadowMap::Parallel
                                       ? drawn.z - map->bias
                                       : 1.0 - (1.0 - drawn.z) / (1.0 - map->bias);
            ASSERT_NEAR(place.depth, shifted, 1e-9) << i;
        }
    }
}

TEST(ShadowMapFit, whatACasterMayShadeInViewIsInTheMap)
{
    RandomLights random(2);
    unsigned int shaded = 0;
    for (int i = 0; i < 3000; ++i)
    {
        EyeLight light = random.light(glm::dvec3(-20.0), glm::dvec3(20.0));
        light.spotCutoffDegrees = float(random.uniform(5.0, 85.0));
        MapView view;
        view.toWorld = randomView(random);
        view.receivers = {cube(random.direction() * 5.0, 6.0), cube(random.direction() * 5.0, 6.0)};
        for (unsigned int c = 0; c <= random.below(3); ++c)
            view.casters.push_back(cube(random.direction() * 5.0, random.scale(0.1, 5.0)));
        const unsigned int samples = 1 + random.below(5);
        const auto map = fitMap(light, view, 64, samples);
        for (int j = 0; j < 50; ++j)
        {
            const Hexahedron& caster = view.casters[random.below(unsigned(view.casters.size()))];
            const glm::dvec3 from = random.point(caster[0], caster[7]);
            const glm::dvec3 way = light.isDirectional() ? -light.position : from - light.position;
            const glm::dvec3 on = from + way * random.scale(0.01, 20.0);
            bool inView = true;
            for (const Hexahedron& box : view.receivers)
                inView = inView && glm::all(glm::lessThan(box[0], on)) &&
                         glm::all(glm::lessThan(on, box[7]));
            const bool inCone = light.type != EyeLight::Spot ||
                                glm::dot(glm::normalize(way), light.spotDirection) >
                                    std::cos(glm::radians(double(light.spotCutoffDegrees)));
            if (!inView || !inCone)
                continue;
            ++shaded;
            ASSERT_TRUE(map) << i;
            const ShadowMap::Place place = map->find(on), blocker = map->find(from);
            ASSERT_TRUE(place.isInside) << i;
            ASSERT_TRUE(blocker.isInside) << i;
            ASSERT_EQ(place.face, blocker.face);
            ASSERT_LT(blocker.depth, place.depth + 1e-12);
            ASSERT_LT(blocker.depth, 1.0) << "1 is where nothing is";
            ASSERT_TRUE(map->mayShow(caster, place.face));
            // The samples around it are in the map too.
            const double reach = 0.5 * samples / 64.0;
            ASSERT_GE(std::min(place.uv.x, place.uv.y), reach);
            ASSERT_LE(std::max(place.uv.x, place.uv.y), 1.0 - reach);
        }
    }
    EXPECT_GT(shaded, 5000u);
}

TEST(ShadowMapFit, samplesAroundAFacesBorderAreOnTheFace)
{
    // 5 samples on a side reach 2.5 texels beyond the last direction that looks at a face.
    MapView view;
    view.casters = {cube({0, 0, -5}, 1.0)};
    const auto map = fitMap(lamp({0, 0, 0}), view, 64, 5);
    ASSERT_TRUE(map);
    ASSERT_EQ(map->kind, ShadowMap::Cube);
    RandomLights random(3);
    std::map<unsigned int, unsigned int> faces;
    for (int i = 0; i < 100000; ++i)
    {
        const ShadowMap::Place place = map->find(random.direction() * random.scale(0.01, 100.0));
        ASSERT_TRUE(place.isInside);
        ASSERT_GE(std::min(place.uv.x, place.uv.y) * 64.0, 2.5);
        ASSERT_LE(std::max(place.uv.x, place.uv.y) * 64.0, 61.5);
        ++faces[place.face];
    }
    EXPECT_EQ(faces.size(), 6u);
    for (const glm::dvec3 edge : {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, -1), glm::dvec3(0, -1, 1)})
        EXPECT_TRUE(map->find(edge).isInside) << "on an edge or a corner of the cube";
    EXPECT_FALSE(map->find({0, 0, 0}).isInside) << "at the light itself";
}

TEST(ShadowMapFit, aMovingCameraNeitherMovesNorTurnsTexels)
{
    RandomLights random(4);
    const glm::dvec3 worldPoint(3.1, -2.7, 0.4);
    for (const bool parallel : {true, false})
    {
        const glm::dvec3 place =
            parallel ? glm::normalize(glm::dvec3(1, 2, 3)) : glm::dvec3(4, 9, 1);
        glm::dvec2 first(0.0);
        for (int i = 0; i < 200; ++i)
        {
            MapView view;
            view.toWorld = randomView(random);
            const glm::dmat4 toEye = glm::inverse(view.toWorld);
            EyeLight light = parallel ? sun(glm::dvec3(toEye * glm::dvec4(place, 0.0)))
                                      : lamp(glm::dvec3(toEye * glm::dvec4(place, 1.0)));
            view.casters = {boxOf(glm::dvec3(-50.0), glm::dvec3(50.0), toEye)};
            // What is in view moves with the camera, yet not in size.
            const glm::dvec3 shift = random.point(glm::dvec3(-5.0), glm::dvec3(5.0));
            view.receivers = {boxOf(shift - 10.0, shift + 10.0, toEye)};
            const auto map = fitMap(light, view, 512, 1);
            ASSERT_TRUE(map);
            const glm::dvec2 texel =
                map->find(glm::dvec3(toEye * glm::dvec4(worldPoint, 1.0))).uv * 512.0;
            const glm::dvec2 part = texel - glm::floor(texel);
            if (i == 0)
                first = part;
            ASSERT_NEAR(part.x, first.x, 1e-6) << i;
            ASSERT_NEAR(part.y, first.y, 1e-6) << i;
        }
    }
}

TEST(ShadowMapFit, aDirectionalMapIsFittedToWhatIsInView)
{
    MapView view;
    view.casters = {cube({0, 0, 0}, 1000.0)};
    view.receivers = {cube({0, 0, -20}, 10.0)};
    const auto map = fitMap(sun({0, 0, 1}), view, 1024, 1);
    ASSERT_TRUE(map);
    const double texel = 1.0 / (1024.0 * glm::length(glm::dvec3(map->rows[0])));
    // 20 units, a step of an eighth of a doubling, two texels of border and one of rounding.
    EXPECT_LE(texel, 20.0 / 1021.0 * std::exp2(0.125));
    EXPECT_GE(texel, 20.0 / 1024.0);
}

TEST(ShadowMapFit, nothingToShadeNeedsNoMap)
{
    MapView view;
    EXPECT_FALSE(fitMap(sun({0, 0, 1}), view, 256, 1)) << "no caster";
    view.casters = {cube({0, 0, 0}, 1.0)};
    view.receivers = {cube({50, 0, 0}, 1.0)};
    EXPECT_FALSE(fitMap(sun({0, 0, 1}), view, 256, 1)) << "beside what is in view";
    EXPECT_TRUE(fitMap(sun({1, 0, 0}), view, 256, 1));
    EXPECT_FALSE(fitMap(sun({1, 0, 0}), view, 16, 16)) << "nothing but border";
}

TEST(ShadowMapFit, whatIsUnknownIsLeftToTheRest)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Hexahedron unknown = boxOf(glm::dvec3(1.0), glm::dvec3(-1.0), glm::dmat4(1.0));
    MapView view;
    view.casters = {cube({0, 0, 0}, 1.0)};
    view.receivers = {unknown, cube({0, 0, -5}, 2.0)};
    EXPECT_TRUE(fitMap(sun({0, 0, 1}), view, 256, 1));
    EXPECT_TRUE(fitMap(lamp({0, 0, 5}), view, 256, 1));
    view.casters = {unknown};
    EXPECT_FALSE(fitMap(sun({0, 0, 1}), view, 256, 1)) << "its depths have no end";
    EXPECT_FALSE(fitMap(lamp({nan, 0, 5}), view, 256, 1));
}

TEST(ShadowMapFit, wideSpotsHaveSixFaces)
{
    EyeLight spot = lamp({0, 0, 0});
    spot.type = EyeLight::Spot;
    spot.spotCutoffDegrees = 79.0f;
    EXPECT_EQ(mapKindOf(spot), ShadowMap::Cone);
    spot.spotCutoffDegrees = 80.0f;
    EXPECT_EQ(mapKindOf(spot), ShadowMap::Cube);
    EXPECT_EQ(mapKindOf(lamp({0, 0, 0})), ShadowMap::Cube);
    EXPECT_EQ(mapKindOf(sun({0, 0, 1})), ShadowMap::Parallel);
}
