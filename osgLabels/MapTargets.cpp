// SPDX-License-Identifier: MIT
#include <osgLabels/MapTargets.h>

#include <osg/FrameBufferObject>

#include <cstring>

namespace osgLabels
{

using osgMultiRender::TargetTexture;

MapTargets::MapTargets(unsigned int contextID, const MapLayout& layout)
    : osg::Referenced(true), _layout(layout), _framebuffer(contextID),
      _near(new TargetTexture(GL_RG32UI, layout.width, layout.height, layout.actions, 1)),
      _color(new TargetTexture(GL_RGBA8, layout.width, layout.height, 0, 1)),
      _depth(new TargetTexture(GL_DEPTH_COMPONENT32F, layout.width, layout.height, 0, 1))
{
    if (layout.next)
        _next = new TargetTexture(GL_RG32UI, layout.width, layout.height,
                                  layout.actions * layout.next, 1);
}

std::size_t MapTargets::getBytes() const
{
    std::size_t bytes = 0;
    for (const TargetTexture* texture : {_near.get(), _next.get(), _color.get(), _depth.get()})
        bytes += texture ? texture->getBytes() : 0;
    return bytes;
}

void MapTargets::bind(osg::State& state, int action, int next)
{
    _framebuffer.bind(state, 2);
    _depth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    _color->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    if (next)
        _next->attach(state, GL_COLOR_ATTACHMENT0_EXT + 1, (next - 1) * _layout.actions + action);
    else
        _near->attach(state, GL_COLOR_ATTACHMENT0_EXT + 1, action);
}

MapTargets::Texel MapTargets::read(osg::State& state, int action, int next, int x, int y)
{
    Texel texel;
    if (x < 0 || y < 0 || x >= _layout.width || y >= _layout.height)
        return texel;
    bind(state, action, next);
    glReadBuffer(GL_COLOR_ATTACHMENT0_EXT + 1);
    GLuint words[2] = {0, 0};
    glReadPixels(x, y, 1, 1, GL_RG_INTEGER, GL_UNSIGNED_INT, words);
    texel.number = words[0];
    std::memcpy(&texel.distance, &words[1], sizeof texel.distance);
    return texel;
}

} // namespace osgLabels
