// SPDX-License-Identifier: MIT
#include "ReferenceLighting.h"

#include <osgShadowVolume/LitScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using osgShadowVolume::LitScene;

namespace
{

const osg::Vec4 Background(0.2f, 0.2f, 0.4f, 1.0f);

support::HeadlessViewer& theViewer()
{
    static support::HeadlessViewer viewer({160, 120});
    static const bool dark = (viewer.getViewer().setLightingMode(osg::View::NO_LIGHT), true);
    (void)dark;
    return viewer;
}

void look(ReferenceScene& scene, const osg::Vec3d& eye)
{
    scene.view = osg::Matrixd::lookAt(eye, osg::Vec3d(0, 0, 0), osg::Vec3d(0, 1, 0));
    scene.projection = osg::Matrixd::perspective(32.0, 4.0 / 3.0, 1.0, 12.0);
}

ReferenceScene sceneOf(ReferenceScene::Shape shape)
{
    ReferenceScene scene;
    scene.shape = shape;
    look(scene, osg::Vec3d(0.5, -1.5, 4.2));
    return scene;
}

osg::ref_ptr<osg::Light> lightAt(const osg::Vec4& position, unsigned int number = 0)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setPosition(position);
    light->setAmbient(osg::Vec4(0.1f, 0.05f, 0.0f, 1));
    light->setDiffuse(osg::Vec4(0.7f, 0.8f, 0.9f, 1));
    light->setSpecular(osg::Vec4(0.9f, 0.6f, 0.7f, 1));
    return light;
}

osg::ref_ptr<osg::Light> spotAt(const osg::Vec3& position, float cutoff, float exponent)
{
    const osg::ref_ptr<osg::Light> light = lightAt(osg::Vec4(position, 1));
    light->setDirection(osg::Vec3(0.1f, 0.2f, 0.0f) - position);
    light->setSpotCutoff(cutoff);
    light->setSpotExponent(exponent);
    return light;
}

/// Compares the per-pixel picture with the reference, everywhere but where a hundredth of a pixel
/// decides; 2/255, as the sum of two roundings and of float's error in the lighting equation.
void expectReference(const ReferenceScene& scene, const std::string& name, int width = 160,
                     int height = 120, double move = 0.02)
{
    SCOPED_TRACE(name);
    support::NotifyCapture notify;
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->setLighting(LitScene::Lighting::PIXEL);
    lit->setLightScope(LitScene::LightScope::ALL);
    lit->addChild(scene.createNode());
    const support::CameraSpec camera = {scene.view, scene.projection};
    const auto actual = theViewer().render(lit, camera, width, height);
    ASSERT_TRUE(actual.valid());
    const auto start = std::chrono::steady_clock::now();
    const ReferencePicture expected = renderReference(scene, width, height, Background, move);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (seconds.count() > 1.0)
        std::printf("%s: %.1f s for the reference\n", name.c_str(), seconds.count());
    EXPECT_LE(expected.getUndecidedShare(), 0.03) << "too little is compared";
    for (int i = 0; i < width * height; ++i)
    {
        if (expected.undecided[i])
            std::copy_n(expected.image->data(i % width, i / width), 4,
                        actual->data(i % width, i / width));
    }
    constexpr support::CompareImage Everywhere = {2.0 / 255.0, 0.0, 2.0 / 255.0};
    EXPECT_TRUE(Everywhere(actual, expected.image, "pixelLighting." + name));
    if (std::getenv("OSGKITS_KEEP_IMAGES"))
        support::writeImage(*actual, "pixelLighting." + name);
    for (const osgMultiRender::Plan& plan : lit->getPlans())
    {
        EXPECT_EQ(plan.counts.at("variants.failed"), 0.0) << toString(plan);
        EXPECT_EQ(plan.counts.at("leaves.fixedFunction"), 0.0) << toString(plan);
        EXPECT_GT(plan.counts.at("leaves.program"), 0.0) << toString(plan);
    }
}

/// On the plane and on the sphere, with the eye at infinity and as a local viewer.
void expectReferenceOnBoth(const osg::ref_ptr<osg::Light>& light, const std::string& name)
{
    for (bool local : {false, true})
    {
        for (auto shape : {ReferenceScene::Shape::Plane, ReferenceScene::Shape::Sphere})
        {
            ReferenceScene scene = sceneOf(shape);
            scene.localViewer = local;
            scene.lights = {light};
            expectReference(scene,
                            name + (shape == ReferenceScene::Shape::Plane ? ".plane" : ".sphere") +
                                (local ? ".localViewer" : ""));
        }
    }
}

