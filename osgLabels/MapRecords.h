// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>
#include <osgLabels/LabelObjects.h>
#include <osgLabels/MapFeatures.h>

#include <map>

namespace osgLabels
{

/// What stands before map labels of Drawables that hold many objects, batches and chunks: a word
/// for each record of LabelObjects, that occluder.frag reads. Thread safe.
class MapRecords
{
public:
    MapRecords(const LabelBatches& batches, const LabelObjects& objects, MapFeatures& features)
        : _batches(batches), _objects(objects), _features(features)
    {
    }

    /// An object of LabelCollector that is in a chunk, and its path from the group.
    struct Chunked
    {
        std::uint32_t object = 0;
        osg::NodePath path;
    };
    void setChunked(std::vector<Chunked> chunked);

    /// Takes features as they are, in cull.
    void update(const osg::Group& group);
    /// Uploads what is new for the context, which is current.
    osg::ref_ptr<BufferTexture> upload(osg::State& state);
    /// A bit for each action that an object has; bit NumMapActions + 1 where one has no class.
    std::uint32_t getActions() const;
    void releaseGLObjects(osg::State* state);

private:
    void take(const osg::Group& group);
    void set(std::size_t record, const MapFeatures::Occluder& occluder);

    const LabelBatches& _batches;
    const LabelObjects& _objects;
    MapFeatures& _features;
    mutable std::mutex _mutex;
    std::vector<Chunked> _chunked;
    std::vector<std::uint32_t> _words; ///< Number, 3 bits of action (7: no class), 2 of sides.
    std::uint32_t _actions = 0;
    /// Modified count of the features, time of the batches.
    std::optional<std::pair<unsigned int, std::uint64_t>> _taken;
    unsigned int _version = 0;
    struct Context
    {
        osg::ref_ptr<BufferTexture> texture;
        unsigned int version = 0;
    };
    std::map<unsigned int, Context> _contexts;
};

} // namespace osgLabels
