// SPDX-License-Identifier: MIT
#include <osgMultiRender/Framebuffer.h>

#include <osg/ContextData>
#include <osg/FrameBufferObject>
#include <osg/GLObjects>

#include <sstream>

#ifndef GL_FRAMEBUFFER_FLIP_Y_MESA
#define GL_FRAMEBUFFER_FLIP_Y_MESA 0x8BBB
#endif

namespace osgMultiRender
{

namespace
{

/// Deletes framebuffers when their context is current.
class FramebufferDeleter : public osg::GLObjectManager
{
public:
    explicit FramebufferDeleter(unsigned int contextID)
        : osg::GLObjectManager("osgMultiRender::FramebufferDeleter", contextID)
    {
    }
    void deleteGLObject(GLuint id) override
    {
        osg::get<osg::GLExtensions>(_contextID)->glDeleteFramebuffers(1, &id);
    }
};

} // namespace

Framebuffer::~Framebuffer()
{
    releaseGLObjects(nullptr);
}

void Framebuffer::bind(osg::State& state, int colors)
{
    const auto* gl = state.get<osg::GLExtensions>();
    const bool isNew = !_id;
    if (isNew)
        gl->glGenFramebuffers(1, &_id);
    gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, _id);
    if (isNew && _flipped)
        gl->glFramebufferParameteri(GL_FRAMEBUFFER_EXT, GL_FRAMEBUFFER_FLIP_Y_MESA, GL_TRUE);
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0_EXT, GL_COLOR_ATTACHMENT0_EXT + 1,
                              GL_COLOR_ATTACHMENT0_EXT + 2, GL_COLOR_ATTACHMENT0_EXT + 3};
    if (colors > 1)
        gl->glDrawBuffers(colors, buffers);
    else
        glDrawBuffer(colors ? GL_COLOR_ATTACHMENT0_EXT : GL_NONE);
    glReadBuffer(GL_NONE);
}

bool Framebuffer::canFlip(const osg::State& state)
{
    return state.get<osg::GLExtensions>()->glFramebufferParameteri &&
           osg::isGLExtensionSupported(state.getContextID(), "GL_MESA_framebuffer_flip_y");
}

std::string Framebuffer::whyIncomplete(const osg::State& state)
{
    const GLenum status =
        state.get<osg::GLExtensions>()->glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER_EXT);
    if (status == GL_FRAMEBUFFER_COMPLETE_EXT)
        return {};
    std::ostringstream text;
    text << "framebuffer status 0x" << std::hex << status;
    return text.str();
}

void Framebuffer::releaseGLObjects(osg::State* state) const
{
    if (!_id || (state && state->getContextID() != _contextID))
        return;
    osg::get<FramebufferDeleter>(_contextID)->scheduleGLObjectForDeletion(_id);
    _id = 0;
}

FramebufferVisit::FramebufferVisit(osg::State& state) : _state(state)
{
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING_EXT, &_draw);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING_EXT, &_read);
    glGetIntegerv(GL_VIEWPORT, _viewport);
    _applied = _state.getCurrentViewport();
    glGetFloatv(GL_COLOR_CLEAR_VALUE, _color);
    glGetDoublev(GL_DEPTH_CLEAR_VALUE, &_depth);
    _hasScissor = glIsEnabled(GL_SCISSOR_TEST);
    glGetIntegerv(GL_SCISSOR_BOX, _scissor);
    glDisable(GL_SCISSOR_TEST);
    _state.haveAppliedMode(GL_SCISSOR_TEST, osg::StateAttribute::OFF);
    glClearDepth(1.0);
}

FramebufferVisit::~FramebufferVisit()
{
    const auto* gl = _state.get<osg::GLExtensions>();
    gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, GLuint(_draw));
    gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, GLuint(_read));
    glViewport(_viewport[0], _viewport[1], _viewport[2], _viewport[3]);
    glClearColor(_color[0], _color[1], _color[2], _color[3]);
    glClearDepth(_depth);
    glScissor(_scissor[0], _scissor[1], _scissor[2], _scissor[3]);
    (_hasScissor ? glEnable : glDisable)(GL_SCISSOR_TEST);
    _state.haveAppliedMode(GL_SCISSOR_TEST, _hasScissor);
    _state.haveAppliedAttribute(osg::StateAttribute::SCISSOR);
    // Who asks osg::State for its viewport, such as a drawable of text, gets the one of before.
    if (_applied)
        _state.haveAppliedAttribute(_applied.get());
    else
        _state.haveAppliedAttribute(osg::StateAttribute::VIEWPORT);
}

} // namespace osgMultiRender
