// SPDX-License-Identifier: MIT
#include "ShadowTruth.h"
#include "MaskComparison.h"
#include "SoupScene.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/Shape>
#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

#include <cmath>

using support::CameraSpec;
using truth::Seen;
using truth::ShadowTruth;

namespace
{

constexpr int Width = 160, Height = 120;

osg::ref_ptr<osg::Geode> geodeOf(const std::vector<osg::Vec3>& corners)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(corners.begin(), corners.end()));
    geometry->addPrimitiveSet(
        new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size())));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

std::vector<osg::Vec3> square(float size, float z)
{
    return {{-size, -size, z}, {size, -size, z}, {size, size, z},
            {-size, -size, z}, {size, size, z},  {-size, size, z}};
}

osg::ref_ptr<osg::LightSource> light(const osg::Vec4& position)
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setPosition(position);
    return source;
}

CameraSpec camera()
{
    return CameraSpec::perspective({1.0, -9.0, 7.0}, {0, 0, 0}, {0, 0, 1}, 35.0,
                                   double(Width) / Height, 1.0, 40.0);
}

/// The point of world coordinates that a pixel shows.
osg::Vec3d worldOf(const truth::Sample& sample, const CameraSpec& camera)
{
    return sample.point * osg::Matrixd::inverse(camera.view);
}

/// Compares each pixel of a floor at z = 0 with what `shadowed` says of its point; `margin` is the
/// distance to the shadow's edge within which nothing is asked.
template <class Distance> void expectFloor(osg::Group& scene, const Distance& distance)
{
    scene.addChild(geodeOf(square(3.0f, 0.0f)));
    const ShadowTruth truth(scene, camera());
    ASSERT_EQ(truth.getScene().lights.size(), 1u);
    const auto samples = truth.render(truth.getScene().lights[0], Width, Height);
    int lit = 0, shadowed = 0;
    for (const truth::Sample& sample : samples)
    {
        if (sample.seen == Seen::NOTHING)
            continue;
        const osg::Vec3d p = worldOf(sample, camera());
        if (std::abs(p.z()) > 1e-9)
            continue;
        const double d = distance(p);
        if (std::abs(d) < 1e-6)
            continue;
        ASSERT_EQ(sample.seen == Seen::SHADOWED, d < 0.0) << p.x() << " " << p.y();
        (d < 0.0 ? shadowed : lit)++;
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(shadowed, 50);
}

/// Signed distance to a square around a center.
double toSquare(const osg::Vec3d& p, double x, double y, double half)
{
    return std::max(std::abs(p.x() - x), std::abs(p.y() - y)) - half;
}

} // namespace

TEST(ShadowTruthTest, squareUnderAPointLightCastsItsCentralProjection)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({0.25f, 0.5f, 4.0f, 1.0f}));
    scene->addChild(geodeOf(square(0.5f, 1.0f)));
    // From height 4 the square at height 1 is 4/3 as large on the floor.
    expectFloor(*scene, [](const osg::Vec3d& p)
                { return toSquare(p, 0.25 - 0.25 * 4 / 3, 0.5 - 0.5 * 4 / 3, 0.5 * 4 / 3); });
}

TEST(ShadowTruthTest, squareUnderADirectionalLightIsMovedAlongTheLight)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({1.0f, -0.5f, 2.0f, 0.0f}));
    scene->addChild(geodeOf(square(0.5f, 1.0f)));
    expectFloor(*scene, [](const osg::Vec3d& p) { return toSquare(p, -0.5, 0.25, 0.5); });
}

TEST(ShadowTruthTest, lightBetweenTheSquareAndTheFloorCastsNothingOnTheFloor)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({0.0f, 0.0f, 0.5f, 1.0f}));
    scene->addChild(geodeOf(square(0.5f, 1.0f)));
    scene->addChild(geodeOf(square(3.0f, 0.0f)));
    const ShadowTruth truth(*scene, camera());
    int onTheFloor = 0;
    for (const truth::Sample& sample : truth.render(truth.getScene().lights[0], Width, Height))
    {
        if (sample.seen != Seen::NOTHING && std::abs(worldOf(sample, camera()).z()) < 1e-9)
        {
            ASSERT_EQ(sample.seen, Seen::LIT);
            ++onTheFloor;
        }
    }
    EXPECT_GT(onTheFloor, 100);
}

