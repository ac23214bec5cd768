// SPDX-License-Identifier: MIT
#include "RandomLights.h"

#include <osgShadowVolume/ShadowHull.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

using osgShadowVolume::boxOf;
using osgShadowVolume::frustumOf;
using osgShadowVolume::Hexahedron;
using osgShadowVolume::nearRectangleOf;
using osgShadowVolume::ShadowHull;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
const double NotANumber = std::numeric_limits<double>::quiet_NaN();

/// Random hulls and boxes of all kinds.
class RandomHulls : public RandomLights
{
public:
    using RandomLights::RandomLights;

    glm::dmat4 projection()
    {
        const double near = scale(1e-3, 10.0), far = near * scale(1.1, 1e6);
        double left = uniform(-2.0, 0.5), right = left + scale(0.05, 3.0);
        double bottom = uniform(-2.0, 0.5), top = bottom + scale(0.05, 3.0);
        if (below(4) == 0)
            std::swap(left, right); // mirrored
        if (below(3) == 0)
            return glm::ortho(10 * left, 10 * right, 10 * bottom, 10 * top, near - 5.0, far);
        return glm::frustum(near * left, near * right, near * bottom, near * top, near, far);
    }

    glm::dmat4 modelview(double size)
    {
        const glm::dvec3 factors(scale(0.1, 10.0), scale(0.1, 10.0),
                                 below(4) ? scale(0.1, 10.0) : -1.0);
        const glm::dmat4 placed = glm::translate(glm::dmat4(1.0), size * direction());
        return glm::scale(glm::rotate(placed, uniform(0.0, 7.0), direction()), factors);
    }

    Hexahedron hexahedron(double size)
    {
        if (below(2))
            return frustumOf(projection());
        return box(size);
    }

    /// Some are flat, lines or points.
    Hexahedron box(double size)
    {
        glm::dvec3 half(scale(0.001, 1.0), scale(0.001, 1.0), scale(0.001, 1.0));
        for (int i = 0; i < 3; ++i)
            if (below(6) == 0)
                half[i] = 0.0;
        return boxOf(-half * size, half * size, modelview(size));
    }

    glm::dvec4 light(double size)
    {
        switch (below(4))
        {
        case 0:
            return {direction() * scale(1e-9, 1e9), 0.0};
        case 1: // far off, yet not at infinity
            return {direction() * size * scale(1.0, 1e15), 1.0};
        default:
            return {direction() * size * uniform(0.0, 4.0), below(2) ? 1.0 : -2.0};
        }
    }

    glm::dvec3 pointIn(const Hexahedron& h)
    {
        glm::dvec3 t;
        for (int i = 0; i < 3; ++i)
            t[i] = below(3) ? uniform(0.0, 1.0) : double(below(2));
        glm::dvec3 sum(0.0);
        for (unsigned int i = 0; i < 8; ++i)
            sum += h[i] *
                   ((i & 1 ? t.x : 1 - t.x) * (i & 2 ? t.y : 1 - t.y) * (i & 4 ? t.z : 1 - t.z));
        return sum;
    }
};

/// A point between a point and the light.
glm::dvec3 towards(const glm::dvec3& from, const glm::dvec4& light, double share, double size)
{
    if (light.w == 0.0)
        return from + glm::normalize(glm::dvec3(light)) * share * size;
    return glm::mix(from, glm::dvec3(light) / light.w, share);
}

double sizeOf(const Hexahedron& h)
{
    double size = 0.0;
    for (const glm::dvec3& corner : h)
        size = std::max(size, glm::length(corner));
    return size;
}

/// Whether a plane between the two is found by Gilbert's iteration for the nearest points.
bool areApart(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    const auto support = [](const std::vector<glm::dvec3>& points, const glm::dvec3& d)
    {
        glm::dvec3 best = points[0];
        for (const glm::dvec3& p : points)
            if (glm::dot(p, d) > glm::dot(best, d))
                best = p;
        return best;
    };
    glm::dvec3 nearest = a[0] - b[0];
    for (int i = 0; i < 2000; ++i)
    {
        const glm::dvec3 next = support(a, -nearest) - support(b, nearest);
        if (glm::dot(next, nearest) > 0.0)
            return true;
        const glm::dvec3 step = next - nearest;
        const double length = glm::dot(step, step);
        if (!(length > 0.0))
            return false;
        nearest += step * glm::clamp(-glm::dot(nearest, step) / length, 0.0, 1.0);
    }
    return false;
}

} // namespace

