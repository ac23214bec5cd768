// SPDX-License-Identifier: MIT
#include <support/HeadlessViewer.h>

#include <osg/FrameBufferObject>
#include <osg/GL>
#include <osg/GLExtensions>
#include <osg/Texture>
#include <osgDB/Registry>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <sstream>

namespace support
{

namespace
{

/// Reads the picture at the end of a frame, in whichever thread draws.
class Readback : public osg::Camera::DrawCallback
{
public:
    void expect(int width, int height, osg::Image* target, GLenum type = GL_UNSIGNED_BYTE)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _width = width;
        _height = height;
        _type = type;
        _target = target;
    }

    void operator()(osg::RenderInfo& renderInfo) const override
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (_target.valid())
            readResolved(*renderInfo.getState());
        for (const std::string& error : takeGLErrors())
            _errors.push_back(error);
        _drawnFrame = renderInfo.getState()->getFrameStamp()->getFrameNumber();
        _drawn.notify_all();
    }

    bool waitFor(unsigned int frame) const
    {
        std::unique_lock<std::mutex> lock(_mutex);
        return _drawn.wait_for(lock, std::chrono::minutes(1), [&] { return _drawnFrame == frame; });
    }

    std::vector<std::string> takeErrors() const
    {
        std::lock_guard<std::mutex> lock(_mutex);
        return std::move(_errors);
    }

private:
    /// Mesa's llvmpipe gives glReadPixels one sample of a multisampled surface; a blit averages.
    void readResolved(osg::State& state) const
    {
        GLint samples = 0;
        glGetIntegerv(GL_SAMPLES, &samples);
        if (samples < 2)
        {
            _target->readPixels(0, 0, _width, _height, GL_RGBA, _type);
            return;
        }
        const osg::GLExtensions* gl = state.get<osg::GLExtensions>();
        const GLuint drawn = state.getGraphicsContext()->getDefaultFboId();
        GLuint framebuffer = 0, color = 0;
        gl->glGenFramebuffers(1, &framebuffer);
        gl->glGenRenderbuffers(1, &color);
        gl->glBindRenderbuffer(GL_RENDERBUFFER_EXT, color);
        gl->glRenderbufferStorage(GL_RENDERBUFFER_EXT,
                                  _type == GL_FLOAT ? GL_RGBA32F_ARB : GL_RGBA8, _width, _height);
        gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, drawn);
        gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, framebuffer);
        gl->glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT,
                                      GL_RENDERBUFFER_EXT, color);
        gl->glBlitFramebuffer(0, 0, _width, _height, 0, 0, _width, _height, GL_COLOR_BUFFER_BIT,
                              GL_NEAREST);
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, framebuffer);
        _target->readPixels(0, 0, _width, _height, GL_RGBA, _type);
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, drawn);
        gl->glDeleteRenderbuffers(1, &color);
        gl->glDeleteFramebuffers(1, &framebuffer);
    }

    mutable std::mutex _mutex;
    mutable std::condition_variable _drawn;
    mutable unsigned int _drawnFrame = ~0u;
    mutable std::vector<std::string> _errors;
    int _width = 0, _height = 0;
    GLenum _type = GL_UNSIGNED_BYTE;
    osg::ref_ptr<osg::Image> _target;
};

/// Makes Mesa take over the material values of the last frame. Mesa 22.3 keeps glMaterial's values
/// pending, and writes them over what a later GL_COLOR_MATERIAL has made of the current color: from
/// the second frame on, a material that tracks the color would show the last one's values.
///
/// Then draws into a framebuffer object of floats, where one is asked for. (A target that is
/// attached to the viewer's camera is read from the window's buffers, which it does not have.)
class FrameStart : public osg::Camera::DrawCallback
{
public:
    FrameStart(int width, int height, unsigned int samples)
        : _width(width), _height(height), _samples(samples)
    {
    }

    std::atomic<bool> toFloats{false};

    void operator()(osg::RenderInfo& renderInfo) const override
    {
        GLfloat color[4];
        glGetFloatv(GL_CURRENT_COLOR, color);
        osg::State& state = *renderInfo.getState();
        const osg::GLExtensions* gl = state.get<osg::GLExtensions>();
        if (toFloats && !_framebuffer)
            create(*gl);
        const GLuint framebuffer = toFloats ? _framebuffer : 0;
        state.getGraphicsContext()->setDefaultFboId(framebuffer);
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, framebuffer);
    }

