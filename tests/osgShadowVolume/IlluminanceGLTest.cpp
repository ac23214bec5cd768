// SPDX-License-Identifier: MIT
#include "MeasuredScenes.h"

#include <osgShadowVolume/FalseColors.h>
#include <osgShadowVolume/IlluminanceProbe.h>
#include <osgShadowVolume/ShadowedScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ValueObject>

#include <cmath>
#include <functional>
#include <random>

using namespace osgShadowVolume;

namespace
{

constexpr int Width = 160, Height = 120;

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer made;
    return made;
}

osg::ref_ptr<ShadowedScene> measuring(osg::Node& model, Show show = Show::LUX)
{
    osg::ref_ptr<ShadowedScene> scene = new ShadowedScene;
    scene->addChild(&model);
    scene->setShow(show);
    return scene;
}

support::CameraSpec camera(const osg::Vec3d& eye, const osg::Vec3d& center, double size)
{
    return support::CameraSpec::perspective(eye, center, osg::Vec3d(0.0, 0.1, 1.0), 60.0,
                                            double(Width) / Height, 0.002 * size, 20.0 * size);
}

/// Where a pixel's ray from the eye meets the scene, and the normal there, on the side of the eye.
struct Surface
{
    osg::Vec3d point, normal;
};

/// Compares each pixel with the probe where the surfaces below are planes given by the caller.
class PixelsAgainstProbe
{
public:
    PixelsAgainstProbe(osg::Node& model, const ShadowSettings& settings)
        : _model(model), _probe(model, settings)
    {
        EXPECT_EQ(_probe.getError(), "");
    }

    /// Pixels of a plane: the share of those that the mask names is within half a percent.
    void expectPlane(const osg::Image* lux, const support::CameraSpec& spec,
                     const osg::Vec3d& origin, const osg::Vec3d& normal,
                     const std::function<bool(const osg::Vec3d&)>& isOnPlane)
    {
        ASSERT_TRUE(lux);
        const osg::Matrixd toWorld = osg::Matrixd::inverse(spec.view * spec.projection);
        const osg::Vec3d eye = osg::Vec3d() * osg::Matrixd::inverse(spec.view);
        int compared = 0, atShadows = 0;
        for (int y = 1; y + 1 < Height; ++y)
            for (int x = 1; x + 1 < Width; ++x)
            {
                const auto at = [&](double dx, double dy)
                {
                    const osg::Vec3d ndc(2.0 * (x + 0.5 + dx) / Width - 1.0,
                                         2.0 * (y + 0.5 + dy) / Height - 1.0, 0.5);
                    const osg::Vec3d way = ndc * toWorld - eye;
                    return eye + way * (((origin - eye) * normal) / (way * normal));
                };
                const auto valueAt = [&](double dx, double dy)
                { return _probe.measure(at(dx, dy), normal).lux; };
                bool inside = true;
                for (const double dx : {-1.0, 0.0, 1.0})
                    for (const double dy : {-1.0, 0.0, 1.0})
                        inside = inside && isOnPlane(at(dx, dy));
                if (!inside)
                    continue;
                // A shadow's edge within a pixel: on which side its centre lies is rounding.
                const double expected = valueAt(0.0, 0.0);
                bool isEven = true;
                for (const double d : {-0.1, 0.1})
                    isEven = isEven && (valueAt(d, d) > 0.0) == (expected > 0.0) &&
                             (valueAt(d, -d) > 0.0) == (expected > 0.0);
                if (!isEven)
                {
                    ++atShadows;
                    continue;
                }
                ++compared;
                const float found = lux->getColor(unsigned(x), unsigned(y)).r();
                EXPECT_NEAR(found, expected, 0.005 * expected)
                    << "pixel " << x << ", " << y << " at " << at(0, 0).x() << ", " << at(0, 0).y()
                    << ", " << at(0, 0).z();
                if (testing::Test::HasFailure())
                    return;
            }
        EXPECT_GT(compared, 250);
        EXPECT_LT(atShadows, compared / 5);
    }

private:
    osg::Node& _model;
    IlluminanceProbe _probe;
};

osg::ref_ptr<osg::Group> floorOf(float side)
{
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->setUserValue("metresPerUnit", 1.0);
    scene->addChild(measured::quad(osg::Vec3(-side, -side, 0.0f), osg::Vec3(2 * side, 0, 0),
                                   osg::Vec3(0, 2 * side, 0)));
    return scene;
}

