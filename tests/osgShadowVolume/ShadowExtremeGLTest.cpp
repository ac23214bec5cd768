// SPDX-License-Identifier: MIT
#include "ExtremeMesh.h"
#include "MaskCheck.h"

#include <support/NotifyCapture.h>

#include <osg/CullFace>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <limits>

using support::CameraSpec;

namespace
{

constexpr double Aspect = 4.0 / 3.0;

truth::MaskCheck& check()
{
    static truth::MaskCheck check(160, 120);
    return check;
}

CameraSpec outside()
{
    return CameraSpec::perspective({2.6, -6.4, 4.9}, {0, 0, 0.6}, {0, 0, 1}, 34.0, Aspect, 1.0,
                                   30.0);
}

osg::Vec4 high()
{
    return {1.3f, -0.7f, 4.1f, 1.0f};
}

/// The mesh over a floor of 6 x 6 at z = 0.
ExtremeMesh floorAndMesh(const ExtremeMesh& mesh)
{
    ExtremeMesh all = mesh;
    all.plate(3.0f, 0.0f);
    return all;
}

/// The caster and a floor as two drawables, under one light.
osg::ref_ptr<osg::Group> sceneOf(osg::Node& caster, const osg::Vec4& light)
{
    ExtremeMesh floor;
    floor.plate(3.0f, 0.0f);
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(&caster);
    scene->addChild(floor.createNode());
    scene->addChild(truth::makeSource(0, light));
    return scene;
}

/// No leak by any technique; and there is something to see, both lit and shadowed, if `both`.
void expectNoLeak(osg::Node& scene, const CameraSpec& camera, const std::string& name,
                  bool both = true, int light = 0)
{
    const truth::MaskResult result = check().compare(scene, camera, light, "extreme." + name);
    for (const auto& [way, difference] : result.differences)
    {
        EXPECT_GT(difference.object, 0u) << name;
        EXPECT_EQ(difference.withinRounding, 0u) << name << ": the place of a light is exact here";
        if (!both)
            continue;
        EXPECT_GT(difference.shadowed, 0u) << name << ": nothing is in shadow";
        EXPECT_LT(difference.shadowed, difference.object) << name << ": all is in shadow";
    }
}

void expectNoLeak(const ExtremeMesh& caster, const osg::Vec4& light, const std::string& name,
                  bool both = true)
{
    expectNoLeak(*sceneOf(*caster.createNode(), light), outside(), name, both);
}

ExtremeMesh theBox()
{
    ExtremeMesh mesh;
    mesh.box({-0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, 1.5f});
    return mesh;
}

ExtremeMesh theSphere()
{
    ExtremeMesh mesh;
    mesh.sphere({0.0f, 0.0f, 1.0f}, 0.8f);
    return mesh;
}

class ShadowExtremeGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(check().getViewer()); }
};

} // namespace

TEST_F(ShadowExtremeGLTest, lightExactlyInAFacePlane)
{
    expectNoLeak(theBox(), {2.0f, 0.3f, 1.5f, 1.0f}, "facePlane.top");
    expectNoLeak(theBox(), {0.5f, 3.0f, 2.0f, 1.0f}, "facePlane.side");
    expectNoLeak(theBox(), {1.0f, 0.0f, 0.0f, 0.0f}, "facePlane.directional", false);
    expectNoLeak(theBox(), {0.0f, 0.6f, 0.8f, 0.0f}, "facePlane.directionalSide");
}

TEST_F(ShadowExtremeGLTest, lightOnAnEdgeOrOnItsLine)
{
    expectNoLeak(theBox(), {0.5f, 0.5f, 1.0f, 1.0f}, "edge");
    expectNoLeak(theBox(), {0.5f, 0.5f, 3.0f, 1.0f}, "edgeLine");
    expectNoLeak(theBox(), {0.5f, 0.0f, 1.5f, 1.0f}, "edgeTop");
}

TEST_F(ShadowExtremeGLTest, lightOnAVertex)
{
    expectNoLeak(theBox(), {0.5f, 0.5f, 1.5f, 1.0f}, "vertex");
    expectNoLeak(theBox(), {0.5f, -0.5f, 1.5f, 1.0f}, "vertexFront");
}

TEST_F(ShadowExtremeGLTest, lightInsideAClosedCasterLightsNothingOutside)
{
    expectNoLeak(theBox(), {0.1f, 0.05f, 1.0f, 1.0f}, "insideCaster", false);
    expectNoLeak(theSphere(), {0.1f, 0.05f, 1.0f, 1.0f}, "insideSphere", false);
}