private:
    void create(const osg::GLExtensions& gl) const
    {
        const auto attach = [&](GLenum format, std::initializer_list<GLenum> attachments)
        {
            GLuint buffer = 0;
            gl.glGenRenderbuffers(1, &buffer);
            gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffer);
            gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, _samples, format, _width,
                                                _height);
            for (GLenum attachment : attachments)
                gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, attachment, GL_RENDERBUFFER_EXT,
                                             buffer);
        };
        gl.glGenFramebuffers(1, &_framebuffer);
        gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, _framebuffer);
        attach(GL_RGBA32F_ARB, {GL_COLOR_ATTACHMENT0_EXT});
        attach(GL_DEPTH24_STENCIL8_EXT, {GL_DEPTH_ATTACHMENT_EXT, GL_STENCIL_ATTACHMENT_EXT});
    }

    int _width, _height;
    unsigned int _samples;
    mutable GLuint _framebuffer = 0; ///< Lives as long as the context.
};

std::string loadWindowingPlugin()
{
    osgDB::Registry* registry = osgDB::Registry::instance();
    registry->getLibraryFilePathList().push_front(OSGKITS_LIBRARY_FOLDER);
    const std::string name = registry->createLibraryNameForExtension("egl");
    if (registry->loadLibrary(name) == osgDB::Registry::NOT_LOADED)
        return "the plugin " + name + " could not be loaded from " OSGKITS_LIBRARY_FOLDER;
    return {};
}

osg::ref_ptr<osg::GraphicsContext> createContext(const HeadlessSettings& settings)
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->width = settings.width;
    traits->height = settings.height;
    traits->alpha = 8;
    traits->depth = 24;
    traits->stencil = 8;
    traits->samples = settings.samples;
    traits->doubleBuffer = true;
    traits->windowDecoration = false;
    return osg::GraphicsContext::createGraphicsContext(traits);
}

} // namespace

struct HeadlessViewer::State
{
    HeadlessSettings settings;
    std::string error;
    double time = 0.0;
    bool failOnGLErrors = true;
    std::vector<std::string> glErrors;
    osg::ref_ptr<Readback> readback = new Readback;
    osg::ref_ptr<FrameStart> start;
    osgViewer::Viewer viewer;

    bool prepare(osg::Node* node, const CameraSpec& camera, int width, int height);
    bool drawFrames(unsigned int frames);
};

HeadlessViewer::HeadlessViewer(const HeadlessSettings& settings) : _state(new State)
{
    _state->settings = settings;
    static const std::string pluginError = loadWindowingPlugin();
    _state->error = pluginError;
    if (!_state->error.empty())
        return;
    osg::ref_ptr<osg::GraphicsContext> context = createContext(settings);
    if (!context.valid())
    {
        _state->error = "no EGL context could be made";
        return;
    }
    osgViewer::Viewer& viewer = _state->viewer;
    osg::Camera* camera = viewer.getCamera();
    camera->setGraphicsContext(context);
    camera->setViewport(0, 0, settings.width, settings.height);
    camera->setDrawBuffer(GL_BACK);
    camera->setReadBuffer(GL_BACK);
    camera->setClearColor(settings.clearColor);
    camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    _state->start = new FrameStart(settings.width, settings.height, settings.samples);
    camera->setInitialDrawCallback(_state->start);
    camera->setFinalDrawCallback(_state->readback);
    if (!settings.smallFeatureCulling)
        camera->setCullingMode(camera->getCullingMode() &
                               ~osg::CullSettings::SMALL_FEATURE_CULLING);
    camera->getOrCreateStateSet()->setMode(GL_DITHER, osg::StateAttribute::OFF |
                                                          osg::StateAttribute::OVERRIDE);
    viewer.setThreadingModel(settings.threading);
    viewer.setReleaseContextAtEndOfFrameHint(false);
    viewer.realize();
    if (!viewer.isRealized())
        _state->error = "the EGL context could not be realized";
    else
        context->getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS);
}

HeadlessViewer::~HeadlessViewer() = default;

bool HeadlessViewer::isValid() const
{
    return _state->error.empty();
}

const std::string& HeadlessViewer::getError() const
{
    return _state->error;
}

void HeadlessViewer::setSimulationTime(double seconds)
{
    _state->time = seconds;
}

void HeadlessViewer::setFailOnGLErrors(bool fail)
{
    _state->failOnGLErrors = fail;
}

const std::vector<std::string>& HeadlessViewer::getGLErrors() const
{
    return _state->glErrors;
}

std::string HeadlessViewer::getRenderer()
{
    osgViewer::Viewer::Contexts contexts;
    getViewer().getContexts(contexts);
    if (contexts.empty() || !contexts.front()->makeCurrent())
        return "unknown renderer";
    const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string renderer = name ? name : "unknown renderer";
    contexts.front()->releaseContext();
    return renderer;
}