TEST(ShadowTruthTest, sphereUnderADirectionalLightIsDarkBehindItsTerminator)
{
    osg::ref_ptr<osg::TessellationHints> hints = new osg::TessellationHints;
    hints->setDetailRatio(6.0f);
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({1.0f, 0.2f, 0.5f, 0.0f}));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(), 1.0f), hints));
    scene->addChild(geode);
    const ShadowTruth truth(*scene, camera());
    osg::Vec3d toLight(1.0, 0.2, 0.5);
    toLight.normalize();
    int lit = 0, shadowed = 0;
    for (const truth::Sample& sample : truth.render(truth.getScene().lights[0], Width, Height))
    {
        if (sample.seen == Seen::NOTHING)
            continue;
        osg::Vec3d p = worldOf(sample, camera());
        p.normalize();
        // A facet spans 1.5 degrees, so its plane is within 0.03 of the sphere's.
        if (std::abs(p * toLight) < 0.03)
            continue;
        ASSERT_EQ(sample.seen == Seen::LIT, p * toLight > 0.0);
        (sample.seen == Seen::LIT ? lit : shadowed)++;
    }
    EXPECT_GT(lit, 100);
    EXPECT_GT(shadowed, 100);
}

TEST(ShadowTruthTest, surfaceLitFromBehindShadowsItselfOnBothSides)
{
    for (float z : {-2.0f, 2.0f})
    {
        osg::ref_ptr<osg::Group> scene = new osg::Group;
        scene->addChild(light({0.1f, 0.2f, z, 1.0f}));
        scene->addChild(geodeOf(square(1.0f, 0.0f)));
        const ShadowTruth truth(*scene, camera());
        const Seen seen = truth.sample(truth.getScene().lights[0], 0.05, 0.05).seen;
        EXPECT_EQ(seen, z < 0.0f ? Seen::SHADOWED : Seen::LIT);
    }
}

TEST(ShadowTruthTest, triangleWithTheLightInItsPlaneCastsNothing)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({2.0f, 0.3f, 0.0f, 1.0f}));
    scene->addChild(geodeOf(square(1.0f, 0.0f)));
    const ShadowTruth truth(*scene, camera());
    EXPECT_EQ(truth.sample(truth.getScene().lights[0], 0.05, 0.05).seen, Seen::LIT);
}

TEST(ShadowTruthTest, pointOutsideTheConeOfASpotIsUnreached)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    osg::ref_ptr<osg::LightSource> spot = light({0.0f, 0.0f, 2.0f, 1.0f});
    spot->getLight()->setDirection({0, 0, -1});
    spot->getLight()->setSpotCutoff(30.0f);
    scene->addChild(spot);
    scene->addChild(geodeOf(square(3.0f, 0.0f)));
    const ShadowTruth truth(*scene, camera());
    const double radius = 2.0 * std::tan(osg::DegreesToRadians(30.0));
    int inside = 0, outside = 0;
    for (const truth::Sample& sample : truth.render(truth.getScene().lights[0], Width, Height))
    {
        if (sample.seen == Seen::NOTHING)
            continue;
        const osg::Vec3d p = worldOf(sample, camera());
        const double r = std::hypot(p.x(), p.y());
        if (std::abs(r - radius) > 1e-6)
        {
            ASSERT_EQ(sample.seen, r < radius ? Seen::LIT : Seen::UNREACHED);
        }
        (r < radius ? inside : outside)++;
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 100);
}

TEST(ShadowTruthTest, mirroredAndMovedCastersShadowAsPlainOnes)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({0.25f, 0.5f, 4.0f, 1.0f}));
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
        osg::Matrixd::scale(-0.25, 0.5, -2.0) * osg::Matrixd::translate(0.0, 0.0, 1.0));
    std::vector<osg::Vec3> corners = square(1.0f, 0.0f);
    for (osg::Vec3& corner : corners)
        corner.x() *= 2.0f;
    transform->addChild(geodeOf(corners));
    scene->addChild(transform);
    expectFloor(*scene, [](const osg::Vec3d& p)
                { return toSquare(p, 0.25 - 0.25 * 4 / 3, 0.5 - 0.5 * 4 / 3, 0.5 * 4 / 3); });
}

