// SPDX-License-Identifier: MIT
// Shadows where OpenGL can do less than this machine's: its answers are made worse on the way.
#include "VolumePictures.h"

#include <support/NotifyCapture.h>

#include <osg/FrameBufferObject>
#include <osg/GLExtensions>

#include <dlfcn.h>

using namespace volumeScene;
using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Shadows;
using Picture = osg::ref_ptr<osg::Image>;

namespace
{

GLint mostTextureSamples = 0; ///< 0: what OpenGL says.

} // namespace

/// Of the whole process: the kit's library finds this one first.
extern "C" __attribute__((visibility("default"))) void APIENTRY glGetIntegerv(GLenum name,
                                                                              GLint* value)
{
    using Function = void (*)(GLenum, GLint*);
    static const auto real = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "glGetIntegerv"));
    real(name, value);
    const bool isLimit = name >= 0x910E && name <= 0x9110; // of colour, depth, integer textures
    if (isLimit && mostTextureSamples > 0)
        *value = mostTextureSamples;
}

namespace
{

GLenum APIENTRY sayUnsupported(GLenum)
{
    return 0x8CDD; // GL_FRAMEBUFFER_UNSUPPORTED
}

class ShadowLimits : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(floorScene::viewer()); }
    void TearDown() override { mostTextureSamples = 0; }

    support::NotifyCapture _notify;
};

double differentShare(const osg::Image& a, const osg::Image& b)
{
    int different = 0;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x)
            different += std::abs(floorScene::red(a, x, y) - floorScene::red(b, x, y)) > 8;
    return double(different) / (a.s() * a.t());
}

} // namespace

TEST_F(ShadowLimits, aViewOfMoreSamplesThanTexturesHaveIsShadowedWithThose)
{
    support::HeadlessSettings settings;
    settings.width = floorScene::Width;
    settings.height = floorScene::Height;
    settings.samples = 4;
    support::HeadlessViewer viewer(settings);
    OSGKITS_NEED_GL(viewer);
    viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    const auto draw = [&](ShadowedScene& scene)
    { return viewer.render(&scene, fromFront(), settings.width, settings.height, 2); };
    const osg::ref_ptr<ShadowedScene> all = twoBoxes();
    const Picture expected = draw(*all);
    EXPECT_EQ(entryOf(*all, "light 0").find("samples"), std::string::npos);
    for (const int most : {1, 2})
    {
        mostTextureSamples = most;
        const osg::ref_ptr<ShadowedScene> fewer = twoBoxes();
        const Picture actual = draw(*fewer);
        const std::string name = "shadowsOf" + std::to_string(most) + "Samples";
        keep(actual, name);
        EXPECT_NE(entryOf(*fewer, "light 0").find("with " + std::to_string(most) + " of 4 samples"),
                  std::string::npos)
            << entryOf(*fewer, "light 0");
        // Edges of shadows and objects, a pixel wide.
        EXPECT_LT(differentShare(*actual, *expected), 0.02);
        EXPECT_GT(differentShare(*actual, *expected), 0.0) << "all samples were there";
        EXPECT_NEAR(darkShare(*actual), darkShare(*expected), 0.01);
    }
    EXPECT_EQ(_notify.takeWarnings(), support::NotifyCapture::Lines{});
}

TEST_F(ShadowLimits, whereNoBufferCanBeDrawnIntoThereIsLightAndOneLine)
{
    for (const Shadows shadows : {Shadows::VOLUMES, Shadows::MAP})
    {
        const osg::ref_ptr<ShadowedScene> lit = twoBoxes(), broken = twoBoxes();
        lit->setShadows(Shadows::OFF);
        broken->setShadows(shadows);
        broken->setMapSize(256);
        const Picture expected = render(*lit, fromFront());
        auto* gl = osg::GLExtensions::Get(floorScene::viewer()
                                              .getViewer()
                                              .getCamera()
                                              ->getGraphicsContext()
                                              ->getState()
                                              ->getContextID(),
                                          false);
        auto* const real = gl->glCheckFramebufferStatus;
        gl->glCheckFramebufferStatus = sayUnsupported;
        const Picture actual =
            render(*broken, fromFront(), floorScene::Width, floorScene::Height, 3);
        gl->glCheckFramebufferStatus = real;
        EXPECT_TRUE(areEqual(actual, expected, "litWithoutBuffers"));
        const std::string reason =
            "OpenGL can't draw into buffers of 256x256 pixels with 1 sample (framebuffer status "
            "0x8cdd)";
        EXPECT_EQ(entryOf(*broken, "light 0"), "drawn: no shadow: " + reason);
        EXPECT_EQ(_notify.takeWarnings(),
                  support::NotifyCapture::Lines{"osgShadowVolume::ShadowedScene: no shadows, "
                                                "because " +
                                                reason + "; fewer pixels or samples may help"});
    }
}