TEST_F(ShadowExtremeGLTest, lightAndCameraInsideAClosedRoom)
{
    ExtremeMesh mesh = theBox();
    mesh.box({-4.0f, -4.0f, 0.0f}, {4.0f, 4.0f, 3.0f});
    const osg::ref_ptr<osg::Group> scene = sceneOf(*mesh.createNode(), {1.3f, -0.7f, 2.6f, 1.0f});
    expectNoLeak(*scene,
                 CameraSpec::perspective({-3.5, -3.2, 2.2}, {0, 0, 0.8}, {0, 0, 1}, 70.0, Aspect,
                                         0.05, 30.0),
                 "room");
}

TEST_F(ShadowExtremeGLTest, cameraInsideAVolume)
{
    ExtremeMesh mesh;
    mesh.plate(1.5f, 2.0f);
    const osg::ref_ptr<osg::Group> scene = sceneOf(*mesh.createNode(), high());
    expectNoLeak(*scene,
                 CameraSpec::perspective({-0.5, 0.3, 1.2}, {2.6, -1.9, 0.0}, {0, 0, 1}, 75.0,
                                         Aspect, 0.05, 30.0),
                 "insideVolume");
    // Inside of two, one of them cast by what is behind the camera.
    mesh.box({-0.3f, 0.1f, 1.4f}, {0.1f, 0.6f, 1.6f});
    expectNoLeak(*sceneOf(*mesh.createNode(), high()),
                 CameraSpec::perspective({-0.5, 0.3, 1.0}, {2.6, -1.9, 0.0}, {0, 0, 1}, 75.0,
                                         Aspect, 0.05, 30.0),
                 "insideVolumes");
}

/// The rays of an orthographic view never leave a volume that opens towards them: its far end
/// decides, however near the light is to the caster.
TEST_F(ShadowExtremeGLTest, orthographicViewsFromInsideAVolume)
{
    ExtremeMesh mesh;
    mesh.plate(0.9f, 1.5f);
    mesh.quad({-0.9f, -1.4f, 1.2f}, {1.1f, -1.2f, 1.3f}, {1.0f, 1.3f, 1.9f}, {-1.2f, 0.8f, 1.7f});
    for (float height : {4.1f, 2.0f, 1.51f, 1e5f})
    {
        const float side = std::max(1.0f, 0.3f * height);
        const osg::ref_ptr<osg::Group> scene =
            sceneOf(*mesh.createNode(), {0.21f * side, -0.13f * side, height, 1.0f});
        for (int i = 0; i < 6; ++i)
        {
            const osg::Vec3d eye(0.1, 0.05, 1.1);
            const osg::Vec3d way(0.3 * std::sin(1.1 * i), 0.3 * std::cos(1.7 * i), -1.0);
            CameraSpec camera =
                CameraSpec::perspective(eye, eye + way, {0.1, 1.0, 0.2}, 40.0, Aspect, 0.1, 10.0);
            camera.projection = osg::Matrixd::ortho(-1.2, 1.2, -0.9, 0.9, 0.0, 4.0);
            expectNoLeak(*scene, camera,
                         "insideOrthographic" + std::to_string(int(height * 100.0f)) + "." +
                             std::to_string(i),
                         false);
        }
    }
}

TEST_F(ShadowExtremeGLTest, cameraAtTheLightSeesNoShadow)
{
    expectNoLeak(theBox(), {2.6f, -6.4f, 4.9f, 1.0f}, "atTheLight", false);
    const osg::Vec3 toEye = osg::Vec3(2.6f, -6.4f, 4.3f);
    const osg::ref_ptr<osg::Group> scene = sceneOf(*theBox().createNode(), osg::Vec4(toEye, 0.0f));
    CameraSpec camera = outside();
    camera.projection = osg::Matrixd::ortho(-2.4, 2.4, -1.8, 1.8, 1.0, 20.0);
    expectNoLeak(*scene, camera, "alongTheView", false);
}

TEST_F(ShadowExtremeGLTest, nearPlaneCuttingVolumesAndCasters)
{
    for (double nearPlane : {6.0, 7.0, 7.8, 8.4})
    {
        CameraSpec camera = outside();
        camera.projection = osg::Matrixd::perspective(34.0, Aspect, nearPlane, 30.0);
        const auto number = std::to_string(int(nearPlane * 10.0));
        expectNoLeak(*sceneOf(*theSphere().createNode(), high()), camera, "near" + number);
        expectNoLeak(*sceneOf(*theBox().createNode(), {0.4f, -3.5f, 3.0f, 1.0f}), camera,
                     "nearBox" + number);
    }
}

