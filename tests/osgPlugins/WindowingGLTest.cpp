// SPDX-License-Identifier: MIT
#include "ChildProcess.h"

#include <osg/GLExtensions>
#include <osg/Image>
#include <osgDB/ReadFile>
#include <osgGA/TrackballManipulator>
#include <osgUtil/Optimizer>
#include <osgViewer/Viewer>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace
{

const std::string Models = "/usr/share/inventor/data/models/";
const std::string Chair = Models + "chair.iv";

std::string getPicture(const std::string& name)
{
    std::filesystem::create_directories("windowing");
    const std::string file = "windowing/" + name;
    std::filesystem::remove(file);
    return file;
}

/// Stock osgviewer with one of the plugins, three frames.
ChildResult view(const std::string& backend, std::vector<std::string> arguments,
                 Environment environment = {})
{
    environment.insert({"OSG_RUN_FRAME_COUNT", "3"});
    if (backend == "osmesa")
    {
        environment.insert({"LD_PRELOAD", "libOSMesa.so.8"});
    }
    arguments.insert(arguments.begin(), {"osgviewer", "-e", backend});
    return runChild(arguments, environment);
}

/// The picture that osgviewer writes; null with a test failure when it does not.
osg::ref_ptr<osg::Image> capture(const std::string& backend, std::vector<std::string> arguments,
                                 const std::string& name, Environment environment = {})
{
    const std::string file = getPicture(name);
    environment["OSG_HEADLESS_CAPTURE"] = file;
    const ChildResult result = view(backend, std::move(arguments), std::move(environment));
    EXPECT_EQ(result.status, 0) << result.output;
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file);
    EXPECT_TRUE(image) << file << "\n" << result.output;
    return image;
}

std::vector<std::string> smallWindow(const std::string& model, const std::string& samples = "0")
{
    return {"--window", "0", "0", "320", "240", "--samples", samples, model};
}

struct Difference
{
    int worst = 255;         // of any channel
    double shareOver2 = 1.0; // of the pixels that differ by more than 2
};

Difference compare(const osg::Image* a, const osg::Image* b)
{
    if (!a || !b || a->s() != b->s() || a->t() != b->t())
    {
        return {};
    }
    Difference difference{0, 0.0};
    for (int y = 0; y < a->t(); ++y)
    {
        for (int x = 0; x < a->s(); ++x)
        {
            const osg::Vec4 d = (a->getColor(x, y) - b->getColor(x, y)) * 255.0f;
            const int worst = static_cast<int>(
                std::lround(std::max({std::fabs(d.r()), std::fabs(d.g()), std::fabs(d.b())})));
            difference.worst = std::max(difference.worst, worst);
            difference.shareOver2 += worst > 2;
        }
    }
    difference.shareOver2 /= a->s() * a->t();
    return difference;
}

/// Share of pixels that are not osgviewer's background.
double getCoverage(const osg::Image* image)
{
    if (!image)
    {
        return 0.0;
    }
    const osg::Vec4 background = image->getColor(0, 0);
    int covered = 0;
    for (int y = 0; y < image->t(); ++y)
    {
        for (int x = 0; x < image->s(); ++x)
        {
            covered += (image->getColor(x, y) - background).length() > 0.02f;
        }
    }
    return double(covered) / (image->s() * image->t());
}

bool hasBackground(const osg::Image* image)
{
    // osgviewer's default clear colour, 0.2 0.2 0.4, on 8 bits.
    return image && (image->getColor(0, 0) - osg::Vec4(0.2f, 0.2f, 0.4f, 1.0f)).length() < 0.01f;
}

struct ReadLastFrame : osg::Camera::DrawCallback
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    // Through a blit, which averages the samples as the window does when it is shown.
    void operator()(osg::RenderInfo& renderInfo) const override
    {
        const auto* gl = renderInfo.getState()->get<osg::GLExtensions>();
        GLuint framebuffer = 0, colours = 0;
        gl->glGenFramebuffers(1, &framebuffer);
        gl->glGenRenderbuffers(1, &colours);
        gl->glBindRenderbuffer(GL_RENDERBUFFER_EXT, colours);
        gl->glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_RGBA8, 320, 240);
        gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, framebuffer);
        gl->glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT,
                                      GL_RENDERBUFFER_EXT, colours);
        gl->glBlitFramebuffer(0, 0, 320, 240, 0, 0, 320, 240, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, framebuffer);
        image->readPixels(0, 0, 320, 240, GL_RGB, GL_UNSIGNED_BYTE);
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, 0);
        gl->glDeleteRenderbuffers(1, &colours);
        gl->glDeleteFramebuffers(1, &framebuffer);
    }
};

