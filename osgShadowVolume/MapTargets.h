// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/StateSet>
#include <osg/Texture2D>

#include <optional>
#include <string>
#include <vector>

namespace osgShadowVolume
{

using osgMultiRender::Framebuffer;
using osgMultiRender::FramebufferVisit;
using osgMultiRender::TargetTexture;

/// What the depth maps of one view look like.
struct MapLayout
{
    unsigned int size = 0; ///< Texels on a side.
    unsigned int layers = 0;

    bool operator==(const MapLayout& other) const
    {
        return size == other.size && layers == other.layers;
    }
};

/// The depth maps of the lights of one view in one graphics context, and the table that says where
/// surfaces find themselves in them; shaders/map.frag reads both.
class MapTargets : public osg::Referenced
{
public:
    using Layout = MapLayout;

    static constexpr int MapsUnit = 13; ///< Texture unit of osgsv_maps.
    static constexpr int DataUnit = 12; ///< Texture unit of osgsv_mapData.
    static constexpr unsigned int FloatsPerLight = 20;

    MapTargets(unsigned int contextID, const MapLayout& layout);

    const MapLayout& getLayout() const { return _layout; }
    std::size_t getBytes() const { return _maps->getBytes(); }

    /// As ShadowTargets::whyIncomplete().
    const std::string& whyIncomplete(osg::State& state);

    /// Binds the framebuffer for a layer.
    void bind(osg::State& state, unsigned int layer);
    /// Takes the table of lights, FloatsPerLight each.
    void setData(const std::vector<float>& data);
    /// Sets the viewport of the maps.
    const osg::StateSet* getDrawState() const { return _drawState.get(); }
    /// Binds the textures, over the model's own.
    const osg::StateSet* getStateSet() const { return _stateSet.get(); }

    void releaseGLObjects(osg::State* state) const;

protected:
    ~MapTargets() override;

private:
    const MapLayout _layout;
    std::optional<std::string> _whyIncomplete;
    Framebuffer _framebuffer;
    osg::ref_ptr<TargetTexture> _maps;
    osg::ref_ptr<osg::Texture2D> _data;
    osg::ref_ptr<osg::StateSet> _drawState;
    osg::ref_ptr<osg::StateSet> _stateSet;
};

} // namespace osgShadowVolume
