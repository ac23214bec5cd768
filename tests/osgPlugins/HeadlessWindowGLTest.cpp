// SPDX-License-Identifier: MIT
#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgViewer/GraphicsWindow>
#include <osgViewer/Viewer>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

// Runs for EGL, and a second time for OSMesa in a process that preloads it (see CMakeLists.txt).

namespace
{

const bool Mesa = std::getenv("OSGKITS_TEST_OSMESA") != nullptr;
const std::string Name = Mesa ? "OSMesa" : "EGL";

osg::ref_ptr<osg::GraphicsContext::Traits> makeTraits(int width, int height,
                                                      unsigned int samples = 0)
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = width;
    traits->height = height;
    traits->samples = samples;
    traits->doubleBuffer = true;
    return traits;
}

osg::ref_ptr<osg::GraphicsContext> makeContext(osg::GraphicsContext::Traits* traits)
{
    return osg::GraphicsContext::createGraphicsContext(traits);
}

GLint getInteger(GLenum name)
{
    GLint value = -1;
    glGetIntegerv(name, &value);
    return value;
}

/// A quad of one colour over the whole view.
osg::ref_ptr<osg::Node> makeQuad(const osg::Vec4& colour)
{
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
        osg::Vec3(-1, -1, 0), osg::Vec3(2, 0, 0), osg::Vec3(0, 2, 0));
    osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array;
    colours->push_back(colour);
    quad->setColorArray(colours, osg::Array::BIND_OVERALL);
    quad->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return quad;
}

void setUp2D(osg::Camera& camera, osg::GraphicsContext* context)
{
    const auto* traits = context->getTraits();
    camera.setGraphicsContext(context);
    camera.setViewport(0, 0, traits->width, traits->height);
    camera.setViewMatrix(osg::Matrix::identity());
    camera.setProjectionMatrix(osg::Matrix::ortho2D(-1, 1, -1, 1));
    const GLenum buffer = traits->doubleBuffer ? GL_BACK : GL_FRONT;
    camera.setDrawBuffer(buffer);
    camera.setReadBuffer(buffer);
}

struct ReadPixels : osg::Camera::DrawCallback
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    void operator()(osg::RenderInfo& info) const override
    {
        const auto* viewport = info.getCurrentCamera()->getViewport();
        image->readPixels(0, 0, static_cast<int>(viewport->width()),
                          static_cast<int>(viewport->height()), GL_RGB, GL_UNSIGNED_BYTE);
    }
};

class HeadlessWindowGLTest : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        auto* registry = osgDB::Registry::instance();
        ASSERT_NE(
            registry->loadLibrary(registry->createLibraryNameForExtension(Mesa ? "osmesa" : "egl")),
            osgDB::Registry::NOT_LOADED);
    }
};

} // namespace

TEST_F(HeadlessWindowGLTest, interfaceIsFirstAndNamed)
{
    EXPECT_EQ(osg::GraphicsContext::getWindowingSystemInterface()->getName(), Name);
    EXPECT_EQ(osg::GraphicsContext::getWindowingSystemInterface(Name)->getName(), Name);
}

TEST_F(HeadlessWindowGLTest, framebufferHasTheBitsAskedFor)
{
    for (const unsigned int samples : {0u, 4u})
    {
        auto traits = makeTraits(64, 32, samples);
        const auto context = makeContext(traits);
        ASSERT_TRUE(context && context->realize());
        ASSERT_TRUE(context->makeCurrent());
        EXPECT_EQ(getInteger(GL_DEPTH_BITS), 24);
        EXPECT_EQ(getInteger(GL_STENCIL_BITS), 8);
        EXPECT_EQ(getInteger(GL_ALPHA_BITS), 8);
        EXPECT_EQ(getInteger(GL_RED_BITS), 8);
        EXPECT_EQ(getInteger(GL_SAMPLES), static_cast<GLint>(samples));
        EXPECT_EQ(context->getTraits()->samples, samples);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        context->releaseContext();
    }
}