osgViewer::Viewer& HeadlessViewer::getViewer()
{
    return _state->viewer;
}

bool HeadlessViewer::State::prepare(osg::Node* node, const CameraSpec& camera, int width,
                                    int height)
{
    if (!error.empty())
    {
        ADD_FAILURE() << "HeadlessViewer: " << error;
        return false;
    }
    if (width < 1 || height < 1 || width > settings.width || height > settings.height)
    {
        ADD_FAILURE() << "HeadlessViewer: a picture of " << width << "x" << height
                      << " does not fit the context of " << settings.width << "x"
                      << settings.height;
        return false;
    }
    if (viewer.getSceneData() != node)
        viewer.setSceneData(node);
    viewer.getCamera()->setViewport(0, 0, width, height);
    viewer.getCamera()->setViewMatrix(camera.view);
    viewer.getCamera()->setProjectionMatrix(camera.projection);
    return true;
}

bool HeadlessViewer::State::drawFrames(unsigned int frames)
{
    glErrors.clear();
    // A viewer takes its context for current until it changes it, whatever another viewer in this
    // thread has made current or closed since.
    osg::GraphicsContext* context = viewer.getCamera()->getGraphicsContext();
    if (viewer.isRealized() && viewer.getThreadingModel() == osgViewer::ViewerBase::SingleThreaded)
        context->makeCurrent();
    for (unsigned int i = 0; i < frames; ++i)
    {
        viewer.frame(time);
        if (!readback->waitFor(viewer.getFrameStamp()->getFrameNumber()))
        {
            ADD_FAILURE() << "HeadlessViewer: a frame was not drawn within a minute";
            return false;
        }
        for (const std::string& glError : readback->takeErrors())
        {
            glErrors.push_back(glError);
            if (failOnGLErrors)
                ADD_FAILURE() << "HeadlessViewer: " << glError << " in frame " << i;
        }
    }
    return true;
}

osg::ref_ptr<osg::Image> HeadlessViewer::render(osg::Node* node, const CameraSpec& camera,
                                                int width, int height, unsigned int frames)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    if (!_state->prepare(node, camera, width, height))
        return nullptr;
    _state->readback->expect(width, height, image);
    const bool drawn = _state->drawFrames(frames);
    _state->readback->expect(0, 0, nullptr);
    return drawn ? image : nullptr;
}

osg::ref_ptr<osg::Image> HeadlessViewer::renderFloat(osg::Node* node, const CameraSpec& camera,
                                                     int width, int height, unsigned int frames)
{
    if (!_state->prepare(node, camera, width, height))
        return nullptr;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    osg::Camera* master = _state->viewer.getCamera();
    master->setDrawBuffer(GL_COLOR_ATTACHMENT0_EXT);
    master->setReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
    _state->start->toFloats = true;
    _state->readback->expect(width, height, image, GL_FLOAT);
    const bool drawn = _state->drawFrames(frames);
    _state->readback->expect(0, 0, nullptr);
    _state->start->toFloats = false;
    master->setDrawBuffer(GL_BACK);
    master->setReadBuffer(GL_BACK);
    return drawn ? image : nullptr;
}

CameraSpec CameraSpec::perspective(const osg::Vec3d& eye, const osg::Vec3d& center,
                                   const osg::Vec3d& up, double fovy, double aspect, double zNear,
                                   double zFar)
{
    return {osg::Matrixd::lookAt(eye, center, up),
            osg::Matrixd::perspective(fovy, aspect, zNear, zFar)};
}

CameraSpec CameraSpec::overview(const osg::Node& node, double aspect)
{
    const osg::BoundingSphere bound = node.getBound();
    const double radius = bound.valid() && bound.radius() > 0.0f ? bound.radius() : 1.0;
    const osg::Vec3d center = bound.valid() ? osg::Vec3d(bound.center()) : osg::Vec3d();
    const osg::Vec3d offset = osg::Vec3d(0.3, -1.0, 0.35) * (radius * 3.6);
    const double distance = offset.length();
    return perspective(center + offset, center, osg::Vec3d(0, 0, 1), 30.0, aspect,
                       distance - 1.05 * radius, distance + 1.05 * radius);
}

std::vector<std::string> takeGLErrors()
{
    std::vector<std::string> errors;
    // A lost context reports an error for ever.
    for (int i = 0; i < 16; ++i)
    {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR)
            break;
        std::ostringstream text;
        text << "GL error 0x" << std::hex << error;
        errors.push_back(text.str());
    }
    return errors;
}

bool isGLRequired()
{
    return std::getenv("OSGKITS_REQUIRE_GL") != nullptr;
}

} // namespace support