TEST_F(ShadowExtremeGLTest, sliversOfAspectOneToAMillion)
{
    ExtremeMesh strips;
    // A plate of three parts, the middle one a millionth wide.
    const float low = 0.25f, top = low + 1e-6f;
    for (const auto& [a, b] : {std::make_pair(-0.8f, low), {low, top}, {top, 0.9f}})
        strips.quad({a, -0.7f, 1.0f}, {b, -0.7f, 1.0f}, {b, 0.6f, 1.3f}, {a, 0.6f, 1.3f});
    expectNoLeak(strips, high(), "slivers.plate");
    ExtremeMesh disc;
    // Around a point that is almost on the rim: slivers with two long edges.
    for (int i = 0; i < 40; ++i)
    {
        const auto rim = [](int k)
        {
            const float angle = 2.0f * 3.14159265f * float(k % 40) / 40.0f;
            return osg::Vec3(std::cos(angle), std::sin(angle), 1.0f + 0.2f * std::cos(angle));
        };
        disc.triangle(rim(0) - osg::Vec3(1e-6f, 0.0f, 0.0f), rim(i), rim(i + 1));
    }
    expectNoLeak(disc, high(), "slivers.fan");
    ExtremeMesh lone;
    lone.triangle({-1.0f, -0.5f, 1.0f}, {1.0f, 0.5f, 1.2f}, {1.0f, 0.500002f, 1.2f});
    expectNoLeak(lone, high(), "slivers.alone", false);
}

TEST_F(ShadowExtremeGLTest, manyTrianglesAtOneEdge)
{
    for (unsigned int count : {3u, 29u, 30u, 31u, 100u})
    {
        ExtremeMesh mesh;
        mesh.fan(count);
        expectNoLeak(mesh, high(), "fan" + std::to_string(count));
    }
}

TEST_F(ShadowExtremeGLTest, openSheet)
{
    ExtremeMesh mesh;
    mesh.sheet(16);
    expectNoLeak(mesh, high(), "sheet");
    expectNoLeak(mesh, {1.0f, 0.2f, 0.3f, 0.0f}, "sheet.directional");
    expectNoLeak(mesh, {0.1f, 0.2f, 0.6f, 1.0f}, "sheet.below");
}

TEST_F(ShadowExtremeGLTest, whatIsSeenThroughACasterThatIsNotDrawnIsInItsShadow)
{
    for (const osg::CullFace::Mode mode : {osg::CullFace::FRONT, osg::CullFace::BACK})
    {
        ExtremeMesh mesh;
        mesh.sheet(16);
        osg::ref_ptr<osg::Node> caster = mesh.createNode();
        caster->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace(mode));
        expectNoLeak(*sceneOf(*caster, high()), outside(), "culled");
        expectNoLeak(*sceneOf(*caster, {0.1f, 0.2f, 3.0f, 1.0f}), outside(), "culled.above");
    }
}

TEST_F(ShadowExtremeGLTest, moebiusStrip)
{
    ExtremeMesh mesh;
    mesh.moebius(48);
    expectNoLeak(mesh, high(), "moebius");
    expectNoLeak(mesh, {0.05f, 0.0f, 1.0f, 1.0f}, "moebius.center");
}

TEST_F(ShadowExtremeGLTest, reversedAndMixedWinding)
{
    for (std::size_t n : {1u, 2u, 3u})
    {
        ExtremeMesh mesh = theSphere();
        mesh.flip(n);
        expectNoLeak(mesh, high(), "winding" + std::to_string(n));
    }
}

TEST_F(ShadowExtremeGLTest, duplicatedFaces)
{
    for (std::size_t n : {1u, 2u, 5u})
    {
        ExtremeMesh mesh = theSphere();
        mesh.duplicate(n);
        mesh.duplicate(7);
        expectNoLeak(mesh, high(), "duplicates" + std::to_string(n));
        mesh.flip(3);
        expectNoLeak(mesh, high(), "duplicatesFlipped" + std::to_string(n));
    }
}

TEST_F(ShadowExtremeGLTest, trianglesWithoutArea)
{
    ExtremeMesh mesh = theSphere();
    const std::vector<osg::Vec3> corners = mesh.corners;
    for (std::size_t i = 0; i < corners.size(); i += 15)
    {
        mesh.triangle(corners[i], corners[i], corners[i + 1]);
        mesh.triangle(corners[i], corners[i], corners[i]);
        // Three points of a line: the middle is exact.
        mesh.triangle(corners[i], (corners[i] + corners[i + 1]) * 0.5f, corners[i + 1]);
    }
    expectNoLeak(mesh, high(), "noArea");
}