TEST_F(HeadlessWindowGLTest, extensionFunctionsOfGl45Work)
{
    const auto context = makeContext(makeTraits(16, 16));
    ASSERT_TRUE(context && context->realize() && context->makeCurrent());
    const auto* gl = context->getState()->get<osg::GLExtensions>();
    EXPECT_GE(gl->glVersion, 3.3f);
    // Functions that libOSMesa does not export and libGL would swallow without an error.
    ASSERT_TRUE(gl->glClipControl && gl->glPatchParameterfv && gl->glQueryCounter);
    gl->glClipControl(0x8CA2 /* GL_UPPER_LEFT */, 0x935F /* GL_ZERO_TO_ONE */);
    EXPECT_EQ(getInteger(0x935C /* GL_CLIP_ORIGIN */), 0x8CA2);
    const GLfloat levels[4] = {3, 3, 3, 3};
    gl->glPatchParameterfv(GL_PATCH_DEFAULT_OUTER_LEVEL, levels);
    GLfloat outer[4] = {};
    glGetFloatv(GL_PATCH_DEFAULT_OUTER_LEVEL, outer);
    EXPECT_EQ(outer[0], 3.0f);
    GLuint query = 0;
    gl->glGenQueries(1, &query);
    gl->glQueryCounter(query, GL_TIMESTAMP);
    GLuint64 time = 0;
    gl->glGetQueryObjectui64v(query, GL_QUERY_RESULT, &time);
    EXPECT_GT(time, 0u);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    context->releaseContext();
}

TEST_F(HeadlessWindowGLTest, askedVersionAndProfileAreGiven)
{
    auto traits = makeTraits(16, 16);
    traits->glContextVersion = "3.3";
    traits->glContextProfileMask = 1; // core
    const auto context = makeContext(traits);
    ASSERT_TRUE(context && context->realize() && context->makeCurrent());
    EXPECT_EQ(getInteger(0x9126 /* GL_CONTEXT_PROFILE_MASK */) & 1, 1);
    context->releaseContext();
    auto impossible = makeTraits(16, 16);
    impossible->glContextVersion = "9.9";
    EXPECT_FALSE(makeContext(impossible));
}

TEST_F(HeadlessWindowGLTest, sharedContextSeesTheObjects)
{
    const auto first = makeContext(makeTraits(16, 16));
    ASSERT_TRUE(first && first->realize() && first->makeCurrent());
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    first->releaseContext();

    auto traits = makeTraits(16, 16);
    traits->sharedContext = first;
    const auto second = makeContext(traits);
    const auto third = makeContext(makeTraits(16, 16));
    ASSERT_TRUE(second && second->realize() && third && third->realize());
    EXPECT_EQ(second->getState()->getContextID(), first->getState()->getContextID());
    EXPECT_NE(third->getState()->getContextID(), first->getState()->getContextID());
    ASSERT_TRUE(second->makeCurrent());
    EXPECT_TRUE(glIsTexture(texture));
    second->releaseContext();
    ASSERT_TRUE(third->makeCurrent());
    EXPECT_FALSE(glIsTexture(texture));
    third->releaseContext();
}

TEST_F(HeadlessWindowGLTest, releasedContextIsCurrentNowhereAndCanMoveToAThread)
{
    const auto context = makeContext(makeTraits(16, 16));
    ASSERT_TRUE(context && context->realize() && context->makeCurrent());
    EXPECT_TRUE(glGetString(GL_VERSION));
    EXPECT_TRUE(context->releaseContext());
    bool current = false;
    std::thread(
        [&]
        {
            current = context->makeCurrent() && glGetString(GL_VERSION);
            context->releaseContext();
        })
        .join();
    EXPECT_TRUE(current);
}

TEST_F(HeadlessWindowGLTest, makingAContextKeepsTheCurrentOne)
{
    const auto first = makeContext(makeTraits(16, 16));
    ASSERT_TRUE(first && first->realize() && first->makeCurrent());
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    for (const unsigned int samples : {0u, 4u})
    {
        const auto second = makeContext(makeTraits(8, 8, samples));
        EXPECT_EQ(getInteger(GL_TEXTURE_BINDING_2D), static_cast<GLint>(texture));
    }
    EXPECT_EQ(getInteger(GL_TEXTURE_BINDING_2D), static_cast<GLint>(texture));
    first->releaseContext();
}

