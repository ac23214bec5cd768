// SPDX-License-Identifier: MIT
// Shapes as long, as thin and as bad as they get.
#include "ShapeMeshes.h"

#include <osgLabels/Placement.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace osgLabels;

TEST(PlacementLimitsTest, fiveMillionTextsAlongAPipeAreExactNearTheEye)
{
    // 1e-3 thick, 1e4 long.
    ShapeMesh mesh = shapemesh::frustum(5e-4, 5e-4, 5e3, 16, 1, shapemesh::Open);
    const ObjectRecord record = mesh.truth.record(1);
    PlacementView view;
    view.up = glm::vec3(0, 1, 0);
    const float width = 3.0f;
    for (const float along : {0.0f, 12.5f, 777.25f, -4321.5f, 4999.0f})
    {
        view.base = glm::vec3(0.0f, 0.0f, along);
        view.eye = glm::vec4(0.3f, 0.0f, along, 1.0f);
        view.screenRight = glm::vec3(0, 0, -1);
        view.screenUp = glm::vec3(0, 1, 0);
        float travelled = 0.0f;
        LabelPlace before;
        const float em = 0.5f * 1.57079633f * 5e-4f;
        for (int i = 0; i != 1000; ++i)
        {
            const float z = 0.01f * float(i) * em;
            const LabelPlace at =
                placeOn(record, {5e-4f, 0.0f, z}, {0, 0, -1e-6f}, {0, 1e-6f, 0}, view, width);
            EXPECT_NEAR(at.place.y, 0.5f, 1e-4f);
            if (i > 0 && at.place.x < before.place.x)
                travelled += before.place.x - at.place.x;
            before = at;
        }
        // Ten em, of which two steps from one text to the next go the other way.
        EXPECT_NEAR(travelled, 10.0f, 0.05f) << along;
    }
    // The same points from two bases, exact in floats both: the same place on the text.
    for (const float em : {3.0f, 3.7f, 11.3f})
        for (const float base : {100.0f, 1000.0f, 4096.0f})
            for (const float apart : {0x1p-5f, 1.0f, 3.0f, 7.0f, 13.0f, 16.0f})
            {
                view.base.z = base;
                const LabelPlace a =
                    placeOn(record, {5e-4f, 0, apart}, {0, 0, -1e-6f}, {0, 1e-6f, 0}, view, em);
                view.base.z = base + apart;
                const LabelPlace b =
                    placeOn(record, {5e-4f, 0, 0}, {0, 0, -1e-6f}, {0, 1e-6f, 0}, view, em);
                EXPECT_LT(glm::distance(a.place, b.place), 0.05f) << base << ' ' << apart;
            }
}

TEST(PlacementLimitsTest, thinAndLongFacesKeepTheirText)
{
    // A face of 1e-3 x 1e4 seen from near its end.
    FittedShape shape;
    shape.shape = Shape::Box;
    shape.size = {5e3, 5e-4, 5e-4};
    PlacementView view;
    view.base = glm::vec3(4321.0f, 0.0f, 0.0f);
    view.eye = glm::vec4(4321.0f, -0.01f, 0.0f, 1.0f);
    view.screenRight = glm::vec3(1, 0, 0);
    view.screenUp = glm::vec3(0, 0, 1);
    view.up = glm::vec3(0, 0, 1);
    int inside = 0;
    for (int i = 0; i != 1000; ++i)
    {
        const LabelPlace at = placeOn(shape.record(1), {1e-5f * float(i), -5e-4f, 0.0f},
                                      {1e-7f, 0, 0}, {0, 0, 1e-7f}, view, 8.0f);
        inside += at.inside;
        EXPECT_NEAR(at.footprint[0].x, 1e-7f / 5e-4f, 1e-6f);
    }
    // Eight em of text and at least two of gap, half of 1e-3 tall.
    EXPECT_NEAR(inside, 800, 20);
}

TEST(PlacementLimitsTest, badObjectsHaveNoText)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    PlacementView view;
    view.eye = glm::vec4(1, 2, 3, 1);
    int inside = 0;
    for (std::uint32_t shape = 0; shape != 12; ++shape)
        for (const float size : {0.0f, 1e-38f, nan, infinite, -1.0f})
            for (const float width : {0.0f, nan, -1.0f, 5.0f})
                for (const glm::vec3 at : {glm::vec3(0.0f), glm::vec3(0.1f, 0.2f, 0.3f)})
                    for (const glm::vec3 step : {glm::vec3(0.0f), glm::vec3(1e-3f, 0, 0)})
                    {
                        ObjectRecord record;
                        record.shape = shape;
                        record.size = glm::vec3(size, size, size);
                        const LabelPlace place =
                            placeOn(record, at, step, {0, 1e-3f, 0}, view, width);
                        // Only a size and a width that are some can have text.
                        if (shape == 0 || !(size > 0.0f) || !(width > 0.0f))
                        {
                            EXPECT_FALSE(place.inside) << "shape " << shape << " of " << size
                                                       << ", text of " << width << " em";
                        }
                        if (!place.inside)
                            continue;
                        ++inside;
                        EXPECT_TRUE(std::isfinite(place.place.x + place.place.y));
                    }
    EXPECT_GT(inside, 0) << "the smallest have some";
}