TEST(ShadowHull, whatThrowsAShadowOnAPointOfItTouchesIt)
{
    RandomHulls random(1);
    unsigned int cases = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const double size = random.scale(1e-6, 1e7);
        const Hexahedron receivers = random.hexahedron(size);
        const glm::dvec4 light = random.light(std::max(size, sizeOf(receivers)));
        const ShadowHull hull(receivers, light);
        ASSERT_FALSE(hull.touchesEverything()) << i;
        for (int j = 0; j < 20; ++j)
        {
            // A box with one of its points on the way of light, at a corner of it now and then.
            const glm::dvec3 on = towards(
                random.pointIn(receivers), light,
                random.below(4) ? random.uniform(0.0, 1.0) : random.scale(1e-9, 1.0), 4.0 * size);
            Hexahedron box = random.box(size * random.scale(1e-6, 1.0));
            const glm::dvec3 shift = on - random.pointIn(box);
            for (glm::dvec3& corner : box)
                corner += shift;
            ASSERT_TRUE(hull.mayTouch(box)) << "hull " << i << ", box " << j;
            ++cases;
        }
    }
    EXPECT_EQ(cases, 400000u);
}

TEST(ShadowHull, boxesThatTouchNothingAreMostlyLeftOut)
{
    RandomHulls random(2);
    unsigned int apart = 0, needless = 0, touching = 0;
    for (int i = 0; i < 4000; ++i)
    {
        const Hexahedron receivers = random.box(10.0);
        glm::dvec4 light = random.light(10.0);
        if (light.w != 0.0)
            light = {random.direction() * random.uniform(0.0, 60.0), 1.0};
        const ShadowHull hull(receivers, light);
        std::vector<glm::dvec3> points(receivers.begin(), receivers.end());
        if (light.w == 0.0) // far beyond all boxes
            for (const glm::dvec3& corner : receivers)
                points.push_back(towards(corner, light, 1.0, 1e3));
        else
            points.push_back(glm::dvec3(light) / light.w);
        for (int j = 0; j < 10; ++j)
        {
            const Hexahedron box = random.box(10.0 * random.scale(0.05, 1.0));
            Hexahedron moved = box;
            const glm::dvec3 shift = random.point(glm::dvec3(-15.0), glm::dvec3(15.0));
            for (glm::dvec3& corner : moved)
                corner += shift;
            if (!areApart(points, {moved.begin(), moved.end()}))
            {
                touching += hull.mayTouch(moved);
                continue;
            }
            ++apart;
            needless += hull.mayTouch(moved);
        }
    }
    const double share = double(needless) / apart;
    std::printf(
        "[ needless ] %.2f %% of %u boxes outside of the hull are not told to be, %.2f %% of "
        "those that touch\n",
        100.0 * share, apart, 100.0 * needless / (needless + touching));
    ASSERT_GT(apart, 10000u);
    // A pair within the margin of each other, or a flat box that lies aslant beside an edge.
    EXPECT_LT(share, 0.001);
}