/// What osgviewer shows in a window of a real X server.
osg::ref_ptr<osg::Image> renderInX11(const std::string& display, const std::string& model,
                                     unsigned int samples)
{
    setenv("DISPLAY", display.c_str(), 1);
    osg::DisplaySettings::instance()->setNumMultiSamples(samples);
    osg::ref_ptr<ReadLastFrame> reader = new ReadLastFrame;
    {
        osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(model);
        osgUtil::Optimizer().optimize(scene);
        osgViewer::Viewer viewer;
        viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        viewer.setSceneData(scene);
        viewer.setCameraManipulator(new osgGA::TrackballManipulator);
        viewer.setUpViewInWindow(0, 0, 320, 240);
        viewer.getCamera()->setFinalDrawCallback(reader);
        viewer.realize();
        for (int i = 0; i < 3 && viewer.isRealized(); ++i)
        {
            viewer.frame();
        }
    }
    osg::DisplaySettings::instance()->setNumMultiSamples(0);
    unsetenv("DISPLAY");
    return reader->image;
}

class WindowingGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        if (!std::filesystem::exists(Chair))
        {
            GTEST_SKIP() << "inventor-data is not installed";
        }
    }
};

class BackendGLTest : public WindowingGLTest, public testing::WithParamInterface<std::string>
{
};

INSTANTIATE_TEST_SUITE_P(Plugins, BackendGLTest, testing::Values("egl", "osmesa"),
                         [](const auto& each) { return each.param; });

} // namespace

