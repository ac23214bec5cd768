// SPDX-License-Identifier: MIT
// What holds of the text at every point of every shape, however it is seen.
#include "PlacementSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

using namespace osgLabels;
using namespace placement;

namespace
{

bool isDevelopable(Shape shape)
{
    return shape != Shape::Sphere && shape != Shape::Dish && shape != Shape::Torus;
}

} // namespace

TEST(PlacementTest, textLiesWithinItsFace)
{
    int walked = 0;
    forText(400,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                for (const glm::dvec2 corner :
                     {glm::dvec2(0.01, 0.01), glm::dvec2(width - 0.01, 0.01),
                      glm::dvec2(0.01, 0.99), glm::dvec2(width - 0.01, 0.99)})
                {
                    Sample at = sample;
                    EXPECT_TRUE(walk(shape.mesh, at, camera, width, corner))
                        << shape.name << ", " << width << " em: no corner " << corner.x << ' '
                        << corner.y << " from " << place.place.x << ' ' << place.place.y;
                    ++walked;
                }
            });
    std::cout << walked << " corners of texts reached\n";
}

TEST(PlacementTest, pointsOnTheLineAreOnTheTextAndTheSameFromAllOfIt)
{
    int walked = 0;
    forText(400,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                const double em = lengthsOfEm(sample, camera, place).x;
                Sample other = sample;
                if (!walk(shape.mesh, other, camera, width, {0.1 * width, 0.2}))
                    return;
                const LabelPlace there = placeAt(shape.mesh, other, camera, width);
                const double side = glm::distance(place.onLine[0], there.onLine[0]) <
                                            glm::distance(place.onLine[2], there.onLine[0])
                                        ? 1.0
                                        : -1.0;
                for (int i = 0; i < 3; ++i)
                {
                    // The one end of the line where the other is the text's start.
                    const int j = side > 0.0 ? i : 2 - i;
                    EXPECT_LT(glm::distance(place.onLine[i], there.onLine[j]), 1e-3 * em)
                        << shape.name << ", " << width << " em: point " << i;
                    Sample at = sample;
                    // A profile has its lines on the box around it.
                    if (shape.mesh.truth.shape == Shape::Extrusion ||
                        !walk(shape.mesh, at, camera, width, {(i + 0.5) / 3.0 * width, 0.5}))
                        continue;
                    // walk() comes within 0.02 em; a dish has its line on a cone that touches it.
                    const double least = std::min(glm::distance(at.point - shape.mesh.truth.origin,
                                                                glm::dvec3(place.onLine[i])),
                                                  glm::distance(at.point - shape.mesh.truth.origin,
                                                                glm::dvec3(place.onLine[2 - i])));
                    EXPECT_LT(least, shape.mesh.truth.shape == Shape::Dish ? 0.3 * em : 0.05 * em)
                        << shape.name << ", " << width << " em: point " << i;
                    ++walked;
                }
            });
    EXPECT_GT(walked, 1000);
}

TEST(PlacementTest, developableShapesDoNotStretchText)
{
    std::map<std::string, double> worst;
    forText(1500,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float,
                const LabelPlace& place)
            {
                const glm::dvec2 em = lengthsOfEm(sample, camera, place);
                double& stretch = worst[shape.name];
                stretch = std::max(stretch, em.x / em.y - 1.0);
            });
    for (const PlacedShape& shape : placedShapes())
    {
        std::cout << std::setw(12) << shape.name << ": stretched by at most "
                  << 100.0 * worst[shape.name] << " %\n";
        // Spheres and dishes can't be unrolled, nor can bends, which are narrower inside.
        EXPECT_LT(worst[shape.name], isDevelopable(shape.mesh.truth.shape) ? 0.01 : 0.07)
            << shape.name;
    }
}

TEST(PlacementTest, footprintsAreDerivatives)
{
    int compared = 0, skipped = 0;
    forText(300,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                for (int i = 0; i != 2; ++i)
                {
                    const glm::dvec3 step = camera.slide(sample.point, sample.normal,
                                                         i == 0 ? camera.right : camera.above);
                    // A tenth of an em: more than floats' noise, less than curvature.
                    const double length = 0.1 * 1e-3 / glm::length(glm::dvec2(place.footprint[i]));
                    Sample before = sample, after = sample;
                    before.point -= 0.5 * length * step;
                    after.point += 0.5 * length * step;
                    const LabelPlace a = placeAt(shape.mesh, before, camera, width);
                    const LabelPlace b = placeAt(shape.mesh, after, camera, width);
                    const glm::dvec2 moved = glm::dvec2(b.place) - glm::dvec2(a.place);
                    const glm::dvec2 expected = glm::dvec2(place.footprint[i]) * length / 1e-3;
                    // Where the points lie on two texts there is no derivative.
                    if (glm::length(moved) > 0.2)
                    {
                        ++skipped;
                        continue;
                    }
                    ++compared;
                    EXPECT_LT(glm::distance(moved, expected), 0.004)
                        << shape.name << ", " << width << " em";
                }
            });
    EXPECT_LT(50 * skipped, compared) << "of points on the edge of a text";
}