bool isAnywhere(const osg::Vec3d&)
{
    return true;
}

osg::ref_ptr<osg::Image> luxOf(osg::Node& model, const support::CameraSpec& spec)
{
    return viewer().renderFloat(measuring(model), spec, Width, Height, 2);
}

/// The floor's pixels against the probe, from 4 units above.
void expectFloor(osg::Group& scene)
{
    const support::CameraSpec spec = camera(osg::Vec3d(0, -0.5, 4), osg::Vec3d(), 1.0);
    const osg::ref_ptr<osg::Image> lux = luxOf(scene, spec);
    PixelsAgainstProbe(scene, ShadowSettings())
        .expectPlane(lux.get(), spec, osg::Vec3d(), osg::Vec3d(0, 0, 1), isAnywhere);
}

} // namespace

class IlluminanceGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }
    support::NotifyCapture _capture;
};

TEST_F(IlluminanceGLTest, pointLightKeepsInverseSquareAndCosine)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::pointLight(1, osg::Vec3(0.5f, 0.2f, 1.5f), "candela=250", *scene));
    expectFloor(*scene);
}

TEST_F(IlluminanceGLTest, spotFallsOffAndEndsAtItsCutoff)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::spotLight(1, osg::Vec3(0, 0, 2), 40.0f, 3.0f, "lumen=900", *scene));
    expectFloor(*scene);
}

TEST_F(IlluminanceGLTest, directionalLightCastsShadows)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::sun(2, osg::Vec3(1, 2, 3), "lux=90000", *scene));
    scene->addChild(measured::quad(osg::Vec3(0.5f, 0.9f, 1.0f), osg::Vec3(0.6f, 0, 0),
                                   osg::Vec3(0, 0.6f, 0.2f)));
    const support::CameraSpec spec = camera(osg::Vec3d(0, -0.5, 4), osg::Vec3d(), 1.0);
    const osg::ref_ptr<osg::Image> lux = luxOf(*scene, spec);
    PixelsAgainstProbe(*scene, ShadowSettings())
        .expectPlane(lux.get(), spec, osg::Vec3d(), osg::Vec3d(0, 0, 1),
                     [](const osg::Vec3d& p) { return p.x() < 0.3 && p.y() < 0.8; });
}

TEST_F(IlluminanceGLTest, classRoomIsTheProbesInMetresAndMillimetres)
{
    for (double scale : {1.0, 1e-3})
    {
        const osg::ref_ptr<osg::Group> room = measured::classRoom(scale);
        const double m = 1.0 / scale;
        const support::CameraSpec spec =
            camera(osg::Vec3d(7.0, 1.0, 2.9) * m, osg::Vec3d(4.0, 3.0, 0.4) * m, m);
        const osg::ref_ptr<osg::Image> lux = luxOf(*room, spec);
        PixelsAgainstProbe pixels(*room, ShadowSettings());
        const auto isDesk = [m](const osg::Vec3d& p)
        { return std::abs(p.x() / m - 4.0) < 0.79 && std::abs(p.y() / m - 3.0) < 0.39; };
        pixels.expectPlane(lux.get(), spec, osg::Vec3d(0, 0, 0.75) * m, osg::Vec3d(0, 0, 1),
                           isDesk);
        const osg::Vec3d eye(7.0, 1.0, 2.9);
        pixels.expectPlane(
            lux.get(), spec, osg::Vec3d(), osg::Vec3d(0, 0, 1),
            [&](const osg::Vec3d& p)
            {
                const osg::Vec3d floor = p / m;
                // Not where the desk hides the floor.
                for (double z : {0.72, 0.75})
                {
                    const osg::Vec3d d = eye + (floor - eye) * ((eye.z() - z) / eye.z());
                    if (std::abs(d.x() - 4.0) < 0.9 && std::abs(d.y() - 3.0) < 0.5)
                        return false;
                }
                return floor.x() > 0.1 && floor.x() < 7.9 && floor.y() > 0.1 && floor.y() < 5.9;
            });
    }
}

TEST_F(IlluminanceGLTest, hundredLightsAddUp)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> at(-3.0f, 3.0f);
    for (int i = 0; i < 100; ++i)
    {
        const osg::Vec3 position(at(random), at(random), 4.0f + at(random));
        const std::string candela = "candela=" + std::to_string(i + 1);
        scene->addChild(i % 2 ? measured::pointLight(i, position, candela, *scene)
                              : measured::spotLight(i, position, 50.0f, 1.0f, candela, *scene));
    }
    expectFloor(*scene);
}

