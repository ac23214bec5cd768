// SPDX-License-Identifier: MIT
#include "RandomLights.h"

#include <osgShadowVolume/LightGrid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numeric>

using osgShadowVolume::attenuationAt;
using osgShadowVolume::brightness;
using osgShadowVolume::EyeLight;
using osgShadowVolume::LightGrid;
using osgShadowVolume::reachOf;

namespace
{

struct Scene
{
    std::vector<EyeLight> lights;
    std::vector<double> reach;
    std::vector<std::uint32_t> indices;
    glm::dvec3 low, high;

    LightGrid grid() const { return LightGrid(lights, reach, indices, low, high); }
};

Scene makeScene(RandomLights& random, unsigned int count, const glm::dvec3& low,
                const glm::dvec3& high, double threshold = 0.01)
{
    Scene scene;
    scene.low = low;
    scene.high = high;
    // Lights lie in the box and around it.
    const glm::dvec3 margin = 0.3 * (high - low) + 1e-3;
    for (unsigned int i = 0; i < count; ++i)
    {
        scene.lights.push_back(random.light(low - margin, high + margin));
        scene.reach.push_back(reachOf(scene.lights.back(), threshold));
        if (random.below(4)) // the others are off
            scene.indices.push_back(i);
    }
    return scene;
}

bool lights(const EyeLight& light, double reach, const glm::dvec3& point)
{
    if (light.type == EyeLight::Directional)
        return reach > 0.0;
    const glm::dvec3 d = point - light.position;
    if (glm::length(d) > reach)
        return false;
    return light.type == EyeLight::Point ||
           glm::dot(d, light.spotDirection) >=
               glm::length(d) * std::cos(glm::radians(double(light.spotCutoffDegrees)));
}

/// Counts the lights that were found to reach a point, or it proves nothing.
void expectCellsListAllThatReaches(const Scene& scene, RandomLights& random, int points,
                                   std::size_t& reaching)
{
    const LightGrid grid = scene.grid();
    ASSERT_EQ(grid.getOffsets().size(),
              std::size_t(grid.getSize().x) * grid.getSize().y * grid.getSize().z + 1);
    ASSERT_EQ(grid.getOffsets().back(), grid.getIndices().size());
    std::vector<bool> everywhere(scene.lights.size()), isOn(scene.lights.size());
    for (std::uint32_t light : grid.getEverywhere())
        everywhere[light] = true;
    for (std::uint32_t light : scene.indices)
        isOn[light] = true;
    for (std::uint32_t light : grid.getIndices())
    {
        ASSERT_TRUE(isOn[light]) << "a light that is off is listed";
        ASSERT_FALSE(everywhere[light]) << "a light is listed twice";
    }
    for (int i = 0; i < points; ++i)
    {
        const glm::dvec3 point = random.point(scene.low, scene.high);
        const std::size_t cell = grid.cellOf(point);
        ASSERT_LT(cell + 1, grid.getOffsets().size());
        std::vector<bool> listed = everywhere;
        for (std::size_t at = grid.getOffsets()[cell]; at < grid.getOffsets()[cell + 1]; ++at)
        {
            ASSERT_FALSE(listed[grid.getIndices()[at]]) << "listed twice in a cell";
            listed[grid.getIndices()[at]] = true;
        }
        for (std::uint32_t light : scene.indices)
        {
            if (lights(scene.lights[light], scene.reach[light], point))
            {
                ASSERT_TRUE(listed[light]) << "light " << light << " at point " << i;
                ++reaching;
            }
        }
    }
}

} // namespace

TEST(LightGrid, eachCellListsAllLightsThatReachAPointOfIt)
{
    std::size_t reaching = 0;
    RandomLights random(11);
    for (int round = 0; round < 40; ++round)
    {
        const glm::dvec3 low = random.point(glm::dvec3(-100.0), glm::dvec3(0.0));
        const glm::dvec3 high =
            low + glm::dvec3(random.scale(1e-3, 100.0), random.scale(1e-3, 100.0),
                             random.scale(1e-3, 100.0));
        const Scene scene = makeScene(random, 1 + random.below(2000), low, high);
        ASSERT_NO_FATAL_FAILURE(expectCellsListAllThatReaches(scene, random, 200, reaching))
            << round;
    }
    EXPECT_GT(reaching, 1000u);
}

