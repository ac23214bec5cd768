// SPDX-License-Identifier: MIT
// Reading pixels of multisampled framebuffers; for osgrender and the windowing plugins.
#pragma once

#include <osg/FrameBufferObject>
#include <osg/GLExtensions>

namespace osgHeadless
{

/// Averages the samples of the framebuffer that is bound for reading into one of its own, which is
/// the one for reading as long as this lives; then `after` is bound.
///
/// glReadPixels of a multisampled window is allowed to average, and Mesa's does not: it reads one
/// sample.
class Resolve
{
public:
    Resolve(const osg::GLExtensions& gl, GLuint after, int width, int height)
        : _gl(gl), _after(after)
    {
        _gl.glGenFramebuffers(1, &_framebuffer);
        _gl.glGenRenderbuffers(1, &_colors);
        _gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _colors);
        _gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_RGBA8, width, height);
        _gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, _framebuffer);
        _gl.glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT,
                                      GL_RENDERBUFFER_EXT, _colors);
        // A scissor cuts a blit too.
        const GLboolean scissor = glIsEnabled(GL_SCISSOR_TEST);
        glDisable(GL_SCISSOR_TEST);
        _gl.glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                              GL_NEAREST);
        if (scissor)
            glEnable(GL_SCISSOR_TEST);
        _gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, _framebuffer);
    }

    ~Resolve()
    {
        _gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, _after);
        _gl.glDeleteRenderbuffers(1, &_colors);
        _gl.glDeleteFramebuffers(1, &_framebuffer);
    }

    Resolve(const Resolve&) = delete;
    Resolve& operator=(const Resolve&) = delete;

private:
    const osg::GLExtensions& _gl;
    GLuint _after;
    GLuint _framebuffer = 0;
    GLuint _colors = 0;
};

} // namespace osgHeadless