TEST(PlacementTest, textIsUprightAndNotMirrored)
{
    double lowest = 180.0, highest = -180.0;
    std::map<std::string, int> middles;
    forText(1500,
            [&](const PlacedShape& shape, const Sample& sample, const Camera& camera, float width,
                const LabelPlace& place)
            {
                EXPECT_GT(glm::determinant(place.footprint), 0.0f) << shape.name;
                // Bends and spheres turn within a text, the more on the screen the flatter they
                // are seen: what counts is its middle.
                if (std::abs(place.place.x - 0.5f * width) > 0.2f || !faces(camera, sample, 0.2))
                    return;
                const LabelPlace at = placeAt(shape.mesh, sample, camera, width);
                const glm::dmat2 inverse = glm::inverse(glm::dmat2(at.footprint));
                const glm::dvec2 pixels = inverse * glm::dvec2(0.01, 0.0);
                const glm::dvec3 next =
                    sample.point +
                    1e-3 * (pixels.x * camera.slide(sample.point, sample.normal, camera.right) +
                            pixels.y * camera.slide(sample.point, sample.normal, camera.above));
                const glm::dvec2 way = camera.project(next) - camera.project(sample.point);
                const double angle = glm::degrees(std::atan2(way.y, way.x));
                ++middles[shape.name];
                lowest = std::min(lowest, angle);
                highest = std::max(highest, angle);
                // The window is -67.5 to 112.5 for the line's middle; a line's edges, half an em
                // away, may lie a little differently in perspective.
                EXPECT_GT(angle, -85.0) << shape.name << ", " << width << " em";
                EXPECT_LT(angle, 130.0) << shape.name << ", " << width << " em";
            });
    for (const PlacedShape& shape : placedShapes())
        EXPECT_GT(middles[shape.name], 10) << shape.name << " shows no middle of a text";
    std::cout << "text runs at " << lowest << " to " << highest << " degrees\n";
}

TEST(PlacementTest, noDecisionTremblesWithTheCamera)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> tremble(-1e-6, 1e-6);
    // The views that a user has most: along axes, diagonal, from above.
    const std::vector<glm::dvec3> from = {{0, -1, 0}, {1, 0, 0},  {1, 1, 0},         {1, -1, 1},
                                          {0, -1, 1}, {-1, 0, 1}, {0.001, -0.001, 1}};
    for (const PlacedShape& shape : placedShapes())
    {
        int compared = 0, turned = 0;
        for (const glm::dvec3& direction : from)
            for (int i = 0; i != 300; ++i)
            {
                const Sampler sampler(shape.mesh);
                const Sample sample = sampler(random);
                const double reach = glm::length(glm::min(shape.mesh.truth.size, glm::dvec3(4.0)));
                const glm::dvec3 eye = 4.0 * reach * glm::normalize(direction);
                const Camera still(eye, {0, 0, 1});
                if (!faces(still, sample))
                    continue;
                const LabelPlace a = placeAt(shape.mesh, sample, still, shape.width);
                if (!a.inside)
                    continue;
                ++compared;
                for (int k = 0; k != 8; ++k)
                {
                    const glm::dvec3 off(tremble(random), tremble(random), tremble(random));
                    const Camera moved(eye + reach * off, {0, 0, 1});
                    const LabelPlace b = placeAt(shape.mesh, sample, moved, shape.width);
                    turned += glm::distance(a.place, b.place) > 1e-3;
                }
            }
        EXPECT_GT(compared, 10) << shape.name << " shows no text";
        // Bends that reach over the top are seen at every angle, so that a point there may be just
        // about to turn over.
        const bool isBend = shape.mesh.truth.shape == Shape::Torus;
        EXPECT_LE(turned, isBend ? 8 : 0) << shape.name << " trembles";
    }
}