/// Nothing of Embree's is trusted: each pixel again by a look at every triangle.
TEST(ShadowTruthTest, randomScenesLookTheSameWithoutEmbree)
{
    std::size_t pixels = 0;
    unsigned int different = 0;
    for (unsigned int seed = 1; seed <= 100; ++seed)
    {
        const SoupScene soup(seed);
        const ShadowTruth truth(*soup.createNode(), soup.camera);
        const truth::Light& l = truth.getScene().lights[0];
        for (int y = 0; y < 48; ++y)
        {
            for (int x = 0; x < 64; ++x, ++pixels)
            {
                const double u = (x + 0.5) / 32.0 - 1.0, v = (y + 0.5) / 24.0 - 1.0;
                different += truth.sample(l, u, v).seen != truth.sampleByAll(l, u, v).seen;
            }
        }
    }
    EXPECT_EQ(different, 0u) << "of " << pixels;
}

/// A picture that is off by nearly half a pixel has no leak: neither the truth nor the comparison
/// invents one. Pixels at grazing light and of slivers are the ones that could.
TEST(ShadowTruthTest, maskFromBesideThePixelCentersIsWrongInTheBandAlone)
{
    for (unsigned int seed : {1u, 2u, 3u, 4u, 5u, 241u, 254u, 361u, 508u, 561u, 591u, 622u, 739u})
    {
        const SoupScene soup(seed);
        const ShadowTruth truth(*soup.createNode(), soup.camera);
        const truth::Light& l = truth.getScene().lights[0];
        const truth::TruthPicture picture(truth, l, Width, Height);
        auto moved = picture.samples;
        for (int i = 0; i < Width * Height; ++i)
        {
            truth::Sample& sample = moved[i];
            sample = truth.sample(l, 2.0 * (i % Width + 0.95) / Width - 1.0,
                                  2.0 * (i / Width + 0.05) / Height - 1.0);
            if (sample.seen == Seen::UNREACHED)
                sample.seen = Seen::LIT;
        }
        const auto mask = truth::toImage(moved, Width, Height);
        const truth::MaskDifference difference =
            truth::compareMask(*mask, truth, l, picture, truth::matteWhite(picture));
        EXPECT_EQ(difference.leaks, 0u) << "seed " << seed;
        EXPECT_GT(difference.wrongBand, 0u) << "seed " << seed;
    }
}

/// Two surfaces nearer to each other than the depth buffer can tell may be taken for one another;
/// a surface's own side may not.
TEST(ShadowTruthTest, onlyWhatAnotherSurfaceMayHaveDecidedIsExcusedByTheDepthQuantum)
{
    // One quantum at this distance is about 5e-6.
    for (float gap : {1e-6f, 1e-3f})
    {
        osg::ref_ptr<osg::Group> scene = new osg::Group;
        scene->addChild(light({0.0f, 0.0f, 4.0f, 1.0f}));
        scene->addChild(geodeOf(square(1.0f, 0.0f)));
        std::vector<osg::Vec3> below = square(1.5f, -gap);
        scene->addChild(geodeOf(below));
        const ShadowTruth truth(*scene, camera());
        const truth::Light& l = truth.getScene().lights[0];
        EXPECT_EQ(truth.sample(l, 0.05, 0.05).seen, Seen::LIT);
        EXPECT_EQ(truth.isWithinDepthQuantum(l, 0.05, 0.05, Seen::SHADOWED), gap < 1e-5f);
    }
    osg::ref_ptr<osg::Group> alone = new osg::Group;
    alone->addChild(light({0.0f, 0.0f, 4.0f, 1.0f}));
    alone->addChild(geodeOf(square(1.0f, 0.0f)));
    const ShadowTruth truth(*alone, camera());
    EXPECT_FALSE(
        truth.isWithinDepthQuantum(truth.getScene().lights[0], 0.05, 0.05, Seen::SHADOWED));
}