TEST_F(ShadowExtremeGLTest, tJunctionsWhereTheMiddleIsExact)
{
    ExtremeMesh mesh;
    // The left half has one long edge where the right one has two.
    mesh.quad({-1.0f, -0.75f, 1.0f}, {0.0f, -0.75f, 1.0f}, {0.0f, 0.75f, 1.5f},
              {-1.0f, 0.75f, 1.5f});
    mesh.quad({0.0f, -0.75f, 1.0f}, {1.0f, -0.75f, 1.0f}, {1.0f, 0.0f, 1.25f}, {0.0f, 0.0f, 1.25f});
    mesh.quad({0.0f, 0.0f, 1.25f}, {1.0f, 0.0f, 1.25f}, {1.0f, 0.75f, 1.5f}, {0.0f, 0.75f, 1.5f});
    expectNoLeak(mesh, high(), "tJunction");
}

TEST_F(ShadowExtremeGLTest, moreVolumesThanEightBitsCount)
{
    for (int layers : {256, 300, 512})
    {
        ExtremeMesh mesh;
        for (int i = 0; i < layers; ++i)
            mesh.plate(0.8f, 1.0f + 0.002f * float(i));
        expectNoLeak(mesh, {0.4f, -0.2f, 8.0f, 1.0f}, "layers" + std::to_string(layers));
    }
    ExtremeMesh nested;
    for (int i = 0; i < 300; ++i)
        nested.box({-0.5f - 0.002f * float(i), -0.5f, 0.5f + 0.001f * float(i)},
                   {0.5f, 0.5f, 1.5f + 0.002f * float(i)});
    expectNoLeak(nested, high(), "nested");
    ExtremeMesh same;
    for (int i = 0; i < 512; ++i)
        same.plate(0.8f, 1.0f);
    expectNoLeak(same, high(), "sameLayers");
}

namespace
{

/// The sphere and the box over the floor, moved by `matrix`, with camera and light moved along: as
/// a transform in double, and, if `inVertices`, in the vertices themselves.
void expectNoLeakMoved(const osg::Matrixd& matrix, bool inVertices, const std::string& name)
{
    ExtremeMesh mesh = theSphere();
    mesh.box({0.9f, 0.4f, 0.3f}, {1.6f, 1.2f, 0.9f});
    mesh = floorAndMesh(mesh);
    if (inVertices)
        mesh.transform(matrix);
    osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(inVertices ? osg::Matrixd() : matrix);
    transform->addChild(mesh.createNode());
    osg::ref_ptr<osg::MatrixTransform> lights = new osg::MatrixTransform(matrix);
    lights->addChild(truth::makeSource(0, high()));
    lights->addChild(truth::makeSource(1, {0.5f, -0.3f, 0.8f, 0.0f}));
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(transform);
    scene->addChild(lights);
    const double size = osg::Matrixd::transform3x3(osg::Vec3d(1, 0, 0), matrix).length();
    const CameraSpec camera =
        CameraSpec::perspective(osg::Vec3d(2.6, -6.4, 4.9) * matrix, osg::Vec3d(0, 0, 0.6) * matrix,
                                {0, 0, 1}, 34.0, Aspect, size, 30.0 * size);
    expectNoLeak(*scene, camera, name + ".point", true, 0);
    expectNoLeak(*scene, camera, name + ".directional", true, 1);
}

} // namespace

TEST_F(ShadowExtremeGLTest, tinyAndHugeScalesInTheTransform)
{
    expectNoLeakMoved(osg::Matrixd::scale(1e-6, 1e-6, 1e-6), false, "tinyTransform");
    expectNoLeakMoved(osg::Matrixd::scale(1e7, 1e7, 1e7), false, "hugeTransform");
}

TEST_F(ShadowExtremeGLTest, tinyAndHugeScalesInTheVertices)
{
    expectNoLeakMoved(osg::Matrixd::scale(1e-6, 1e-6, 1e-6), true, "tinyVertices");
    expectNoLeakMoved(osg::Matrixd::scale(1e7, 1e7, 1e7), true, "hugeVertices");
}

TEST_F(ShadowExtremeGLTest, offsetOfTenMillionInTheTransform)
{
    expectNoLeakMoved(osg::Matrixd::translate(1e7, -1e7, 1e7), false, "farTransform");
}

/// Floats are 1 apart there, so the scene is large: 1000 to a unit.
TEST_F(ShadowExtremeGLTest, offsetOfTenMillionInTheVertices)
{
    expectNoLeakMoved(osg::Matrixd::scale(1000.0, 1000.0, 1000.0) *
                          osg::Matrixd::translate(1e7, -1e7, 1e7),
                      true, "farVertices");
}