TEST(PlacementTest, shortTextsAreRepeatedAlongWhatIsLongAndStandOnceOnWhatIsNot)
{
    using namespace shapemesh;
    struct Case
    {
        const char* name;
        ShapeMesh mesh;
        glm::dvec3 normal; ///< Of the side where the text is looked at.
        bool isLong;
    };
    const Case cases[] = {{"pipe", frustum(0.1, 0.1, 6.0, 32, 1, FanCapped), {0, 1, 0}, true},
                          {"pole", frustum(0.2, 0.2, 1.2, 32, 1, FanCapped), {0, 1, 0}, true},
                          {"tank", frustum(0.5, 0.5, 0.6, 32, 1, FanCapped), {0, 1, 0}, false},
                          {"rail", box({0.1, 0.2, 4.0}, false), {0, 1, 0}, true},
                          {"post", box({0.1, 0.1, 0.4}, false), {0, 1, 0}, true},
                          {"block", box({0.5, 0.5, 0.7}, false), {0, 1, 0}, false}};
    for (const Case& each : cases)
        for (const float width : {0.6f, 1.2f, 1.8f, 2.4f})
            for (const glm::dvec3 up : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)})
            {
                const Camera camera(glm::dvec3(1.0, 8.0, 1.5), up);
                const glm::dvec3 size = each.mesh.truth.size;
                bool runsAlong = false;
                int texts = 0;
                double last = 1e9;
                for (double z = -size.z; z < size.z; z += 0.002 * size.x)
                {
                    const Sample sample{each.normal * size.y + glm::dvec3(0, 0, z), each.normal,
                                        false};
                    const LabelPlace at = placeAt(each.mesh, sample, camera, width);
                    if (!at.inside)
                        continue;
                    // Along the text, seen from below to above.
                    const glm::dvec2 step =
                        glm::dvec2(at.footprint *
                                   glm::vec2(camera.project(sample.point + glm::dvec3(0, 0, 1e-3)) -
                                             camera.project(sample.point)));
                    runsAlong = std::abs(step.x) > std::abs(step.y);
                    texts += std::abs(at.place.x - last) > 0.5 * width;
                    last = at.place.x;
                }
                const std::string what = std::string(each.name) + ", " + std::to_string(width) +
                                         " em, up " + (up.z > 0.0 ? "z" : "x");
                if (each.isLong)
                {
                    EXPECT_TRUE(runsAlong) << what;
                    EXPECT_GE(texts, width < 2.0f ? 2 : 1) << what;
                }
                else if (up.z > 0.0 && width < 2.0f)
                {
                    EXPECT_FALSE(runsAlong) << what;
                }
            }
}

TEST(PlacementTest, textStandsFourTimesAroundUprightCylindersAtLeast)
{
    const ShapeMesh tank = shapemesh::frustum(0.5, 0.5, 0.6, 32, 1, shapemesh::FanCapped);
    for (const float width : {0.6f, 1.8f, 8.0f, 25.0f})
    {
        int texts = 0;
        LabelPlace before;
        constexpr int Steps = 3600;
        for (int i = 0; i <= Steps; ++i)
        {
            const double angle = 2.0 * M_PI * (i + 0.5) / Steps;
            const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
            const LabelPlace at =
                placeAt(tank, {0.5 * out, out, true},
                        Camera(8.0 * out + glm::dvec3(0, 0, 1), {0, 0, 1}), width);
            const bool isNext = !before.inside || at.place.x < before.place.x - 0.5f * width;
            texts += i > 0 && at.inside && isNext;
            before = at;
        }
        // Long ones run up the tank, each in the middle of its quarter.
        EXPECT_GE(texts, 4) << width << " em";
        EXPECT_TRUE(width < 4.0f || texts == 4) << width << " em";
    }
}

TEST(PlacementTest, linesOfAdjoiningWallsStandAtOneHeight)
{
    const glm::dvec3 half(0.6, 0.5, 0.3);
    const ShapeMesh block = shapemesh::box(half, false);
    for (const double z : {-0.05, 0.0, 0.08})
        for (const float width : {1.8f, 2.4f})
        {
            std::vector<LabelPlace> places;
            for (const glm::dvec3 out : {glm::dvec3(1, 0, 0), {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}})
                places.push_back(placeAt(block, {out * half + glm::dvec3(0, 0, z), out, false},
                                         Camera(8.0 * out + glm::dvec3(0, 0, 1), {0, 0, 1}),
                                         width));
            for (const LabelPlace& at : places)
            {
                EXPECT_TRUE(at.inside) << z << ", " << width << " em";
                EXPECT_NEAR(at.place.y, places.front().place.y, 1e-4f) << z << ", " << width;
            }
        }
}
