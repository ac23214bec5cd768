// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/State>

namespace osgMultiRender
{

/// What is bound for drawing in a graphics context: a kit's own framebuffers are made like it.
struct OSGMULTIRENDER_EXPORT DrawTarget
{
    int samples = 1;
    /// Rows count from the top: Mesa draws windows upside down, and so their samples lie elsewhere
    /// in a pixel than those of framebuffer objects.
    bool flipped = false;
    GLenum colorFormat = GL_RGBA8;             ///< As precise as the target's, with alpha.
    GLenum depthFormat = GL_DEPTH_COMPONENT24; ///< For textures that are copied into it.
    bool hasDepth = true;
    bool several = false; ///< More than one colour buffer is written.

    /// Asks GL; the context is current.
    static DrawTarget current(const osg::State& state);
};

} // namespace osgMultiRender
