// SPDX-License-Identifier: MIT
#include <osgLabels/LabelObjects.h>

#include <osgLabels/LabelUnits.h>

#include <algorithm>

namespace osgLabels
{

void LabelObjects::set(std::uint32_t object, const ObjectRecord& record)
{
    std::lock_guard<std::mutex> lock(_mutex);
    while (object >= _records.size())
    {
        _indices.add(std::uint32_t(_records.size()), _space.takeNext());
        _records.emplace_back();
    }
    _records[object] = record.pack();
    _changed.push_back(object);
    _shapes |= 1u << (record.shape & ShapeMask);
}

std::uint32_t LabelObjects::indexOf(std::uint32_t object) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _indices.rightOf(object).value_or(0);
}

LabelObjects::Context& LabelObjects::contextOf(osg::State& state)
{
    Context& context = _contexts[state.getContextID()];
    if (!context.stateSet)
    {
        context.stateSet = new osg::StateSet;
        context.texture =
            new BufferTexture(state.getContextID(), 4, BufferTexture::needsPages(state));
        context.stateSet->setTextureAttribute(ObjectsUnit, context.texture,
                                              osg::StateAttribute::OVERRIDE);
        context.stateSet->addUniform(new osg::Uniform("osgLabels_objects", int(ObjectsUnit)));
    }
    return context;
}

osg::ref_ptr<const osg::StateSet> LabelObjects::update(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    Context& context = contextOf(state);
    constexpr std::size_t bytes = sizeof(Words);
    const std::uint64_t time = _batches.getTime(); // there is room for those that there are now
    if (!context.texture->resize(state, _space.getEnd() * bytes))
    {
        const Words none{};
        context.texture->write(state, 0, &none, bytes);
        context.batches = 0;
        write(state, *context.texture, 1, _records.size());
        context.changes = _changed.size();
    }
    _batches.forEachRecord(context.batches, time,
                           [&](std::uint32_t first, const std::uint32_t* words, std::uint32_t count)
                           { context.texture->write(state, first * bytes, words, count * bytes); });
    context.batches = time;
    writeChanged(state, context);
    dropTaken();
    return context.stateSet;
}

void LabelObjects::writeChanged(osg::State& state, Context& context) const
{
    std::vector<std::uint32_t> objects(_changed.begin() + std::ptrdiff_t(context.changes),
                                       _changed.end());
    context.changes = _changed.size();
    std::sort(objects.begin(), objects.end());
    for (std::size_t i = 0, end = 0; i < objects.size(); i = end)
    {
        for (end = i + 1; end < objects.size() && objects[end] <= objects[end - 1] + 1;)
            ++end;
        write(state, *context.texture, objects[i], std::size_t(objects[end - 1]) + 1);
    }
}

/// Objects from `object` to before `end`, wherever their records lie.
void LabelObjects::write(osg::State& state, BufferTexture& texture, std::size_t object,
                         std::size_t end) const
{
    while (object < end)
    {
        const auto number = std::uint32_t(object);
        const std::size_t count = std::min<std::size_t>(_indices.countFrom(number), end - object);
        texture.write(state, *_indices.rightOf(number) * sizeof(Words), &_records[object],
                      count * sizeof(Words));
        object += count;
    }
}

/// Forgets changes that all contexts have.
void LabelObjects::dropTaken()
{
    if (!std::all_of(_contexts.begin(), _contexts.end(),
                     [this](const auto& each) { return each.second.changes == _changed.size(); }))
        return;
    _changed.clear();
    for (auto& each : _contexts)
        each.second.changes = 0;
}

std::uint32_t LabelObjects::getIdentifier(std::uint32_t index) const
{
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (const auto object = _indices.leftOf(index))
            return _records[*object][ObjectRecord::IdentifierWord];
    }
    return _batches.getIdentifier(index);
}

std::uint32_t LabelObjects::getShapes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _shapes | _batches.getShapes();
}

std::size_t LabelObjects::getBytes() const
{
    return _space.getEnd() * sizeof(Words);
}

void LabelObjects::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto context = _contexts.begin(); context != _contexts.end();)
        if (!state || state->getContextID() == context->first)
        {
            context->second.stateSet->releaseGLObjects(state);
            context = _contexts.erase(context);
        }
        else
            ++context;
}

} // namespace osgLabels