TEST_P(BackendGLTest, stockViewerRendersWithoutADisplay)
{
    const auto image = capture(GetParam(), smallWindow(Chair), GetParam() + "_chair.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->s(), 320);
    EXPECT_EQ(image->t(), 240);
    EXPECT_TRUE(hasBackground(image));
    EXPECT_GT(getCoverage(image), 0.02);
    EXPECT_LT(getCoverage(image), 0.9);
}

TEST_P(BackendGLTest, nurbsModelsLoadWithoutADisplay)
{
    for (const std::string model : {"household/teapot", "scenes/glider"})
    {
        const std::string name = std::filesystem::path(model).filename().string();
        const auto image = capture(GetParam(), smallWindow(Models + model + ".iv"),
                                   GetParam() + "_" + name + ".png");
        // The glider is seen from its edge.
        EXPECT_GT(getCoverage(image), model == "scenes/glider" ? 1e-4 : 0.02) << model;
    }
}

TEST_P(BackendGLTest, threadingModelsGiveTheSamePicture)
{
    for (const std::string samples : {"0", "4"})
    {
        osg::ref_ptr<osg::Image> first;
        for (const std::string model :
             {"SingleThreaded", "CullDrawThreadPerContext", "DrawThreadPerContext",
              "CullThreadPerCameraDrawThreadPerContext"})
        {
            auto arguments = smallWindow(Chair, samples);
            arguments.insert(arguments.begin(), "--" + model);
            const auto image =
                capture(GetParam(), arguments, GetParam() + "_" + model + samples + ".png");
            first = first ? first : image;
            EXPECT_EQ(compare(first, image).worst, 0) << model << " " << samples;
        }
    }
}

TEST_P(BackendGLTest, optimizerDoesNotChangeThePicture)
{
    const auto on = capture(GetParam(), smallWindow(Chair), GetParam() + "_opt.png");
    const auto off = capture(GetParam(), smallWindow(Chair), GetParam() + "_noopt.png",
                             {{"OSG_OPTIMIZER", "OFF"}});
    EXPECT_LE(compare(on, off).worst, 2);
}

TEST_P(BackendGLTest, samplesSmoothEdges)
{
    const auto plain = capture(GetParam(), smallWindow(Chair), GetParam() + "_plain.png");
    const auto smooth = capture(GetParam(), smallWindow(Chair, "4"), GetParam() + "_smooth.png");
    const Difference difference = compare(plain, smooth);
    EXPECT_GT(difference.shareOver2, 0.001);
    EXPECT_LT(difference.shareOver2, 0.05);
}

TEST_P(BackendGLTest, eachScreenHasItsWindowAndPicture)
{
    for (const std::string threads : {"--SingleThreaded", "--DrawThreadPerContext"})
    {
        const std::string second = getPicture(GetParam() + "_screens_1.png");
        const auto image = capture(GetParam(), {threads, Chair}, GetParam() + "_screens.png",
                                   {{"OSG_HEADLESS_SCREEN", "300x200,200x100"}});
        const auto other = osgDB::readRefImageFile(second);
        ASSERT_TRUE(image && other);
        EXPECT_EQ(image->s(), 300);
        EXPECT_EQ(other->s(), 200);
        EXPECT_TRUE(hasBackground(image));
        EXPECT_TRUE(hasBackground(other));
        // The chair lies on the border between both screens.
        EXPECT_GT(getCoverage(image) + getCoverage(other), 0.02);
    }
}

TEST_P(BackendGLTest, screenSwitchTakesTheDefaultSize)
{
    const auto image = capture(GetParam(), {"--screen", "0", Chair}, GetParam() + "_screen.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->s(), 1280);
    EXPECT_EQ(image->t(), 720);
}

TEST_P(BackendGLTest, onePixelAndTheWidestPicture)
{
    const auto pixel =
        capture(GetParam(), {"--window", "0", "0", "1", "1", Chair}, GetParam() + "_1.png");
    ASSERT_TRUE(pixel);
    EXPECT_EQ(pixel->s(), 1);
    EXPECT_EQ(pixel->t(), 1);
    const auto wide =
        capture(GetParam(), {"--window", "0", "0", "16384", "16", Chair}, GetParam() + "_wide.png");
    ASSERT_TRUE(wide);
    EXPECT_EQ(wide->s(), 16384);
    EXPECT_TRUE(hasBackground(wide));
}

TEST_P(BackendGLTest, otherImageTypesAreWritten)
{
    for (const std::string type : {"jpg", "bmp", "tga"})
    {
        const auto image = capture(GetParam(), smallWindow(Chair), GetParam() + "_type." + type);
        ASSERT_TRUE(image) << type;
        EXPECT_GT(getCoverage(image), 0.02) << type;
    }
}

namespace
{

struct Failure
{
    const char* backend;
    std::vector<std::string> arguments;
    Environment environment;
    const char* cause;
    const char* remedy;
};

const std::vector<Failure> Failures = {
    {"egl", {"--screen", "3"}, {}, "there is no screen 3, only 1", "name a lower one"},
    {"egl",
     {"--window", "0", "0", "20000", "20000"},
     {},
     "20000x20000 is larger than 16384x16384",
     "ask for a smaller one"},
    {"osmesa",
     {"--window", "0", "0", "20000", "20000"},
     {},
     "20000x20000 is larger than 16384x16384",
     "ask for a smaller one"},
    {"egl", {"--samples", "64"}, {}, "64 samples are more than", "ask for fewer (--samples)"},
    {"osmesa", {"--samples", "64"}, {}, "64 samples are more than", "ask for fewer (--samples)"},
    {"egl", {}, {{"OSG_EGL_DEVICE", "99"}}, "device '99' does not exist", "set OSG_EGL_DEVICE"},
    {"egl",
     {"-O", "egl.device=nonsense"},
     {},
     "device 'nonsense' does not exist",
     "-O egl.device="},
    {"egl",
     {},
     {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json"}},
     "no EGL device gives OpenGL",
     "install a GPU driver"},
    {"osmesa",
     {},
     {{"LD_PRELOAD", ""}},
     "OpenGL calls go to another library",
     "LD_PRELOAD=libOSMesa.so.8"},
    {"egl",
     {},
     {{"OSG_HEADLESS_SCREEN", "12x"}},
     "OSG_HEADLESS_SCREEN='12x' is not a list of sizes",
     "write for example"},
};

} // namespace

TEST_F(WindowingGLTest, failuresAreOneLineWithCauseAndRemedyAndNoPicture)
{
    for (const Failure& failure : Failures)
    {
        SCOPED_TRACE(failure.cause);
        const std::string file = getPicture("failure.png");
        auto arguments = failure.arguments;
        arguments.push_back(Chair);
        auto environment = failure.environment;
        environment["OSG_HEADLESS_CAPTURE"] = file;
        const ChildResult result = view(failure.backend, arguments, environment);
        EXPECT_EQ(result.status, 1);
        // osgviewer opens its default window after some of these; its picture would be wrong.
        EXPECT_FALSE(std::filesystem::exists(file));
        const size_t line = result.output.find("osgdb_" + std::string(failure.backend) + ": ");
        ASSERT_NE(line, std::string::npos) << result.output;
        const std::string text = result.output.substr(line, result.output.find('\n', line) - line);
        EXPECT_NE(text.find(failure.cause), std::string::npos) << text;
        EXPECT_NE(text.find(failure.remedy), std::string::npos) << text;
        EXPECT_EQ(result.output.find("osgdb_", line + 1), std::string::npos) << result.output;
    }
}

TEST_F(WindowingGLTest, failedWritesEndTheProcessWithFailure)
{
    for (const std::string file : {"/nonexistent/a.png", "windowing/a.unknowntype"})
    {
        const ChildResult result =
            view("egl", smallWindow(Chair), {{"OSG_HEADLESS_CAPTURE", file}});
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.output.find("osgdb_egl: cannot write '" + file), std::string::npos)
            << result.output;
    }
}

TEST_F(WindowingGLTest, surfacelessAndDeviceGiveTheSamePicture)
{
    const auto automatic = capture("egl", smallWindow(Chair), "auto.png");
    const auto surfaceless =
        capture("egl", smallWindow(Chair), "surfaceless.png", {{"OSG_EGL_DEVICE", "surfaceless"}});
    auto arguments = smallWindow(Chair);
    arguments.insert(arguments.begin(), {"-O", "egl.device=0"});
    const auto device = capture("egl", arguments, "device.png");
    EXPECT_LE(compare(automatic, surfaceless).worst, 2);
    EXPECT_LE(compare(automatic, device).worst, 2);
}

TEST_F(WindowingGLTest, eglAndOSMesaAgreeWithoutSamples)
{
    for (const std::string model : {"chair", "household/teapot", "scenes/stagedancers", "engine"})
    {
        const auto egl = capture("egl", smallWindow(Models + model + ".iv"), "agree_egl.png");
        const auto mesa =
            capture("osmesa", smallWindow(Models + model + ".iv"), "agree_osmesa.png");
        EXPECT_GT(getCoverage(egl), 0.02) << model;
        EXPECT_LE(compare(egl, mesa).worst, 2) << model;
    }
}

TEST_F(WindowingGLTest, eglEqualsARealX11Window)
{
    const XServer server;
    if (server.getDisplay().empty())
    {
        GTEST_SKIP() << "Xvfb is not installed";
    }
    for (const unsigned int samples : {0u, 4u})
    {
        for (const std::string model : {"chair", "engine"})
        {
            const std::string file = Models + model + ".iv";
            const auto x11 = renderInX11(server.getDisplay(), file, samples);
            const auto egl =
                capture("egl", smallWindow(file, std::to_string(samples)), "x11_egl.png");
            EXPECT_GT(getCoverage(x11), 1e-4) << model;
            EXPECT_LE(compare(x11, egl).worst, 2) << model << " " << samples;
        }
    }
}

TEST_F(WindowingGLTest, samplesSmoothEdges)
{
    // Colours between background and model exist only where samples are averaged.
    const std::string file = Models + "chair.iv";
    for (const std::string plugin : {"egl", "osmesa"})
    {
        const auto rough = capture(plugin, smallWindow(file), "rough_" + plugin + ".png");
        const auto smooth = capture(plugin, smallWindow(file, "4"), "smooth_" + plugin + ".png");
        ASSERT_TRUE(rough && smooth);
        std::set<unsigned int> colours[2];
        for (int y = 0; y < rough->t(); ++y)
        {
            for (int x = 0; x < rough->s(); ++x)
            {
                for (int i = 0; i < 2; ++i)
                {
                    const osg::Vec4 c = (i ? smooth : rough)->getColor(x, y) * 255.0f;
                    colours[i].insert((unsigned(c.r()) << 16) | (unsigned(c.g()) << 8) |
                                      unsigned(c.b()));
                }
            }
        }
        EXPECT_GT(colours[1].size(), colours[0].size() + 20) << plugin;
    }
}

TEST_F(WindowingGLTest, userWithoutHomeOrRightsCanRender)
{
    if (geteuid() != 0)
    {
        GTEST_SKIP() << "this user is not root: the other tests show it";
    }
    const auto library = std::filesystem::absolute(std::getenv("OSG_LIBRARY_PATH")).string();
    const ChildResult result =
        runChild({"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "osgviewer", "-e",
                  "egl", "--window", "0", "0", "64", "64", Chair},
                 {{"OSG_RUN_FRAME_COUNT", "2"},
                  {"HOME", "/nonexistent"},
                  {"OSG_LIBRARY_PATH", library},
                  {"OSG_HEADLESS_CAPTURE", "/tmp/osgkits-windowing-test.png"}});
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_GT(getCoverage(osgDB::readRefImageFile("/tmp/osgkits-windowing-test.png")), 0.02);
    std::filesystem::remove("/tmp/osgkits-windowing-test.png");
}
