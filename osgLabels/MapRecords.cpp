// SPDX-License-Identifier: MIT
#include <osgLabels/MapRecords.h>

#include <algorithm>

namespace osgLabels
{

namespace
{

constexpr std::uint32_t noClass = 7;

void set(MapWords& into, std::size_t record, const MapFeatures::Occluder& occluder)
{
    const std::uint32_t action = occluder.action ? std::uint32_t(*occluder.action) : noClass;
    const std::uint32_t number = std::max(occluder.number, FeatureTree::Foreign);
    if (record >= into.words.size())
        into.words.resize(record + 1);
    into.words[record] = number << 5 | action << 2 | std::uint32_t(occluder.sides);
    into.actions |= 1u << (occluder.action ? action : NumMapActions + 1);
}

} // namespace

void MapRecords::setChunked(std::vector<Chunked> chunked)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _chunked = std::move(chunked);
    _words.reset();
}

std::shared_ptr<const MapWords> MapRecords::update(const osg::Group& group)
{
    std::lock_guard<std::mutex> lock(_mutex);
    // Names that are new while these are taken change the numbers of others.
    constexpr int tries = 3;
    for (int i = 0; i < tries; ++i)
    {
        if (_words && _words->features == _features.getModifiedCount() &&
            _words->batches == _batches.getTime())
            break;
        _words = take(group);
    }
    return _words;
}

std::shared_ptr<const MapWords> MapRecords::take(const osg::Group& group)
{
    auto taken = std::make_shared<MapWords>();
    taken->features = _features.getModifiedCount();
    taken->batches = _batches.getTime();
    set(*taken, 0, {}); // of what has no record
    MapFeatures::Held held;
    _batches.forEach(
        [&](const PrimitiveBatch& batch, std::uint32_t first)
        {
            const osg::NodePathList paths =
                batch.getParentalNodePaths(const_cast<osg::Group*>(&group));
            if (paths.empty())
                return;
            const osg::NodePath below(paths.front().begin() + 1, paths.front().end());
            for (const osg::ref_ptr<PrimitiveRun>& run : batch.getRuns())
                for (unsigned int i = 0; i < run->getNumObjects(); ++i)
                {
                    const unsigned int object = run->getFirstObject() + i;
                    MapFeatures::Occluder occluder =
                        _features.findPart(below, object, batch.getObjectName(object), held);
                    if (run->getShape() == Shape::Quad)
                        occluder.sides = MeshSides::Open;
                    set(*taken, first + object, occluder);
                }
        });
    _features.release(_held);
    _held.swap(held);
    for (const Chunked& each : _chunked)
        if (each.object)
            set(*taken, _objects.indexOf(each.object), _features.find(group, each.path));
    return taken;
}

osg::ref_ptr<BufferTexture> MapRecords::upload(osg::State& state,
                                               const std::shared_ptr<const MapWords>& words)
{
    return _uploaded.upload(
        state, words, [&]() -> const auto& { return words->words; });
}

} // namespace osgLabels
