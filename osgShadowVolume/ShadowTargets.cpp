// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowTargets.h>

#include <osg/FrameBufferObject>
#include <osg/State>

namespace osgShadowVolume
{

ShadowTargets::ShadowTargets(unsigned int contextID, const TargetLayout& layout)
    : osg::Referenced(true), _layout(layout), _depth(contextID, layout.flipped),
      _layer(contextID, layout.flipped), _counting(contextID, layout.flipped),
      _masking(contextID, layout.flipped)
{
    const auto make = [&](GLenum format, int layers)
    { return new TargetTexture(format, layout.width, layout.height, layers, layout.samples); };
    _opaqueDepth = make(GL_DEPTH_COMPONENT32F, 0);
    _counter = make(GL_R32F, 0);
    _mask = make(GL_R32UI, layout.words * (1 + layout.layers));
    if (!layout.layers)
        return;
    for (auto& depth : _peeledDepth)
        depth = make(GL_DEPTH_COMPONENT32F, 0);
    _layerDepths = make(GL_R32F, layout.layers);
}

ShadowTargets::~ShadowTargets() = default;

std::size_t ShadowTargets::getBytes() const
{
    std::size_t bytes = _opaqueDepth->getBytes() + _counter->getBytes() + _mask->getBytes();
    if (_layerDepths)
        bytes += 2 * _peeledDepth[0]->getBytes() + _layerDepths->getBytes();
    return bytes;
}

const std::string& ShadowTargets::whyIncomplete(osg::State& state)
{
    if (_whyIncomplete)
        return *_whyIncomplete;
    _whyIncomplete.emplace();
    const auto check = [&]
    {
        if (_whyIncomplete->empty())
            *_whyIncomplete = Framebuffer::whyIncomplete(state);
    };
    bindDepth(state);
    check();
    bindCounter(state, -1);
    check();
    bindMask(state, -1, 0);
    check();
    if (_layout.layers)
    {
        bindLayer(state, 0);
        check();
    }
    return *_whyIncomplete;
}

void ShadowTargets::bindDepth(osg::State& state)
{
    _depth.bind(state, false);
    _opaqueDepth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
}

void ShadowTargets::bindLayer(osg::State& state, int layer)
{
    _layer.bind(state, true);
    _peeledDepth[layer & 1]->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    _layerDepths->attach(state, GL_COLOR_ATTACHMENT0_EXT, layer);
}

void ShadowTargets::bindCounter(osg::State& state, int layer)
{
    _counting.bind(state, true);
    _counter->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    (layer < 0 ? _opaqueDepth : _peeledDepth[layer & 1])->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
}

void ShadowTargets::bindMask(osg::State& state, int layer, int word)
{
    _masking.bind(state, true);
    _mask->attach(state, GL_COLOR_ATTACHMENT0_EXT, (layer + 1) * _layout.words + word);
}

osg::Texture* ShadowTargets::getDepth(int layer)
{
    return layer < 0 ? _opaqueDepth.get() : _peeledDepth[layer & 1].get();
}

void ShadowTargets::releaseGLObjects(osg::State* state) const
{
    for (const Framebuffer* framebuffer : {&_depth, &_layer, &_counting, &_masking})
        framebuffer->releaseGLObjects(state);
    for (const osg::Texture* texture :
         {_opaqueDepth.get(), _peeledDepth[0].get(), _peeledDepth[1].get(), _layerDepths.get(),
          _counter.get(), _mask.get()})
        if (texture)
            texture->releaseGLObjects(state);
}

} // namespace osgShadowVolume
