// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelBuffers.h>
#include <osgLabels/MapFeatures.h>
#include <osgLabels/MapMemory.h>
#include <osgLabels/MapNests.h>
#include <osgLabels/MapPlacement.h>
#include <osgLabels/MapPrograms.h>
#include <osgLabels/MapQuads.h>
#include <osgLabels/MapRecords.h>
#include <osgLabels/MapTargets.h>
#include <osgLabels/MapTexts.h>

#include <osgMultiRender/TargetPool.h>

#include <osg/Camera>
#include <osgUtil/CullVisitor>

#include <atomic>

namespace osgLabels
{

/// What the map labels of a LabelScene keep from frame to frame for all its views. Thread safe.
class MapScene
{
public:
    /// Looks for labels below `group`, while nobody changes its subgraph.
    MapScene(const LabelSettings& settings, std::shared_ptr<GlyphSet> glyphs,
             MapTexts::StyleOf styleOf, const LabelBatches& batches, const LabelObjects& objects,
             const FramesInFlight& frames, osg::Group& group);

    /// Identifiers of map labels count from here, those of surface labels lie below.
    static constexpr std::uint32_t FirstIdentifier = 0x80000000u;

    /// One view in cull: its labels in eye coordinates.
    void prepare(const MapLabels& node, const osg::Matrixd& localToEye,
                 std::vector<EyeLabel>& labels);
    /// Those by user values that the visitor, which is at the group, sees.
    void prepareValued(osgUtil::CullVisitor& visitor, std::vector<EyeLabel>& labels);
    /// Numbers of the labels' own features, as they are now.
    void takeRanges(std::vector<EyeLabel>& labels);
    /// Finds what stands before labels, from the first label in view on; returns that of records.
    std::shared_ptr<const MapWords> activate(osg::Group& group);

    /// The labels of the file that the settings name; null without one.
    osg::Node* getFileLabels() const { return _fileLabels.get(); }
    /// In a cull traversal of the group: labels that no node stands for are in view, even where no
    /// drawable is.
    void cull(osg::NodeVisitor& visitor);
    /// What the view of a camera remembers. A camera may have several pictures a frame, such as
    /// those of two eyes, or of a scene in two places: each call of a frame is the next one's.
    osg::ref_ptr<MapMemory> getMemory(const osg::Camera* camera, unsigned int frame);
    void releaseGLObjects(osg::State* state);

    MapFeatures features;
    MapTexts texts;
    MapRecords records;
    MapNests nests;
    LabelBuffers buffers;
    osgMultiRender::TargetPool<MapTargets> targets;
    osgMultiRender::TargetPool<MapQuads> quads;
    MapPrograms programs;

private:
    struct Valued
    {
        osg::ObserverNodePath path;
        PreparedLabel label;
        bool isGone = false;
    };
    void addValued(MapFeatures::Valued valued);
    void readFile(const std::string& file);

    std::mutex _cullMutex; ///< Of what follows; locked before that of features.
    std::vector<Valued> _valued;
    bool _isActive = false;
    osg::ref_ptr<MapLabels> _fileLabels;
    const osg::ref_ptr<MapLabels> _values = new MapLabels; ///< Stands for those by user values.
    std::mutex _mutex;                                     ///< Of what follows.
    std::vector<MapFeatures::Valued> _found;               ///< Not yet in _valued.
    std::atomic<bool> _hasValues{false};
    struct Memories
    {
        osg::observer_ptr<const osg::Camera> camera;
        unsigned int frame = 0;
        std::size_t used = 0;                          ///< In that frame.
        std::vector<osg::ref_ptr<MapMemory>> memories; ///< Of the pictures of a frame.
    };
    std::map<const osg::Camera*, Memories> _memories;
};

} // namespace osgLabels
