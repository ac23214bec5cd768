// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterMesh.h>
#include <osgShadowVolume/LightReach.h>
#include <osgShadowVolume/ShadowResources.h>
#include <osgShadowVolume/ShadowSettings.h>
#include <osgShadowVolume/Silhouette.h>

#include <osg/RenderInfo>

#include <vector>

namespace osgShadowVolume
{

/// Draws the volumes that one light makes of casters, into the counter that is bound.
class CasterDraw
{
public:
    /// What the draws of a view have in common.
    struct View
    {
        osg::RenderInfo& renderInfo;
        ShadowResources& resources;
        Technique technique; ///< Not AUTO.
        ShadowPasses::Tier tier;
        osg::ref_ptr<osg::RefMatrix> projection;
        unsigned int frameNumber;
    };

    CasterDraw(const View& view, const EyeLight& light) : _view(view), _light(light) {}

    /// A caster for the next run().
    void add(const osg::ref_ptr<CasterMesh>& mesh,
             const osg::ref_ptr<const osg::RefMatrix>& modelview);
    /// Draws what was added since the last one, with caps for z-fail.
    void run(ShadowPasses::Count count);
    /// Of volumes that are shown.
    void setColor(const osg::Vec4& color) { _color = color; }
    unsigned int getDrawCalls() const { return _drawCalls; }

private:
    struct Placed
    {
        osg::ref_ptr<CasterMesh> mesh;
        osg::ref_ptr<const osg::RefMatrix> modelview;
        MeshLight light;
        float handedness; ///< Sign of the modelview's determinant.
    };

    float endOf(const Placed& placed) const;
    void drawPass(ShadowPasses::Pass pass, ShadowPasses::Count count);
    void place(const Placed& placed);
    void drawParts(ShadowPasses::Pass pass, const Placed& placed);
    void drawGeometry(const osg::Geometry& geometry);

    const View& _view;
    const EyeLight& _light;
    std::vector<Placed> _placed;
    osg::Vec4 _color;
    unsigned int _drawCalls = 0;
};

} // namespace osgShadowVolume