TEST(LightGrid, degenerateBoxesAreGridsToo)
{
    std::size_t reaching = 0;
    RandomLights random(12);
    const glm::dvec3 boxes[][2] = {{{-5.0, -5.0, 0.0}, {5.0, 5.0, 0.0}},    // a floor
                                   {{-5.0, 1.0, 2.0}, {5.0, 1.0, 2.0}},     // a line
                                   {{3.0, 3.0, 3.0}, {3.0, 3.0, 3.0}},      // a point
                                   {{0.0, 0.0, 0.0}, {1e-12, 1e-12, 1e9}}}; // a needle
    for (const auto& box : boxes)
    {
        const Scene scene = makeScene(random, 500, box[0], box[1]);
        ASSERT_NO_FATAL_FAILURE(expectCellsListAllThatReaches(scene, random, 200, reaching));
    }
    EXPECT_GT(reaching, 1000u);
}

TEST(LightGrid, farFromTheOriginEachCellListsItsLights)
{
    std::size_t reaching = 0;
    RandomLights random(13);
    const glm::dvec3 low(1e7), high(1e7 + 50.0);
    ASSERT_NO_FATAL_FAILURE(
        expectCellsListAllThatReaches(makeScene(random, 1000, low, high), random, 500, reaching));
    ASSERT_NO_FATAL_FAILURE(expectCellsListAllThatReaches(makeScene(random, 1000, -low, high, 1e-9),
                                                          random, 500, reaching));
    EXPECT_GT(reaching, 1000u);
}

TEST(LightGrid, noLightsMakeOneEmptyGrid)
{
    const Scene scene = {{}, {}, {}, glm::dvec3(-1.0), glm::dvec3(1.0)};
    const LightGrid grid = scene.grid();
    EXPECT_TRUE(grid.getEverywhere().empty());
    EXPECT_TRUE(grid.getIndices().empty());
    EXPECT_LT(grid.cellOf(glm::dvec3(0.0)) + 1, grid.getOffsets().size());
}

TEST(LightGrid, endlessLightsAreListedOnce)
{
    RandomLights random(14);
    Scene scene = makeScene(random, 300, glm::dvec3(-5.0), glm::dvec3(5.0));
    scene.reach.assign(300, std::numeric_limits<double>::infinity());
    for (EyeLight& light : scene.lights)
        if (light.type == EyeLight::Spot) // its cone has an end at the box
            light.type = EyeLight::Point;
    const LightGrid grid = scene.grid();
    EXPECT_EQ(grid.getEverywhere(), scene.indices);
    EXPECT_TRUE(grid.getIndices().empty());
}

TEST(LightGrid, pointsOutsideFallIntoTheNearestCell)
{
    RandomLights random(15);
    const LightGrid grid = makeScene(random, 1000, glm::dvec3(0.0), glm::dvec3(8.0)).grid();
    EXPECT_EQ(grid.cellOf(glm::dvec3(-100.0)), 0u);
    EXPECT_EQ(grid.cellOf(glm::dvec3(1e30)), grid.getOffsets().size() - 2);
    EXPECT_LE(grid.getSize().x, 256);
    EXPECT_LE(grid.getSize().y, 256);
    EXPECT_LE(grid.getSize().z, 256);
}

TEST(LightGrid, takesNoLargeListsFor65536Lights)
{
    std::size_t reaching = 0;
    RandomLights random(16);
    // Short reaches, and reaches of just under half of the box: the most pairs that there can be.
    for (const double share : {0.02, 0.2, 0.35})
    {
        Scene scene = makeScene(random, 65536, glm::dvec3(0.0), glm::dvec3(100.0));
        for (std::size_t i = 0; i < scene.lights.size(); ++i)
        {
            scene.lights[i].type = EyeLight::Point;
            scene.reach[i] = share * 100.0;
        }
        const auto start = std::chrono::steady_clock::now();
        const LightGrid grid = scene.grid();
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        std::printf("reach %4.2f of the box: %zu cells, %zu pairs, %.0f ms\n", share,
                    grid.getOffsets().size() - 1, grid.getIndices().size(), time.count() * 1e3);
        EXPECT_LE(grid.getIndices().size(), std::size_t(4) << 20);
        ASSERT_NO_FATAL_FAILURE(expectCellsListAllThatReaches(scene, random, 3, reaching));
    }
    EXPECT_GT(reaching, 1000u);
}