TEST(ShadowTruthTest, wrongPixelsAreSortedIntoBandGrazingAndLeaks)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({0.25f, 0.5f, 4.0f, 1.0f}));
    scene->addChild(geodeOf(square(0.5f, 1.0f)));
    scene->addChild(geodeOf(square(3.0f, 0.0f)));
    const ShadowTruth truth(*scene, camera());
    const truth::Light& l = truth.getScene().lights[0];
    const truth::TruthPicture picture(truth, l, Width, Height);
    const auto& [width, height, samples, zones] = picture;
    const osg::ref_ptr<osg::Image> mask = truth::toImage(samples, Width, Height);
    const truth::LightColor color = truth::matteWhite(picture);
    EXPECT_EQ(truth::compareMask(*mask, truth, l, picture, color).leaks, 0u);
    unsigned int inBand = 0, elsewhere = 0;
    for (int i = 0; i < Width * Height; i += 7)
    {
        if (zones[i] != truth::Zone::BAND && zones[i] != truth::Zone::OTHER)
            continue;
        (zones[i] == truth::Zone::BAND ? inBand : elsewhere)++;
        std::fill_n(mask->data(i % Width, i / Width), 3, samples[i].seen == Seen::LIT ? 0 : 255);
    }
    const truth::MaskDifference difference = truth::compareMask(*mask, truth, l, picture, color);
    EXPECT_GT(inBand, 0u);
    EXPECT_EQ(difference.wrongBand, inBand);
    EXPECT_EQ(difference.leaks, elsewhere);
    EXPECT_EQ(difference.withinQuantum, 0u);
}

/// At grazing light a wrong pixel is excused where nobody sees it, and only there.
TEST(ShadowTruthTest, wrongPixelAtGrazingLightIsExcusedWhereItsColorIsRight)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({1.0f, 0.0f, 0.01f, 0.0f}));
    scene->addChild(geodeOf(square(3.0f, 0.0f)));
    const ShadowTruth truth(*scene, camera());
    const truth::Light& l = truth.getScene().lights[0];
    const truth::TruthPicture picture(truth, l, Width, Height);
    const osg::ref_ptr<osg::Image> mask = truth::toImage(picture.samples, Width, Height);
    // Beside the edge between the two triangles of the floor.
    constexpr int X = Width / 2 + 15, Y = Height / 2;
    ASSERT_EQ(picture.zones[Y * Width + X], truth::Zone::GRAZING);
    std::fill_n(mask->data(X, Y), 3, 0);
    for (float color : {0.0f, 0.9f / 255.0f, 1.1f / 255.0f})
    {
        const truth::MaskDifference difference =
            truth::compareMask(*mask, truth, l, picture, [&](int, int) { return color; });
        const bool isRight = color < 1.0f / 255.0f;
        EXPECT_EQ(difference.wrongGrazing, isRight ? 1u : 0u);
        EXPECT_EQ(difference.worstGrazing, isRight ? color : 0.0f);
        EXPECT_EQ(difference.leaks, isRight ? 0u : 1u);
    }
    // White surfaces get a hundredth of the light: 2.5/255.
    EXPECT_EQ(truth::compareMask(*mask, truth, l, picture, truth::matteWhite(picture)).leaks, 1u);
}

TEST(ShadowTruthTest, objectsEndWhereTheDepthJumps)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(light({0.0f, 0.0f, 4.0f, 1.0f}));
    scene->addChild(geodeOf(square(0.5f, 1.0f)));
    scene->addChild(geodeOf(square(3.0f, 0.0f)));
    const ShadowTruth truth(*scene, camera());
    const truth::Light& l = truth.getScene().lights[0];
    const auto triangleAt = [&](double x, double y) { return truth.sample(l, x, y).triangle; };
    // Both triangles of the upper square, and both squares.
    ASSERT_EQ(triangleAt(-0.03, 0.24), 1);
    ASSERT_EQ(triangleAt(0.03, 0.2), 0);
    EXPECT_FALSE(truth.isObjectEdgeBetween({-0.03, 0.24}, {0.03, 0.2}));
    ASSERT_GE(triangleAt(0.0, 0.4), 2);
    EXPECT_TRUE(truth.isObjectEdgeBetween({0.0, 0.4}, {0.0, 0.22}));
    EXPECT_TRUE(truth.isObjectEdgeBetween({0.0, 0.22}, {0.0, 0.4}));
    // And the end of everything.
    ASSERT_EQ(triangleAt(0.0, 0.99), -1);
    EXPECT_TRUE(truth.isObjectEdgeBetween({0.0, 0.4}, {0.0, 0.99}));
}
