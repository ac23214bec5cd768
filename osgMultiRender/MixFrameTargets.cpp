// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixFrameTargets.h>

#include <osgMultiRender/ScreenTriangle.h>

#include <osg/FrameBufferObject>
#include <osg/TexMat>

namespace osgMultiRender
{

MixFrameTargets::MixFrameTargets(unsigned int contextID, const Layout& layout)
    : _layout(layout), _framebuffer(contextID),
      _color(new TargetTexture(layout.colorFormat, layout.width, layout.height, 0, 1)),
      _depth(new TargetTexture(layout.depthFormat, layout.width, layout.height, 0, 1)),
      _triangle(makeScreenTriangle()), _stateSet(new osg::StateSet)
{
    _color->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    _color->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    // What renderings of images read at the corners; those of surfaces see a white plane.
    const osg::Vec2 places[] = {{0, 0}, {2, 0}, {0, 2}};
    _triangle->setTexCoordArray(0, new osg::Vec2Array(3, places), osg::Array::BIND_PER_VERTEX);
    const osg::Vec3 normal(0, 0, 1);
    _triangle->setNormalArray(new osg::Vec3Array(1, &normal), osg::Array::BIND_OVERALL);
    const osg::Vec4 white(1, 1, 1, 1);
    _triangle->setColorArray(new osg::Vec4Array(1, &white), osg::Array::BIND_OVERALL);
    const auto wins =
        osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
    _stateSet->setTextureAttribute(0, _color, wins);
    _stateSet->setTextureAttribute(0, new osg::TexMat, wins);
    _stateSet->setTextureAttribute(DepthUnit, _depth, wins);
    _stateSet->addUniform(new osg::Uniform("osgmr_mixDepth", static_cast<int>(DepthUnit)));
}

GLenum MixFrameTargets::depthFormatOf()
{
    constexpr GLenum componentType = 0x8211, depthOfWindow = 0x1801;
    GLint from = 0, type = 0, bits = 0, stencilBits = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING_EXT, &from);
    glGetIntegerv(GL_DEPTH_BITS, &bits);
    glGetIntegerv(GL_STENCIL_BITS, &stencilBits);
    // osg::GLExtensions lacks it.
    using Query = void(GL_APIENTRY*)(GLenum, GLenum, GLenum, GLint*);
    Query query = nullptr;
    if (osg::setGLExtensionFuncPtr(query, "glGetFramebufferAttachmentParameteriv"))
        query(GL_DRAW_FRAMEBUFFER_EXT, from ? GL_DEPTH_ATTACHMENT_EXT : depthOfWindow,
              componentType, &type);
    if (type == GL_FLOAT)
        return stencilBits ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
    if (bits > 24)
        return GL_DEPTH_COMPONENT32;
    if (bits > 16)
        return stencilBits ? GL_DEPTH24_STENCIL8_EXT : GL_DEPTH_COMPONENT24;
    return GL_DEPTH_COMPONENT16;
}

std::string MixFrameTargets::copy(osg::State& state, int x, int y)
{
    const auto* gl = state.get<osg::GLExtensions>();
    GLint from = 0, drawBuffer = 0, readBuffer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING_EXT, &from);
    glGetIntegerv(GL_DRAW_BUFFER, &drawBuffer);
    const FramebufferVisit visit(state);
    _framebuffer.bind(state, 1);
    _color->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    _depth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    if (const std::string why = Framebuffer::whyIncomplete(state); !why.empty())
        return why;
    gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, GLuint(from));
    glGetIntegerv(GL_READ_BUFFER, &readBuffer);
    glReadBuffer(GLenum(drawBuffer));
    const auto blit = [&](GLbitfield what)
    {
        gl->glBlitFramebuffer(x, y, x + _layout.width, y + _layout.height, 0, 0, _layout.width,
                              _layout.height, what, GL_NEAREST);
    };
    while (glGetError() != GL_NO_ERROR) // of others, so that what follows is known to be ours
    {
    }
    blit(GL_COLOR_BUFFER_BIT);
    blit(GL_DEPTH_BUFFER_BIT);
    const GLenum error = glGetError();
    glReadBuffer(GLenum(readBuffer));
    if (error != GL_NO_ERROR)
        return "the frame can't be copied, GL error " + std::to_string(error);
    return {};
}

} // namespace osgMultiRender
