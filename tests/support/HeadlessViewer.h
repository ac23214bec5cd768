// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>
#include <osg/Matrixd>
#include <osg/Node>
#include <osgViewer/Viewer>

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace support
{

/// A fixed camera. No near/far is computed from the scene: both are part of the picture.
struct CameraSpec
{
    osg::Matrixd view;       ///< World to eye.
    osg::Matrixd projection; ///< Eye to clip, for the picture's own aspect ratio.

    /// A perspective camera; `fovy` in degrees, `aspect` is width / height.
    static CameraSpec perspective(const osg::Vec3d& eye, const osg::Vec3d& center,
                                  const osg::Vec3d& up, double fovy, double aspect, double zNear,
                                  double zFar);

    /// Sees all of `node` from the front right, z up; finite for an empty node too.
    static CameraSpec overview(const osg::Node& node, double aspect);
};

/// How a HeadlessViewer is set up.
struct HeadlessSettings
{
    int width = 320;  ///< Pixels; no picture can be larger.
    int height = 240; ///< Pixels.
    unsigned int samples = 0;
    bool smallFeatureCulling = false; ///< Off, so that no tiny thing depends on the picture size.
    osgViewer::ViewerBase::ThreadingModel threading = osgViewer::ViewerBase::SingleThreaded;
    osg::Vec4 clearColor{0.2f, 0.2f, 0.4f, 1.0f};
};

/// An osgViewer::Viewer over an EGL context of osgdb_egl, for pictures that are the same each time.
///
/// The simulation time is fixed, dithering is off. GL errors, which OSG does not look for here,
/// are failures of the running test. Use from one thread; it lives until its GL objects are gone.
class HeadlessViewer
{
public:
    explicit HeadlessViewer(const HeadlessSettings& settings = HeadlessSettings());
    ~HeadlessViewer();
    HeadlessViewer(const HeadlessViewer&) = delete;
    HeadlessViewer& operator=(const HeadlessViewer&) = delete;

    /// False where no context could be made; see OSGKITS_NEED_GL.
    bool isValid() const;

    /// Why isValid() is false.
    const std::string& getError() const;

    /// Draws `frames` frames and returns the last one as RGBA8, row 0 at the bottom. A frame that
    /// is not drawn within a minute and a size over the settings' are failures; null is returned.
    osg::ref_ptr<osg::Image> render(osg::Node* node, const CameraSpec& camera, int width,
                                    int height, unsigned int frames = 1);

    /// As render(), into a float target: RGBA32F, not clamped by the framebuffer.
    osg::ref_ptr<osg::Image> renderFloat(osg::Node* node, const CameraSpec& camera, int width,
                                         int height, unsigned int frames = 1);

    /// Seconds that all following frames take as their simulation time; 0 at first.
    void setSimulationTime(double seconds);

    /// Whether a GL error in a frame is a failure, as at first; for scenes that raise errors in
    /// OSG.
    void setFailOnGLErrors(bool fail);

    /// Those of the frames of the last picture.
    const std::vector<std::string>& getGLErrors() const;

    /// For what else a test needs: lights, the camera's StateSet, statistics.
    osgViewer::Viewer& getViewer();

    /// As GL names it.
    std::string getRenderer();

private:
    struct State;
    std::unique_ptr<State> _state;
};

/// Names of the errors that the current context has pending; the queue is empty afterwards.
std::vector<std::string> takeGLErrors();

/// True where the environment has OSGKITS_REQUIRE_GL: no context is a failure, not a skip.
bool isGLRequired();

} // namespace support

/// At the head of a test: without a context skips loudly, or fails under OSGKITS_REQUIRE_GL.
#define OSGKITS_NEED_GL(viewer)                                                                    \
    do                                                                                             \
    {                                                                                              \
        if (!(viewer).isValid() && support::isGLRequired())                                        \
            FAIL() << "OSGKITS_REQUIRE_GL is set, but: " << (viewer).getError();                   \
        if (!(viewer).isValid())                                                                   \
            GTEST_SKIP() << "NOT TESTED: " << (viewer).getError();                                 \
    } while (false)

/// For code that makes its own context current.
#define EXPECT_NO_GL_ERRORS() EXPECT_EQ(support::takeGLErrors(), std::vector<std::string>())