TEST_F(ShadowExtremeGLTest, unevenAndNegativeScale)
{
    for (const osg::Vec3d& scale : {osg::Vec3d(0.5, 1.6, 0.8), osg::Vec3d(-1.0, 1.0, 1.0),
                                    osg::Vec3d(1.3, -0.4, 0.9), osg::Vec3d(-0.7, -1.2, -0.9)})
    {
        ExtremeMesh mesh;
        mesh.sphere({0.0f, 0.0f, 0.0f}, 0.8f);
        mesh.box({0.6f, 0.2f, -0.3f}, {1.2f, 0.7f, 0.2f});
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
            osg::Matrixd::scale(scale) * osg::Matrixd::rotate(0.7, osg::Vec3d(0.3, 1.0, 0.2)) *
            osg::Matrixd::translate(0.0, 0.0, 1.4));
        transform->addChild(mesh.createNode());
        expectNoLeak(*sceneOf(*transform, high()), outside(),
                     "scale" + std::to_string(int(scale.x() * 10)));
    }
}

TEST_F(ShadowExtremeGLTest, directionalLightAlongAHugeFlatFloor)
{
    ExtremeMesh mesh = theSphere();
    mesh.plate(1e5f, 0.0f);
    CameraSpec camera = outside();
    camera.projection = osg::Matrixd::perspective(34.0, Aspect, 1.0, 1e4);
    for (float height : {0.05f, 1e-3f, 0.0f, -1e-3f})
    {
        osg::ref_ptr<osg::Group> scene = new osg::Group;
        scene->addChild(mesh.createNode());
        scene->addChild(truth::makeSource(0, {1.0f, 0.25f, height, 0.0f}));
        expectNoLeak(*scene, camera, "floor" + std::to_string(int(height * 1000.0f)),
                     height >= 0.0f);
    }
}

TEST_F(ShadowExtremeGLTest, hundredLightsEachHaveTheirShadow)
{
    osg::ref_ptr<osg::Group> scene = sceneOf(*theSphere().createNode(), high());
    for (int i = 1; i < 100; ++i)
    {
        const float angle = 0.37f * float(i);
        scene->addChild(truth::makeSource(i, {3.0f * std::cos(angle), 3.0f * std::sin(angle),
                                              2.0f + 0.03f * float(i), i % 3 ? 1.0f : 0.0f}));
    }
    for (int light : {0, 5, 31, 32, 63, 64, 65, 99})
        expectNoLeak(*scene, outside(), "light" + std::to_string(light), true, light);
}

TEST_F(ShadowExtremeGLTest, lightMovingThroughAWallNeverFlickers)
{
    ExtremeMesh wall = theSphere();
    wall.box({1.4f, -2.0f, 0.0f}, {1.6f, 2.0f, 2.5f});
    const osg::ref_ptr<osg::Group> scene = sceneOf(*wall.createNode(), high());
    auto* source = static_cast<osg::LightSource*>(scene->getChild(2));
    const int frames = truth::isLongRun() ? 500 : 60;
    for (int frame = 0; frame <= frames; ++frame)
    {
        // The steps meet both faces exactly: x = 1.4f and 1.6f at 2/5 and 3/5 of the way.
        const float x = 5 * frame == 2 * frames   ? 1.4f
                        : 5 * frame == 3 * frames ? 1.6f
                                                  : 1.0f + float(frame) / float(frames);
        source->getLight()->setPosition({x, 0.1f, 1.2f, 1.0f});
        expectNoLeak(*scene, outside(), "wall" + std::to_string(frame), false);
    }
}

TEST_F(ShadowExtremeGLTest, emptyCasters)
{
    osg::ref_ptr<osg::Group> caster = new osg::Group;
    caster->addChild(theSphere().createNode());
    caster->addChild(ExtremeMesh().createNode());
    caster->addChild(new osg::Geode);
    osg::ref_ptr<osg::Geode> bare = new osg::Geode;
    bare->addDrawable(new osg::Geometry);
    caster->addChild(bare);
    expectNoLeak(*sceneOf(*caster, high()), outside(), "empty");
    expectNoLeak(*sceneOf(*new osg::Group, high()), outside(), "nothing", false);
}

TEST_F(ShadowExtremeGLTest, triangleWithANaNIsLeftOutAndSaidOnce)
{
    support::NotifyCapture notify;
    ExtremeMesh mesh = theSphere();
    mesh.corners[300].x() = std::numeric_limits<float>::quiet_NaN();
    mesh.corners[603].z() = std::numeric_limits<float>::infinity();
    expectNoLeak(mesh, high(), "nan");
    EXPECT_EQ(notify.takeWarnings().size(), 1u);
}
