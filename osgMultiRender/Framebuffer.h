// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/GLExtensions>
#include <osg/State>
#include <osg/Viewport>

#include <string>

namespace osgMultiRender
{

/// A framebuffer object of one graphics context, without attachments of its own.
class OSGMULTIRENDER_EXPORT Framebuffer
{
public:
    /// `flipped`: its rows count from the top, as in windows of Mesa. Needs canFlip().
    explicit Framebuffer(unsigned int contextID, bool flipped = false)
        : _contextID(contextID), _flipped(flipped)
    {
    }
    /// Deletes it when the context is current next.
    ~Framebuffer();
    Framebuffer(const Framebuffer&) = delete;
    Framebuffer& operator=(const Framebuffer&) = delete;

    /// Binds it for drawing into the first `colors` colour attachments; 0 is depth alone.
    /// Attachments stay.
    void bind(osg::State& state, int colors);
    void releaseGLObjects(osg::State* state) const;

    static bool canFlip(const osg::State& state);
    /// Of the framebuffer that is bound for drawing: empty, or why OpenGL can't draw into it, as in
    /// "framebuffer status 0x8cd6".
    static std::string whyIncomplete(const osg::State& state);

private:
    const unsigned int _contextID;
    const bool _flipped;
    mutable GLuint _id = 0;
};

/// While it lives, drawing may visit other framebuffers: it puts back the bindings, the viewport,
/// the scissor and the values for clearing. There is no scissor test at first.
class OSGMULTIRENDER_EXPORT FramebufferVisit
{
public:
    explicit FramebufferVisit(osg::State& state);
    ~FramebufferVisit();
    FramebufferVisit(const FramebufferVisit&) = delete;
    FramebufferVisit& operator=(const FramebufferVisit&) = delete;

private:
    osg::State& _state;
    GLint _draw = 0, _read = 0;
    GLint _viewport[4] = {};
    osg::ref_ptr<const osg::Viewport> _applied; ///< As `_state` has it.
    GLfloat _color[4] = {};
    GLdouble _depth = 1.0;
    GLboolean _hasScissor = GL_FALSE;
    GLint _scissor[4] = {};
};

} // namespace osgMultiRender
