// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelBuffers.h>
#include <osgLabels/MapFeatures.h>
#include <osgLabels/MapMemory.h>
#include <osgLabels/MapPlacement.h>
#include <osgLabels/MapPrograms.h>
#include <osgLabels/MapQuads.h>
#include <osgLabels/MapRecords.h>
#include <osgLabels/MapTargets.h>
#include <osgLabels/MapTexts.h>

#include <osgMultiRender/TargetPool.h>

#include <osg/Camera>

namespace osgLabels
{

/// What the map labels of a LabelScene keep from frame to frame for all its views. Thread safe.
class MapScene
{
public:
    /// Looks for labels below `group`, while nobody changes its subgraph.
    MapScene(const LabelSettings& settings, std::shared_ptr<GlyphSet> glyphs,
             MapTexts::StyleOf styleOf, const LabelBatches& batches, const LabelObjects& objects,
             osg::Group& group);

    /// Identifiers of map labels count from here, those of surface labels lie below.
    static constexpr std::uint32_t FirstIdentifier = 0x80000000u;

    /// One view in cull: its labels in eye coordinates.
    void prepare(const MapLabels& node, const osg::Matrixd& localToEye,
                 std::vector<EyeLabel>& labels);
    /// `mask`: of the traversal.
    void prepareValued(const osg::Matrixd& groupToEye, osg::Node::NodeMask mask,
                       std::vector<EyeLabel>& labels);
    /// Finds what stands before labels; from the first label in view on.
    void activate(osg::Group& group);

    /// The labels of the file that the settings name; null without one.
    osg::Node* getFileLabels() const { return _fileLabels.get(); }
    /// What the view of a camera remembers.
    osg::ref_ptr<MapMemory> getMemory(const osg::Camera* camera);
    void releaseGLObjects(osg::State* state);

    MapFeatures features;
    MapTexts texts;
    MapRecords records;
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
    void readFile(const std::string& file);

    std::mutex _cullMutex; ///< Of what follows; locked before that of features.
    std::vector<Valued> _valued;
    bool _isActive = false;
    osg::ref_ptr<MapLabels> _fileLabels;
    std::mutex _mutex;                       ///< Of what follows.
    std::vector<MapFeatures::Valued> _found; ///< Not yet in _valued.
    struct Memory
    {
        osg::observer_ptr<const osg::Camera> camera;
        osg::ref_ptr<MapMemory> memory;
    };
    std::map<const osg::Camera*, Memory> _memories;
};

} // namespace osgLabels