TEST(ShadowHull, aCasterBehindTheLightOrBehindTheReceiversIsLeftOut)
{
    const Hexahedron receivers = boxOf({-1, -1, -1}, {1, 1, 1}, glm::dmat4(1.0));
    const auto boxAt = [](double z) {
        return boxOf({-1, -1, z}, {1, 1, z + 0.5}, glm::dmat4(1.0));
    };
    const ShadowHull lamp(receivers, {0, 0, 5, 1});
    EXPECT_TRUE(lamp.mayTouch(boxAt(3.0)));
    EXPECT_TRUE(lamp.mayTouch(boxAt(4.9)));
    EXPECT_FALSE(lamp.mayTouch(boxAt(5.1)));
    EXPECT_FALSE(lamp.mayTouch(boxAt(-2.0)));
    EXPECT_FALSE(lamp.mayTouch(boxOf({2, 2, 2}, {3, 3, 3}, glm::dmat4(1.0)))) << "beside";
    const ShadowHull sun(receivers, {0, 0, 1, 0});
    EXPECT_TRUE(sun.mayTouch(boxAt(1e9)));
    EXPECT_FALSE(sun.mayTouch(boxAt(-2.0)));
    EXPECT_FALSE(sun.mayTouch(boxOf({1.1, 0, 0}, {2, 1, 10}, glm::dmat4(1.0)))) << "beside";
    const ShadowHull below(receivers, {0, 0, -1, 0});
    EXPECT_TRUE(below.mayTouch(boxAt(-2.0))) << "a sun from below, z = 0 is no rounding";
    const ShadowHull inside(receivers, {0.5, 0, 0, 1});
    EXPECT_TRUE(inside.mayTouch(boxAt(0.9)));
    EXPECT_FALSE(inside.mayTouch(boxAt(1.1)));
}

TEST(ShadowHull, aFarLampIsAsTightAsTheSun)
{
    RandomHulls random(3);
    unsigned int outside = 0;
    for (int i = 0; i < 2000; ++i)
    {
        const Hexahedron receivers = random.box(10.0);
        const glm::dvec3 direction = random.direction();
        const ShadowHull sun(receivers, glm::dvec4(direction, 0.0));
        const ShadowHull lamp(receivers, glm::dvec4(direction * 1e18, 1.0));
        for (int j = 0; j < 10; ++j)
        {
            const Hexahedron box = random.box(random.scale(0.1, 20.0));
            outside += !sun.mayTouch(box);
            ASSERT_EQ(sun.mayTouch(box), lamp.mayTouch(box)) << i << ", " << j;
        }
    }
    EXPECT_GT(outside, 2000u);
}

TEST(ShadowHull, zPassIsRightWhereTheNearRectangleHasFreeSightOfTheLight)
{
    const glm::dmat4 perspective = glm::perspective(1.0, 1.5, 1.0, 100.0);
    const Hexahedron near = nearRectangleOf(perspective);
    const auto blocker = [](glm::dvec3 at)
    { return boxOf(at - glm::dvec3(0.1), at + glm::dvec3(0.1), glm::dmat4(1.0)); };
    const ShadowHull lamp(near, {0, 10, -1, 1});
    EXPECT_TRUE(lamp.mayTouch(blocker({0, 5, -1})));
    EXPECT_TRUE(lamp.mayTouch(blocker({0, 0, -1}))) << "it is cut by the near plane";
    EXPECT_FALSE(lamp.mayTouch(blocker({0, 0, -3})));
    EXPECT_FALSE(lamp.mayTouch(blocker({0, 5, -3})))
        << "in the frustum's hull, not in the near one";
    EXPECT_TRUE(ShadowHull(frustumOf(perspective), {0, 10, -1, 1}).mayTouch(blocker({0, 5, -3})));
    const ShadowHull coplanar(near, {0.01, 0.01, -1, 1});
    EXPECT_TRUE(coplanar.mayTouch(blocker({0, 0, -1}))) << "a light in the near plane";
    EXPECT_FALSE(coplanar.mayTouch(blocker({0, 0, -1.2})));
    const ShadowHull orthographic(nearRectangleOf(glm::ortho(-1.0, 1.0, -1.0, 1.0, -5.0, 5.0)),
                                  {0, 0, 1, 0});
    EXPECT_TRUE(orthographic.mayTouch(blocker({0, 0, 1e3})));
    EXPECT_FALSE(orthographic.mayTouch(blocker({0, 0, 0})));
}

TEST(ShadowHull, casterWithinTheMarginTouches)
{
    const Hexahedron receivers = boxOf({-1, -1, -1}, {1, 1, 1}, glm::dmat4(1.0));
    const ShadowHull sun(receivers, {0, 0, 1, 0});
    const auto beside = [](double gap) {
        return boxOf({1.0 + gap, 0, 0}, {2, 1, 1}, glm::dmat4(1.0));
    };
    EXPECT_TRUE(sun.mayTouch(beside(1.9e-6))) << "Margin times the box's largest coordinate, 2";
    EXPECT_FALSE(sun.mayTouch(beside(2.1e-6)));
}

