// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/ChunkMesh.h>

#include <osg/Group>
#include <osg/StateSet>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace osgLabels
{

/// What a Chunker made of a subgraph.
struct Chunks
{
    /// Draws what the group's children draw. Shares with them what was not gathered.
    osg::ref_ptr<osg::Group> node;

    /// An object whose vertices are in a chunk now.
    struct Object
    {
        std::uint32_t object = 0; ///< At its vertices.
        osg::ref_ptr<const osg::Geometry> geometry;
        osg::Matrixd localToChunk; ///< The object's record is to be in the chunk's coordinates.
    };
    std::vector<Object> objects; ///< Those with a number other than 0.

    std::size_t drawables = 0; ///< Of the subgraph, each as often as it is drawn.
    std::size_t gathered = 0;  ///< Those of them that are in chunks.
    std::size_t chunks = 0;
    std::size_t vertices = 0;                   ///< Of all chunks.
    std::map<std::string, std::size_t> leftOut; ///< Why others were not gathered.
};

/// Gathers a subgraph's many small static Drawables into few large ones that lie together in space.
///
/// Gathered are Geometries of up to `small` vertices that a MeshLayout can describe, on paths of
/// plain Group, Geode, MatrixTransform and PositionAttitudeTransform nodes. Not gathered, with all
/// that is below: other kinds of nodes (LOD, Switch, Camera …), node masks, callbacks, data
/// variance DYNAMIC, and state on which the order of drawing depends or that belongs to a vertex's
/// local coordinates: blending, render bins, Programs, depth functions, stencil, TexGen from object
/// coordinates, rescaled normals. Whatever else the state is, Drawables are gathered if it is equal
/// by content along their whole paths.
///
/// The model stays as it is, but that nodes which are not gathered get a second parent. What is
/// changed in the gathered part later is not seen.
class OSGLABELS_EXPORT Chunker
{
public:
    /// The number of the object that a path from the group ends at; 0 for none.
    using ObjectOf = std::function<std::uint32_t(const osg::NodePath&)>;

    explicit Chunker(ObjectOf objectOf);

    /// Vertices of a chunk, about.
    void setChunkVertices(std::size_t vertices) { _chunkVertices = vertices; }
    /// Vertices up to which a Drawable is small.
    void setSmall(std::size_t vertices) { _small = vertices; }

    Chunks chunk(osg::Group& group);

private:
    /// StateSets from the group down, equal ones by one of them.
    using StateChain = std::vector<osg::StateSet*>;
    struct Key
    {
        StateChain state;
        MeshLayout layout;
        bool operator<(const Key& other) const;
    };
    struct Item
    {
        const osg::Geometry* geometry = nullptr;
        osg::Matrixd matrix; ///< To the group.
        osg::Vec3d center;
        std::uint32_t object = 0;
    };
    using Items = std::vector<Item>;
    struct Bucket
    {
        Key key;
        Items items;
    };

    osg::ref_ptr<osg::Node> copy(osg::Node& node);
    osg::ref_ptr<osg::Node> copyGroup(osg::Group& group);
    bool gather(osg::Drawable& drawable);
    bool enter(osg::Node& node);
    void leave(osg::Node& node);
    osg::StateSet* canonical(osg::StateSet& stateSet);
    osg::StateSet* canonicalOfColored(osg::StateSet& stateSet);
    bool leaveOut(const std::string& why);
    Items& bucketOf(const Key& key);
    using Order = std::vector<std::uint32_t>; ///< Indices of items.
    void split(Order::iterator begin, Order::iterator end, const Bucket& bucket,
               osg::Group& parent);
    void build(Order::iterator begin, Order::iterator end, const Bucket& bucket,
               osg::Group& parent);

    struct ByContent
    {
        bool operator()(const osg::StateSet* a, const osg::StateSet* b) const
        {
            return a->compare(*b, true) < 0;
        }
    };

    const ObjectOf _objectOf;
    std::size_t _chunkVertices = 65536, _small = 4096;
    Chunks _result;
    osg::NodePath _path;
    std::vector<osg::Matrixd> _matrices;
    StateChain _state;
    std::map<const osg::StateSet*, osg::StateSet*, ByContent> _canonical;
    std::vector<osg::ref_ptr<osg::StateSet>> _made; ///< Of _canonical, not the model's.
    std::map<Key, std::size_t> _byKey;
    std::vector<Bucket> _buckets; ///< By first appearance, so that the order of drawing is kept.
};

} // namespace osgLabels