TEST_F(HeadlessWindowGLTest, impossibleContextsAreNullAndTheProcessLivesOn)
{
    EXPECT_FALSE(makeContext(makeTraits(20000, 20000)));
    EXPECT_FALSE(makeContext(makeTraits(0, 16)));
    EXPECT_FALSE(makeContext(makeTraits(16, 16, 1000)));
    EXPECT_TRUE(makeContext(makeTraits(16, 16)));
}

TEST_F(HeadlessWindowGLTest, fiftyViewersOpenDrawAndClose)
{
    for (int i = 0; i < 50; ++i)
    {
        osgViewer::Viewer viewer;
        viewer.setThreadingModel(i % 2 ? osgViewer::Viewer::DrawThreadPerContext
                                       : osgViewer::Viewer::SingleThreaded);
        const auto context = makeContext(makeTraits(32, 32, i % 3 ? 0 : 4));
        ASSERT_TRUE(context);
        setUp2D(*viewer.getCamera(), context);
        viewer.setSceneData(makeQuad(osg::Vec4(1, 0, 0, 1)));
        viewer.realize();
        ASSERT_TRUE(viewer.isRealized());
        viewer.frame();
        viewer.frame();
    }
    EXPECT_LE(osg::GraphicsContext::getMaxContextID(), 8u) << "context IDs are used again";
}

TEST_F(HeadlessWindowGLTest, pictureFollowsANewSize)
{
    for (const unsigned int samples : {0u, 4u})
    {
        for (const auto threads :
             {osgViewer::Viewer::SingleThreaded, osgViewer::Viewer::DrawThreadPerContext})
        {
            osgViewer::Viewer viewer;
            viewer.setThreadingModel(threads);
            const auto context = makeContext(makeTraits(32, 32, samples));
            ASSERT_TRUE(context);
            setUp2D(*viewer.getCamera(), context);
            osg::ref_ptr<ReadPixels> reader = new ReadPixels;
            viewer.getCamera()->setFinalDrawCallback(reader);
            viewer.getCamera()->setProjectionResizePolicy(osg::Camera::FIXED);
            viewer.setSceneData(makeQuad(osg::Vec4(0, 1, 0, 1)));
            viewer.realize();
            viewer.frame();
            auto* window = dynamic_cast<osgViewer::GraphicsWindow*>(context.get());
            window->setWindowRectangle(0, 0, 100, 60);
            EXPECT_EQ(context->getTraits()->width, 100);
            viewer.frame();
            viewer.frame();
            viewer.stopThreading();
            ASSERT_EQ(reader->image->s(), 100);
            if (samples == 0) // pixels of a multisampled framebuffer object can't be read directly
            {
                EXPECT_GT(reader->image->getColor(99, 59).g(), 0.99f);
            }
            window->setWindowRectangle(0, 0, 0, 60);
            window->setWindowRectangle(0, 0, 30000, 60);
            EXPECT_EQ(context->getTraits()->width, 100);
        }
    }
}

TEST_F(HeadlessWindowGLTest, lastFrameOfEachWindowIsCaptured)
{
    const std::string folder = "windowing-" + Name + "/";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    setenv("OSG_HEADLESS_CAPTURE", (folder + "last%d.png").c_str(), 1);
    {
        osgViewer::Viewer viewer;
        viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        const auto first = makeContext(makeTraits(32, 32));
        const auto second = makeContext(makeTraits(16, 16, 4));
        ASSERT_TRUE(first && second);
        auto traits = makeTraits(8, 8);
        traits->pbuffer = true;
        EXPECT_TRUE(makeContext(traits));
        osg::ref_ptr<osg::Camera> slave = new osg::Camera;
        setUp2D(*viewer.getCamera(), first);
        setUp2D(*slave, second);
        viewer.addSlave(slave);
        for (const osg::Vec4& colour : {osg::Vec4(1, 0, 0, 1), osg::Vec4(0, 1, 0, 0.5f)})
        {
            viewer.setSceneData(makeQuad(colour));
            viewer.frame();
        }
    }
    unsetenv("OSG_HEADLESS_CAPTURE");
    for (const std::string file : {"last0.png", "last1.png"})
    {
        const auto image = osgDB::readRefImageFile(folder + file);
        ASSERT_TRUE(image) << file;
        EXPECT_EQ(image->s(), file == "last0.png" ? 32 : 16);
        EXPECT_EQ(image->getColor(8, 8), osg::Vec4(0, 1, 0, 1)) << file << ": green and opaque";
    }
    EXPECT_FALSE(std::filesystem::exists(folder + "last2.png")) << "a pixel buffer is no window";
}

