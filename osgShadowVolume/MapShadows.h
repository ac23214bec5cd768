// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightShadows.h>
#include <osgShadowVolume/MapTargets.h>
#include <osgShadowVolume/ShadowMapFit.h>
#include <osgShadowVolume/ShadowResources.h>

namespace osgShadowVolume
{

/// Shadows by depth maps: fast, and as coarse as their texels.
///
/// All maps of a view are layers of one texture. A directional light has one that is fitted to what
/// is in view, a narrow spot one, other lights six. Surfaces look themselves up where they are lit,
/// transparent ones as well.
///
/// Against shadows of a surface on itself casters are drawn with a polygon offset of their slope
/// times the filtered texels on a side, which is as far as a plane falls over them, and the surface
/// is taken half a texel towards the light. So shadows start that far behind their casters.
/// Williams: Casting Curved Shadows on Curved Surfaces, 1978; Reeves, Salesin, Cook: Rendering
/// Antialiased Shadows with Depth Maps, 1987.
class MapShadows : public LightShadows
{
public:
    MapShadows(const ShadowSettings& settings, ShadowResources& resources);
    ~MapShadows() override;

    void begin(osg::RenderInfo& renderInfo) override;
    bool receivesOnTransparent() const override { return true; }
    void draw(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
              const std::vector<bool>& used,
              const std::function<bool(const osgMultiRender::SurfaceItem&)>& isReceiver) override;
    std::string makeSource(bool transparent) const override;
    std::vector<std::pair<std::string, int>> getSamplers() const override;
    const osg::StateSet* getStateSet() const override;
    void apply(const osg::Program::PerContextProgram&, const osg::GLExtensions&) const override {}
    std::uint32_t getVariantBits() const override { return 7; } // volumes have those below
    void drawn(osg::RenderInfo& renderInfo) override;
    std::string describe(std::size_t light) const override;
    void fillPlan(osgMultiRender::Plan& plan) const override;

private:
    /// The map of one light, where it has one.
    struct Placed
    {
        std::size_t light = 0;
        unsigned int layer = 0; ///< The first.
        ShadowMap map;
    };

    std::vector<Placed> fit(const osgMultiRender::SurfaceFrame& frame,
                            const std::vector<std::size_t>& lights);
    CasterMesh& getMesh(std::uint32_t caster);
    void drawMap(osg::RenderInfo& renderInfo, const Placed& placed);
    std::vector<float> makeData(const std::vector<Placed>& maps) const;

    ShadowResources& _resources;
    const unsigned int _samples;
    GLint _largest = 0, _maxLayers = 0;            ///< Of the driver.
    std::vector<Hexahedron> _boxes;                ///< Of the casters, in eye coordinates.
    std::vector<osg::ref_ptr<CasterMesh>> _meshes; ///< Likewise; made when needed.
    MapBudget _budget;
    osg::ref_ptr<MapTargets> _targets;
    std::size_t _bytes = 0;
    unsigned int _contextID = 0;
    unsigned int _drawCalls = 0;
    std::vector<std::string> _descriptions;
};

} // namespace osgShadowVolume
