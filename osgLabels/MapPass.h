// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/MapCoverage.h>
#include <osgLabels/MapScene.h>

#include <osgMultiRender/SurfaceFrame.h>

#include <osg/Viewport>

#include <array>

namespace osgLabels
{

class LabelResources;

/// The map labels of one view of one frame: part of a LabelPass.
class MapPass
{
public:
    MapPass(LabelResources& resources, const LabelSettings& settings);
    ~MapPass();

    /// In cull: takes the leaves of the view.
    void cull(osgUtil::CullVisitor& visitor, osg::Group& group,
              const std::vector<const osgUtil::RenderLeaf*>& leaves);

    /// In draw. `viewport` is the view's, as GL says it.
    void begin(osg::RenderInfo& renderInfo, const osg::Camera* camera, const GLint (&viewport)[4],
               bool isPaged);
    /// Draws what may stand before labels into targets of its own.
    void drawOccluders(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame);
    /// Of a program with bits of MapBits.
    void apply(osg::State& state, const osgMultiRender::SurfaceVariant& variant,
               const osgUtil::RenderLeaf& leaf) const;
    /// Draws the labels.
    void draw(osg::RenderInfo& renderInfo);
    /// The label on top at a place from -1 to 1 of the view, as it was drawn; 0 for none.
    std::uint32_t pick(osg::State& state, double x, double y);
    void fillPlan(osgMultiRender::Plan& plan) const;

    /// What programs of occluders need.
    static osgMultiRender::SurfaceSnippet makeSnippet(const osgMultiRender::SurfaceKey& key);

private:
    /// How a leaf is drawn among occluders.
    struct Occluder
    {
        std::uint32_t number = 0;
        MapAction action = MapAction::Hide;
        MeshSides sides = MeshSides::Open;
        bool isMany = false; ///< Objects, each with a record.
        int recordBase = 0;
        int side = 0; ///< How it is drawn.
        bool isDrawn = false;
    };
    /// Labels that share a projection.
    struct Group
    {
        const osg::RefMatrix* projection;
        std::size_t begin, end;
    };

    /// Takes a leaf that holds many objects; false for others.
    bool addMany(const osgUtil::RenderLeaf& leaf);
    void place();
    void placeAll();
    void findDepths();
    void findProjections(osgMultiRender::SurfaceFrame& frame);
    bool isBefore(std::uint32_t a, std::uint32_t b) const;
    /// Whether the states of labels are found in this frame.
    bool needsStates() const;
    void findShown(osg::RenderInfo& renderInfo);
    void takeShown(const std::vector<std::uint8_t>* shown);
    void select(osgMultiRender::SurfaceFrame& frame);
    bool boxOf(const osgUtil::RenderLeaf& leaf, PixelBox& box, double& nearest) const;
    /// Bits of the actions of what a Drawable holds.
    std::uint32_t actionsOf(const Occluder& occluder) const;
    void drawLayers(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame);
    void drawLayer(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame, int layer,
                   int next);
    osg::ref_ptr<osg::StateSet> stateOf(int layer, int next, int side) const;
    bool rekey(const osgMultiRender::SurfaceItem& item, MapAction action, int next, int side,
               osgMultiRender::SurfaceKey& key);
    /// The layer that has what is behind a label's own feature, 1 for the first one.
    std::uint32_t nextOf(const FeatureTree::Range& own) const;
    void upload(osg::State& state);
    osg::ref_ptr<osg::StateSet> makePass(osg::State& state, bool isTest);
    void findStates(osg::RenderInfo& renderInfo);
    void takeLimits(const osgUtil::StateGraph* graph);
    MapAction actionAt(osg::State& state, const PlacedLabel& label, int x, int y);

    LabelResources& _resources;
    MapScene& _scene;
    const LabelSettings _settings;
    osg::ref_ptr<MapMemory> _memory;
    osg::Matrixd _groupToEye;
    osg::ref_ptr<const osg::Viewport> _ownViewport; ///< Null: that of the stage.
    /// What the StateSets from the view to the group say of where is drawn, the outermost first.
    std::vector<osg::ref_ptr<osg::StateSet>> _limits;
    double _time = 0.0;
    unsigned int _contextID = 0;
    int _language = 330;
    bool _isPaged = false;
    GLint _viewport[4] = {};
    PixelBox _view;
    bool _isByDepth = false; ///< See MapFrame.
    std::vector<EyeLabel> _labels;
    std::vector<Group> _groups;
    std::vector<PlacedLabel> _placed;  ///< In the order of cull, which changes little.
    std::vector<std::uint32_t> _order; ///< Those that are shown, as they are drawn.
    std::unordered_map<const osgUtil::RenderLeaf*, Occluder> _occluders;
    std::unique_ptr<MapCoverage> _coverage;
    std::vector<MapAction> _actions; ///< In use, the strongest first.
    std::array<bool, NumMapActions> _needsNext{};
    unsigned int _drawn = 0, _drawnNext = 0, _leftOut = 0;
    std::size_t _refused = 0;
    osg::ref_ptr<MapTargets> _targets;
    osg::ref_ptr<MapQuads> _quads;
    std::shared_ptr<const FeatureTree::Nesting> _nesting; ///< Likewise.
    std::vector<std::uint32_t> _depths;     ///< Of labels' features that others lie in.
    std::size_t _sharing = 0;               ///< Depths beyond those, without a layer of their own.
    osg::ref_ptr<BufferTexture> _nests;     ///< Null where there are none.
    std::shared_ptr<const MapWords> _words; ///< Of what has records, as it was in cull.
    osg::ref_ptr<BufferTexture> _records;
};

/// Bits of SurfaceKey::output that are the map's.
enum MapBits : std::uint32_t
{
    MapOccluder = 1u << 12,
    MapNext = 1u << 13,   ///< A layer behind the nearest.
    MapOpaque = 1u << 14, ///< What has less than half of the opacity is left out.
    MapMany = 1u << 15,   ///< Objects have records.
    MapNested = 1u << 16 ///< Behind all of the feature of a certain depth, not of the number alone.
};

} // namespace osgLabels
