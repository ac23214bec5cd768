// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/ContextWords.h>
#include <osgLabels/LabelObjects.h>
#include <osgLabels/MapFeatures.h>

#include <memory>
#include <mutex>

namespace osgLabels
{

/// A word for each record of LabelObjects: number, 3 bits of action (7: no class), 2 of sides.
struct MapWords
{
    std::vector<std::uint32_t> words;
    /// A bit for each action that an object has; bit NumMapActions + 1 where one has no class.
    std::uint32_t actions = 0;
    unsigned int features = 0; ///< Modified count of their numbers.
    std::uint64_t batches = 0; ///< Time of theirs.
};

/// What stands before map labels of Drawables that hold many objects, batches and chunks: words
/// that occluder.frag reads. A frame keeps those that it was culled with. Thread safe.
class OSGLABELS_EXPORT MapRecords
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

    /// Of features as they are, in cull.
    std::shared_ptr<const MapWords> update(const osg::Group& group);
    /// Uploads what the context, which is current, does not have already.
    osg::ref_ptr<BufferTexture> upload(osg::State& state,
                                       const std::shared_ptr<const MapWords>& words);
    void releaseGLObjects(osg::State* state) { _uploaded.releaseGLObjects(state); }

private:
    std::shared_ptr<const MapWords> take(const osg::Group& group);

    const LabelBatches& _batches;
    const LabelObjects& _objects;
    MapFeatures& _features;
    std::mutex _mutex;
    std::vector<Chunked> _chunked;
    std::shared_ptr<const MapWords> _words; ///< Null: to be taken.
    MapFeatures::Held _held;
    ContextWords<std::shared_ptr<const MapWords>> _uploaded;
};

} // namespace osgLabels
