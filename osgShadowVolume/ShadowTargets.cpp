// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowTargets.h>

#include <osg/ContextData>
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>
#include <osg/GLObjects>
#include <osg/State>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

enum Framebuffers
{
    DepthFramebuffer,
    LayerFramebuffer,
    CounterFramebuffer,
    MaskFramebuffer
};

/// Deletes framebuffers when their context is current.
class FramebufferDeleter : public osg::GLObjectManager
{
public:
    explicit FramebufferDeleter(unsigned int contextID)
        : osg::GLObjectManager("osgShadowVolume::FramebufferDeleter", contextID)
    {
    }
    void deleteGLObject(GLuint id) override
    {
        osg::get<osg::GLExtensions>(_contextID)->glDeleteFramebuffers(1, &id);
    }
};

} // namespace

ShadowTargets::ShadowTargets(unsigned int contextID, const TargetLayout& layout)
    : osg::Referenced(true), _contextID(contextID), _layout(layout)
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

ShadowTargets::~ShadowTargets()
{
    releaseGLObjects(nullptr);
}

std::size_t ShadowTargets::getBytes() const
{
    std::size_t bytes = _opaqueDepth->getBytes() + _counter->getBytes() + _mask->getBytes();
    if (_layerDepths)
        bytes += 2 * _peeledDepth[0]->getBytes() + _layerDepths->getBytes();
    return bytes;
}

void ShadowTargets::bind(osg::State& state, unsigned int which, bool color)
{
    const auto* gl = state.get<osg::GLExtensions>();
    if (!_framebuffers[which])
        gl->glGenFramebuffers(1, &_framebuffers[which]);
    gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, _framebuffers[which]);
    glDrawBuffer(color ? GL_COLOR_ATTACHMENT0_EXT : GL_NONE);
    glReadBuffer(GL_NONE);
}

void ShadowTargets::bindDepth(osg::State& state)
{
    bind(state, DepthFramebuffer, false);
    _opaqueDepth->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
}

void ShadowTargets::bindLayer(osg::State& state, int layer)
{
    bind(state, LayerFramebuffer, true);
    _peeledDepth[layer & 1]->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
    _layerDepths->attach(state, GL_COLOR_ATTACHMENT0_EXT, layer);
}

void ShadowTargets::bindCounter(osg::State& state, int layer)
{
    bind(state, CounterFramebuffer, true);
    _counter->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    (layer < 0 ? _opaqueDepth : _peeledDepth[layer & 1])->attach(state, GL_DEPTH_ATTACHMENT_EXT, 0);
}

void ShadowTargets::bindMask(osg::State& state, int layer, int word)
{
    bind(state, MaskFramebuffer, true);
    _mask->attach(state, GL_COLOR_ATTACHMENT0_EXT, (layer + 1) * _layout.words + word);
}

osg::Texture* ShadowTargets::getDepth(int layer)
{
    return layer < 0 ? _opaqueDepth.get() : _peeledDepth[layer & 1].get();
}

void ShadowTargets::releaseGLObjects(osg::State* state) const
{
    if (state && state->getContextID() != _contextID)
        return;
    auto* self = const_cast<ShadowTargets*>(this);
    for (GLuint& framebuffer : self->_framebuffers)
        if (framebuffer)
        {
            osg::get<FramebufferDeleter>(_contextID)->scheduleGLObjectForDeletion(framebuffer);
            framebuffer = 0;
        }
    for (const osg::Texture* texture :
         {_opaqueDepth.get(), _peeledDepth[0].get(), _peeledDepth[1].get(), _layerDepths.get(),
          _counter.get(), _mask.get()})
        if (texture)
            texture->releaseGLObjects(state);
}

osg::ref_ptr<ShadowTargets> ShadowTargetPool::acquire(unsigned int contextID,
                                                      const TargetLayout& layout)
{
    std::lock_guard<std::mutex> lock(_mutex);
    auto& free = _free[contextID];
    const auto found = std::find_if(free.begin(), free.end(),
                                    [&](const auto& t) { return t->getLayout() == layout; });
    if (found == free.end())
    {
        free.clear(); // a window that was resized, a number of lights that has changed
        return new ShadowTargets(contextID, layout);
    }
    osg::ref_ptr<ShadowTargets> targets = *found;
    free.erase(found);
    return targets;
}

void ShadowTargetPool::release(unsigned int contextID, osg::ref_ptr<ShadowTargets> targets)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _free[contextID].push_back(std::move(targets));
}

void ShadowTargetPool::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!state)
        _free.clear();
    else
        _free.erase(state->getContextID());
}

} // namespace osgShadowVolume
