// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/MirrorCamera.h>
#include <osgShadowVolume/MirrorCollector.h>
#include <osgShadowVolume/MirrorShape.h>
#include <osgShadowVolume/ShadowSettings.h>
#include <osgShadowVolume/TriangleReader.h>

#include <osgMultiRender/Plan.h>

#include <osg/GLExtensions>
#include <osg/Program>
#include <osgUtil/RenderBin>

#include <unordered_map>

namespace osgShadowVolume
{

/// Shapes of mirrors from frame to frame, for as long as their vertices and indices stay what they
/// are. Thread safe.
class OSGSHADOWVOLUME_EXPORT MirrorShapes
{
public:
    /// In local coordinates. What is no mirror is said once, as a warning, and in `error`.
    std::optional<MirrorShape> get(const NamedMirror& mirror, std::string& error);
    /// Forgets shapes that were not asked for in 60 frames, and those of dead Drawables. Frames of
    /// different viewers add up.
    void evict(unsigned int frameNumber);
    std::size_t getSize() const;

private:
    static constexpr unsigned int FramesUnused = 60;

    struct Known
    {
        osg::observer_ptr<const osg::Drawable> drawable;
        std::vector<TriangleContent> contents;
        std::optional<MirrorShape> shape;
        std::string error;
        std::size_t lastUse = 0; ///< In frames counted here.
    };
    mutable std::mutex _mutex;
    std::size_t _frames = 0;
    unsigned int _frameNumber = 0;
    std::unordered_map<const osg::Drawable*, Known> _known;
};

/// What a ShadowedScene keeps for mirrors from frame to frame.
struct MirrorResources
{
    MirrorPool pool;
    MirrorShapes shapes;
};

/// The mirrors of one view of one frame: one picture for all that lie in one plane.
///
/// In the cull thread the subgraph is culled once more for each picture; the stages that are made
/// so draw before the view. One bounce: inside of a picture nothing is a mirror.
class Mirrors
{
public:
    static constexpr int ReflectionUnit = 9; ///< Texture unit of osgsv_reflection.

    Mirrors(const ShadowSettings& settings, MirrorResources& resources);
    ~Mirrors();

    /// In the cull thread, when the subgraph has been traversed.
    void cull(osgUtil::CullVisitor& visitor, osg::Group& group);

    // The rest is for the draw thread.

    /// Whether any leaf reflects.
    bool isAny() const { return !_reflecting.empty(); }
    /// What a leaf reflects, as an index for apply(); -1 for one that does not. `blended`: what is
    /// behind the leaf shows through it.
    int reflect(const osgUtil::RenderLeaf& leaf, bool blended);
    static std::string makeSource();
    void apply(osg::State& state, const osg::Program::PerContextProgram& program, int index) const;
    /// The last leaf has been drawn.
    void drawn();
    void fillPlan(osgMultiRender::Plan& plan) const;

private:
    struct Found;
    struct View;
    struct Plane
    {
        glm::dvec4 equation{0.0};
        double tolerance = 0.0;
        double share = 0.0;               ///< Of the view, of all mirrors in it.
        std::vector<std::size_t> members; ///< Of what was found.
        osg::ref_ptr<MirrorCamera> camera;
    };
    struct Reflecting
    {
        osg::ref_ptr<osg::Texture2D> texture;
        double reflectivity = 0.0;
        bool blended = false;
    };

    /// Leaves out of the picture of a mirror the mirror itself and what is behind it.
    void trim(osgUtil::CullVisitor& visitor, osg::Group& group, const MirrorCamera& camera);
    /// Those that show on the picture; the others are dropped.
    std::vector<Found> find(osgUtil::CullVisitor& visitor, std::vector<NamedMirror>& named);
    /// Fills in what is seen of a mirror but its name; empty, or why nothing is.
    std::string whyUnseen(const NamedMirror& mirror, const View& view, Found& found);
    std::vector<Plane> join(const std::vector<Found>& found) const;
    void draw(osgUtil::CullVisitor& visitor, osg::Group& group, Plane& plane,
              const std::vector<Found>& found);
    void drop(const std::string& name, const std::string& reason);

    const ShadowSettings _settings;
    MirrorResources& _resources;
    unsigned int _contextID = 0;
    unsigned int _frameNumber = 0;
    osg::Vec2d _offset; ///< Of gl_FragCoord from texels; x runs the other way.
    std::vector<osg::ref_ptr<MirrorCamera>> _cameras;
    std::vector<Reflecting> _reflecting;
    std::unordered_map<const osgUtil::RenderLeaf*, int> _indices;
    std::vector<osgMultiRender::PlanEntry> _entries;
};

} // namespace osgShadowVolume