TEST(ShadowHull, whatIsUnknownTouchesEverything)
{
    const Hexahedron box = boxOf({-1, -1, -1}, {1, 1, 1}, glm::dmat4(1.0));
    const Hexahedron faraway = boxOf({50, 50, 50}, {51, 51, 51}, glm::dmat4(1.0));
    const glm::dvec4 lamp(0, 0, 5, 1);
    ASSERT_FALSE(ShadowHull(box, lamp).mayTouch(faraway));
    for (double bad : {Infinity, -Infinity, NotANumber})
    {
        Hexahedron broken = box;
        broken[3].y = bad;
        EXPECT_TRUE(ShadowHull(broken, lamp).mayTouch(faraway));
        EXPECT_TRUE(ShadowHull(box, lamp).mayTouch(broken));
        EXPECT_TRUE(ShadowHull(box, {bad, 0, 5, 1}).mayTouch(faraway));
        EXPECT_TRUE(ShadowHull(box, {bad, 0, 5, 0}).mayTouch(faraway));
    }
    EXPECT_TRUE(ShadowHull(box, {0, 0, 5, NotANumber}).mayTouch(faraway));
    EXPECT_TRUE(ShadowHull(box, {0, 0, 0, 0}).mayTouch(faraway)) << "no direction";
    EXPECT_TRUE(ShadowHull(box, {0, 0, 5, 1e-320}).mayTouch(faraway)) << "the quotient overflows";
    EXPECT_TRUE(ShadowHull(box, lamp).mayTouch(boxOf({1, 1, 1}, {0, 0, 0}, glm::dmat4(1.0))))
        << "an invalid box stands for unknown bounds";
    glm::dmat4 projective(1.0);
    projective[2][3] = -1.0;
    EXPECT_TRUE(ShadowHull(box, lamp).mayTouch(boxOf({50, 50, 50}, {51, 51, 51}, projective)));
}

TEST(ShadowHull, projectionsWithoutAFiniteFrustumTouchEverything)
{
    const Hexahedron box = boxOf({50, 50, 50}, {51, 51, 51}, glm::dmat4(1.0));
    const glm::dvec4 lamp(0, 0, 5, 1);
    EXPECT_FALSE(ShadowHull(frustumOf(glm::perspective(1.0, 1.0, 0.1, 1e3)), lamp).mayTouch(box));
    const glm::dmat4 endless = glm::infinitePerspective(1.0, 1.0, 0.1);
    EXPECT_TRUE(ShadowHull(frustumOf(endless), lamp).touchesEverything());
    EXPECT_FALSE(ShadowHull(nearRectangleOf(endless), lamp).touchesEverything());
    EXPECT_TRUE(
        ShadowHull(frustumOf(glm::perspective(1.0, 1.0, 1e-6, 1e9)), lamp).touchesEverything());
    glm::dmat4 atTheEye = glm::perspective(1.0, 1.0, 0.1, 1e3);
    atTheEye[2][2] = -1.0;
    atTheEye[3][2] = 0.0;
    EXPECT_TRUE(ShadowHull(frustumOf(atTheEye), lamp).touchesEverything()) << "near = 0";
    EXPECT_TRUE(ShadowHull(nearRectangleOf(atTheEye), lamp).touchesEverything());
    EXPECT_TRUE(ShadowHull(frustumOf(glm::dmat4(0.0)), lamp).touchesEverything());
}

TEST(ShadowHull, cornersOfAFrustumAreThoseOfItsMatrix)
{
    const Hexahedron corners = frustumOf(glm::frustum(-1.0, 2.0, -3.0, 4.0, 2.0, 2e6));
    EXPECT_NEAR(glm::length(corners[0] - glm::dvec3(-1, -3, -2)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(corners[3] - glm::dvec3(2, 4, -2)), 0.0, 1e-12);
    // A far plane of 1e6 times the near distance has lost ten of its sixteen digits.
    EXPECT_NEAR(glm::length(corners[7] / 1e6 - glm::dvec3(2, 4, -2)), 0.0, 1e-8);
}