/// n short-range point lights over the plane, each for its own cell of a square grid.
ReferenceScene manyLights(unsigned int n)
{
    ReferenceScene scene;
    look(scene, osg::Vec3d(0.0, -0.4, 3.0));
    scene.specular = osg::Vec4(0.2f, 0.2f, 0.2f, 1);
    const unsigned int side = std::ceil(std::sqrt(double(n)));
    const float cell = 3.0f / side;
    for (unsigned int i = 0; i < n; ++i)
    {
        const osg::Vec3 place(-1.5f + (i % side + 0.5f) * cell, -1.5f + (i / side + 0.5f) * cell,
                              0.4f * cell);
        const osg::ref_ptr<osg::Light> light = lightAt(osg::Vec4(place, 1), i);
        light->setAmbient(osg::Vec4());
        light->setDiffuse(osg::Vec4(0.2f + 0.4f * (i % 3), 0.2f + 0.4f * (i % 5) / 2,
                                    0.2f + 0.4f * (i % 7) / 3, 1));
        light->setSpecular(light->getDiffuse());
        light->setConstantAttenuation(1.0f);
        light->setQuadraticAttenuation(12.0f / (cell * cell));
        scene.lights.push_back(light);
    }
    return scene;
}

class PixelLightingOfMany : public testing::TestWithParam<unsigned int>
{
};

} // namespace

TEST(PixelLighting, sceneWithoutLightsShowsAmbientAndEmission)
{
    OSGKITS_NEED_GL(theViewer());
    expectReference(sceneOf(ReferenceScene::Shape::Plane), "none.plane");
    expectReference(sceneOf(ReferenceScene::Shape::Sphere), "none.sphere");
}

TEST(PixelLighting, directionalLightIsRight)
{
    OSGKITS_NEED_GL(theViewer());
    expectReferenceOnBoth(lightAt(osg::Vec4(0.4f, 0.3f, 0.8f, 0)), "directional");
}

TEST(PixelLighting, pointLightIsRightWithEachAttenuation)
{
    OSGKITS_NEED_GL(theViewer());
    const osg::Vec3 attenuations[] = {
        {1, 0, 0}, {2.5f, 0, 0}, {0, 0.8f, 0}, {0, 0, 0.6f}, {0.2f, 0.3f, 0.1f}};
    for (const osg::Vec3& attenuation : attenuations)
    {
        const osg::ref_ptr<osg::Light> light = lightAt(osg::Vec4(0.6f, 0.5f, 1.4f, 1));
        light->setConstantAttenuation(attenuation[0]);
        light->setLinearAttenuation(attenuation[1]);
        light->setQuadraticAttenuation(attenuation[2]);
        expectReferenceOnBoth(light, "point" + std::to_string(&attenuation - attenuations));
    }
}

TEST(PixelLighting, spotIsRightWithEachConeAndExponent)
{
    OSGKITS_NEED_GL(theViewer());
    for (float cutoff : {10.0f, 30.0f, 90.0f, 180.0f})
    {
        for (float exponent : {0.0f, 1.0f, 20.0f, 128.0f})
            expectReferenceOnBoth(spotAt(osg::Vec3(0.8f, -0.5f, 1.6f), cutoff, exponent),
                                  "spot" + std::to_string(int(cutoff)) + "Exponent" +
                                      std::to_string(int(exponent)));
    }
}

TEST(PixelLighting, aLightAtInfinityHasTheFactorOfItsCone)
{
    OSGKITS_NEED_GL(theViewer());
    for (float cutoff : {20.0f, 60.0f})
    {
        osg::ref_ptr<osg::Light> light = spotAt(osg::Vec3(0.8f, -0.5f, 1.6f), cutoff, 3.0f);
        light->setPosition(osg::Vec4(0.5f, 0.0f, 1.0f, 0.0f));
        light->setDirection(osg::Vec3(0.0f, 0.1f, -1.0f)); // 27 degrees off the light's own
        expectReferenceOnBoth(light, "infiniteSpot" + std::to_string(int(cutoff)));
    }
}

TEST(PixelLighting, lightsOfAllTypesTogetherAndEachShininessAreRight)
{
    OSGKITS_NEED_GL(theViewer());
    for (float shininess : {0.0f, 1.0f, 128.0f})
    {
        ReferenceScene scene = sceneOf(ReferenceScene::Shape::Sphere);
        scene.shininess = shininess;
        scene.lights = {lightAt(osg::Vec4(-0.4f, 0.3f, 0.8f, 0)),
                        lightAt(osg::Vec4(0.9f, -0.6f, 1.3f, 1), 1),
                        spotAt(osg::Vec3(-0.8f, -0.5f, 2.0f), 20.0f, 2.0f)};
        scene.lights[2]->setLightNum(2);
        for (const auto& light : scene.lights)
            light->setDiffuse(light->getDiffuse() * 0.4f);
        expectReference(scene, "together" + std::to_string(int(shininess)));
    }
}

TEST_P(PixelLightingOfMany, isRight)
{
    OSGKITS_NEED_GL(theViewer());
    const unsigned int n = GetParam();
    // the reference takes pixels times lights, so the short run draws small pictures of many;
    // nothing on an evenly lit plane is undecided
    const int width = std::getenv("OSGKITS_LONG") ? 160 : n > 4097 ? 40 : n > 64 ? 64 : 160;
    const int height = width * 3 / 4;
    expectReference(manyLights(n), "many" + std::to_string(n), width, height, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Lights, PixelLightingOfMany,
                         testing::Values(1u, 8u, 9u, 64u, 1024u, 4097u, 65536u),
                         testing::PrintToStringParamName());