TEST_F(HeadlessWindowGLTest, pixelBufferCamerasFillTheirTexture)
{
    for (const auto target : {osg::Camera::PIXEL_BUFFER, osg::Camera::PIXEL_BUFFER_RTT})
    {
        osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
        texture->setTextureSize(32, 32);
        texture->setInternalFormat(GL_RGBA);
        osg::ref_ptr<osg::Camera> inner = new osg::Camera;
        inner->setRenderOrder(osg::Camera::PRE_RENDER);
        inner->setRenderTargetImplementation(target);
        inner->attach(osg::Camera::COLOR_BUFFER, texture);
        inner->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
        inner->setViewport(0, 0, 32, 32);
        inner->setProjectionMatrix(osg::Matrix::ortho2D(-1, 1, -1, 1));
        inner->addChild(makeQuad(osg::Vec4(0, 0, 1, 1)));

        const auto quad = makeQuad(osg::Vec4(1, 1, 1, 1));
        quad->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
        osg::ref_ptr<osg::Group> scene = new osg::Group;
        scene->addChild(inner);
        scene->addChild(quad);

        osgViewer::Viewer viewer;
        viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        const auto context = makeContext(makeTraits(64, 64));
        ASSERT_TRUE(context);
        setUp2D(*viewer.getCamera(), context);
        osg::ref_ptr<ReadPixels> reader = new ReadPixels;
        viewer.getCamera()->setFinalDrawCallback(reader);
        viewer.setSceneData(scene);
        viewer.realize();
        viewer.frame();
        viewer.frame();
        ASSERT_EQ(reader->image->s(), 64);
        const osg::Vec4 centre = reader->image->getColor(32, 32);
        EXPECT_LT(centre.r(), 0.01f) << target;
        EXPECT_GT(centre.b(), 0.99f) << target;
    }
}

// Each runs in a fresh process.
class HeadlessExitGLTest : public HeadlessWindowGLTest
{
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(HeadlessExitGLTest, unloadedPluginLeavesTheList)
{
    const auto unload = []
    {
        auto* registry = osgDB::Registry::instance();
        registry->closeLibrary(registry->createLibraryNameForExtension(Mesa ? "osmesa" : "egl"));
        const auto& systems = osg::GraphicsContext::getWindowingSystemInterfaces()->getInterfaces();
        std::exit(systems.empty() || systems.front()->getName() != Name ? 0 : 3);
    };
    EXPECT_EXIT(unload(), testing::ExitedWithCode(0), "");
}

TEST_F(HeadlessExitGLTest, windowsThatOutliveThePluginDoNotCrash)
{
    const auto leave = []
    {
        static osg::ref_ptr<osg::GraphicsContext> window;
        window = makeContext(makeTraits(16, 16));
        window->realize();
        window->makeCurrent();
        auto* registry = osgDB::Registry::instance();
        registry->closeLibrary(registry->createLibraryNameForExtension(Mesa ? "osmesa" : "egl"));
        std::exit(window->releaseContext() && window->makeCurrent() ? 0 : 3);
    };
    EXPECT_EXIT(leave(), testing::ExitedWithCode(0), "");
}

TEST_F(HeadlessExitGLTest, failedWindowFailsTheProcessOnlyWhenAPictureIsAskedFor)
{
    const auto fail = [](bool picture)
    {
        if (picture)
        {
            setenv("OSG_HEADLESS_CAPTURE", "a.png", 1);
        }
        std::exit(makeContext(makeTraits(20000, 20000)) ? 3 : 0);
    };
    EXPECT_EXIT(fail(false), testing::ExitedWithCode(0), "is larger than");
    EXPECT_EXIT(fail(true), testing::ExitedWithCode(1), "is larger than");
}

TEST_F(HeadlessExitGLTest, windowWithoutAFrameFailsTheProcessThatAskedForAPicture)
{
    const auto run = []
    {
        setenv("OSG_HEADLESS_CAPTURE", "a.png", 1);
        makeContext(makeTraits(16, 16));
        std::exit(0);
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(1), "no frame was drawn");
}
