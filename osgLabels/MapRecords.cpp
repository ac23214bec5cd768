// SPDX-License-Identifier: MIT
#include <osgLabels/MapRecords.h>

#include <algorithm>

namespace osgLabels
{

namespace
{

constexpr std::uint32_t noClass = 7;

} // namespace

void MapRecords::setChunked(std::vector<Chunked> chunked)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _chunked = std::move(chunked);
    _taken.reset();
}

void MapRecords::set(std::size_t record, const MapFeatures::Occluder& occluder)
{
    const std::uint32_t action = occluder.action ? std::uint32_t(*occluder.action) : noClass;
    const std::uint32_t number = std::max(occluder.number, FeatureTree::Foreign);
    if (record >= _words.size())
        _words.resize(record + 1);
    _words[record] = number << 5 | action << 2 | std::uint32_t(occluder.sides);
    _actions |= 1u << (occluder.action ? action : NumMapActions + 1);
}

void MapRecords::update(const osg::Group& group)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const std::uint64_t time = _batches.getTime();
    if (_taken == std::pair(_features.getModifiedCount(), time))
        return;
    // Names that are new while these are taken change the numbers of others.
    constexpr int tries = 3;
    for (int i = 0; i < tries; ++i)
    {
        _taken = {_features.getModifiedCount(), time};
        take(group);
        if (_features.getModifiedCount() == _taken->first)
            break;
    }
    ++_version;
}

void MapRecords::take(const osg::Group& group)
{
    _words.clear();
    _actions = 0;
    set(0, {}); // of what has no record
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
                        _features.findPart(below, object, batch.getObjectName(object));
                    if (run->getShape() == Shape::Quad)
                        occluder.sides = MeshSides::Open;
                    set(first + object, occluder);
                }
        });
    for (const Chunked& each : _chunked)
        if (each.object)
            set(_objects.indexOf(each.object), _features.find(group, each.path));
}

osg::ref_ptr<BufferTexture> MapRecords::upload(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    Context& context = _contexts[state.getContextID()];
    if (!context.texture)
        context.texture =
            new BufferTexture(state.getContextID(), 1, BufferTexture::needsPages(state));
    const std::size_t bytes = _words.size() * sizeof(_words.front());
    if (context.version != _version && bytes)
    {
        context.texture->resize(state, bytes);
        context.texture->write(state, 0, _words.data(), bytes);
        context.version = _version;
    }
    return context.texture;
}

std::uint32_t MapRecords::getActions() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _actions;
}

void MapRecords::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto context = _contexts.begin(); context != _contexts.end();)
        if (!state || state->getContextID() == context->first)
            context = _contexts.erase(context);
        else
            ++context;
}

} // namespace osgLabels
