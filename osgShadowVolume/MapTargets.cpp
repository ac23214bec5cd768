// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MapTargets.h>

#include <osg/FrameBufferObject>
#include <osg/Image>
#include <osg/Viewport>

#include <algorithm>
#include <cstring>

namespace osgShadowVolume
{

namespace
{

constexpr int texelsPerLight = int(MapTargets::FloatsPerLight / 4);
constexpr int lightsPerRow = 256; // shaders/map.frag knows it

osg::ref_ptr<osg::Texture2D> makeTable()
{
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setInternalFormat(GL_RGBA32F_ARB);
    texture->setSourceFormat(GL_RGBA);
    texture->setSourceType(GL_FLOAT);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

} // namespace

MapTargets::MapTargets(unsigned int contextID, const MapLayout& layout)
    : osg::Referenced(true), _layout(layout), _framebuffer(contextID),
      _maps(new TargetTexture(GL_DEPTH_COMPONENT32F, int(layout.size), int(layout.size),
                              int(layout.layers), 1)),
      _data(makeTable()), _drawState(new osg::StateSet), _stateSet(new osg::StateSet)
{
    // As an attribute: osg::State applies a viewport of its own wherever it knows of none.
    _drawState->setAttribute(new osg::Viewport(0, 0, layout.size, layout.size),
                             osg::StateAttribute::OVERRIDE);
    _maps->setShadowComparison(true);
    _maps->setShadowCompareFunc(osg::Texture::LEQUAL);
    _stateSet->setTextureAttribute(MapsUnit, _maps, osg::StateAttribute::OVERRIDE);
    _stateSet->setTextureAttribute(DataUnit, _data, osg::StateAttribute::OVERRIDE);
}

MapTargets::~MapTargets() = default;

const std::string& MapTargets::whyIncomplete(osg::State& state)
{
    if (!_whyIncomplete)
    {
        bind(state, 0);
        _whyIncomplete = Framebuffer::whyIncomplete(state);
    }
    return *_whyIncomplete;
}

void MapTargets::bind(osg::State& state, unsigned int layer)
{
    _framebuffer.bind(state, false);
    _maps->attach(state, GL_DEPTH_ATTACHMENT_EXT, int(layer));
}

void MapTargets::setData(const std::vector<float>& data)
{
    const std::size_t perRow = std::size_t(lightsPerRow) * FloatsPerLight;
    const int rows = std::max<int>(1, int((data.size() + perRow - 1) / perRow));
    osg::Image* image = _data->getImage();
    if (!image || image->t() < rows)
    {
        osg::ref_ptr<osg::Image> larger = new osg::Image;
        larger->setDataVariance(osg::Object::DYNAMIC); // never freed after the upload
        larger->allocateImage(lightsPerRow * texelsPerLight, rows, 1, GL_RGBA, GL_FLOAT);
        larger->setInternalTextureFormat(GL_RGBA32F_ARB);
        std::memset(larger->data(), 0, larger->getTotalSizeInBytes());
        _data->setImage(larger);
        image = larger.get();
    }
    std::memcpy(image->data(), data.data(), data.size() * sizeof(float));
    image->dirty();
}

void MapTargets::releaseGLObjects(osg::State* state) const
{
    _framebuffer.releaseGLObjects(state);
    _stateSet->releaseGLObjects(state);
}

} // namespace osgShadowVolume