TEST_F(IlluminanceGLTest, sideThatIsSeenIsMeasured)
{
    // Normals point down; seen from above, the light above counts. Also without normals, without
    // lighting and blended.
    const support::CameraSpec spec = camera(osg::Vec3d(0, -0.5, 4), osg::Vec3d(), 1.0);
    for (int kind = 0; kind < 3; ++kind)
    {
        const osg::ref_ptr<osg::Group> scene = new osg::Group;
        scene->setUserValue("metresPerUnit", 1.0);
        const osg::ref_ptr<osg::Node> down =
            measured::quad(osg::Vec3(-9, -9, 0), osg::Vec3(0, 18, 0), osg::Vec3(18, 0, 0));
        scene->addChild(down);
        osg::StateSet& state = *down->getOrCreateStateSet();
        if (kind == 1)
        {
            down->asDrawable()->asGeometry()->setNormalArray(nullptr);
            state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        }
        if (kind == 2)
        {
            osg::Vec4 glass(1.0f, 0.5f, 0.5f, 0.3f);
            osg::Geometry& geometry = *down->asDrawable()->asGeometry();
            geometry.setColorArray(new osg::Vec4Array(1, &glass), osg::Array::BIND_OVERALL);
            state.setAttributeAndModes(new osg::BlendFunc);
            state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        }
        scene->addChild(measured::pointLight(1, osg::Vec3(0, 0, 2), "candela=400", *scene));
        const osg::ref_ptr<osg::Image> lux = luxOf(*scene, spec);
        PixelsAgainstProbe(*scene, ShadowSettings())
            .expectPlane(lux.get(), spec, osg::Vec3d(), osg::Vec3d(0, 0, 1), isAnywhere);
    }
}

TEST_F(IlluminanceGLTest, falseColorsAreThoseOfTheLegend)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::sun(1, osg::Vec3(0, 3, 4), "lux=1000", *scene));
    const support::CameraSpec spec = camera(osg::Vec3d(0, -0.5, 4), osg::Vec3d(), 1.0);
    const osg::ref_ptr<ShadowedScene> group = measuring(*scene, Show::ILLUMINANCE);
    group->setIlluminanceMaximum(2000.0);
    const osg::ref_ptr<osg::Image> picture = viewer().render(group, spec, 320, 240, 2);
    const glm::vec3 expected = falseColor(0.4);
    const osg::Vec4 found = picture->getColor(300u, 120u);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], 1.5 / 255.0);
    support::writeImage(*picture, "luxLegend");
    // The bar of the legend lies at the left; its colours run through the whole range.
    for (double share : {0.1, 0.5, 0.9})
    {
        const unsigned int y = unsigned(std::lround(42.0 + 144.0 * share));
        const glm::vec3 color = falseColor(share);
        const osg::Vec4 bar = picture->getColor(17u, y);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(bar[i], color[i], 0.06) << share;
    }
}

TEST_F(IlluminanceGLTest, unknownIntensityIsMagentaAndSaidOnce)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::pointLight(3, osg::Vec3(0, 0, 2), "", *scene));
    const support::CameraSpec spec = camera(osg::Vec3d(0, -0.5, 4), osg::Vec3d(), 1.0);
    const osg::ref_ptr<osg::Image> lux = luxOf(*scene, spec);
    EXPECT_EQ(lux->getColor(80u, 60u), osg::Vec4(1.0f, 0.0f, 1.0f, 1.0f));
    EXPECT_EQ(_capture.takeWarnings(),
              support::NotifyCapture::Lines{
                  "osgShadowVolume::ShadowedScene: no illuminance without intensities: light 3: it "
                  "states no candela=<number>; what they light is magenta"});
}

TEST_F(IlluminanceGLTest, viewersHeadlightIsNoLamp)
{
    const osg::ref_ptr<osg::Group> scene = floorOf(10.0f);
    scene->addChild(measured::pointLight(1, osg::Vec3(0, 0, 2), "candela=100", *scene));
    viewer().getViewer().setLightingMode(osg::View::HEADLIGHT);
    expectFloor(*scene);
    viewer().getViewer().setLightingMode(osg::View::NO_LIGHT);
}
