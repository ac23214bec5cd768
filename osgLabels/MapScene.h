// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelBuffers.h>
#include <osgLabels/MapFeatures.h>
#include <osgLabels/MapPlacement.h>
#include <osgLabels/MapPrograms.h>
#include <osgLabels/MapQuads.h>
#include <osgLabels/MapTargets.h>
#include <osgLabels/MapTexts.h>

#include <osgMultiRender/TargetPool.h>

namespace osgLabels
{

/// What the map labels of a LabelScene keep from frame to frame for all its views. Thread safe.
class MapScene
{
public:
    /// Looks for labels below `group`, while nobody changes its subgraph.
    MapScene(const LabelSettings& settings, std::shared_ptr<GlyphSet> glyphs, osg::Group& group);

    /// Identifiers of map labels count from here, those of surface labels lie below.
    static constexpr std::uint32_t FirstIdentifier = 0x40000000u;

    /// One view in cull: its labels in eye coordinates. False where the scene has none in view.
    bool prepare(const MapLabels& node, const osg::Matrixd& localToEye,
                 std::vector<EyeLabel>& labels);
    void prepareValued(const osg::Matrixd& groupToEye, std::vector<EyeLabel>& labels);
    /// Finds what stands before labels; from the first label in view on.
    void activate(osg::Group& group);

    const LabelSettings settings;
    MapFeatures features;
    MapTexts texts;
    LabelBuffers buffers;
    osgMultiRender::TargetPool<MapTargets> targets;
    osgMultiRender::TargetPool<MapQuads> quads;
    MapPrograms programs;

private:
    struct Valued
    {
        osg::ObserverNodePath path;
        PreparedLabel label;
    };
    void addValued(MapFeatures::Valued valued);

    std::mutex _mutex;
    std::vector<MapFeatures::Valued> _found; ///< Not yet in _valued.
    std::vector<Valued> _valued;
    bool _isActive = false;
};

} // namespace osgLabels
