// SPDX-License-Identifier: MIT
#include <osgLabels/LabelObjects.h>

#include <osgLabels/LabelUnits.h>

#include <algorithm>

namespace osgLabels
{

void LabelObjects::set(std::uint32_t object, const ObjectRecord& record)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (object >= _records.size())
        _records.resize(object + 1);
    _records[object] = record.pack();
    _changed.push_back(object);
    _shapes |= 1u << (record.shape & ShapeMask);
}

const osg::StateSet* LabelObjects::update(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
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
    constexpr std::size_t bytes = sizeof(Words);
    const std::size_t first = _batches.getNumObjects();
    unsigned int batches = 0;
    _batches.forEach([&](const PrimitiveBatch& batch, std::uint32_t)
                     { batches += batch.getModifiedCount(); });
    const bool isKept = context.texture->resize(state, (first + _records.size()) * bytes);
    if (!isKept || context.batches != batches)
    {
        context.batches = batches;
        writeAll(state, *context.texture);
        context.changes = _changed.size();
    }
    std::vector<std::uint32_t> objects(_changed.begin() + std::ptrdiff_t(context.changes),
                                       _changed.end());
    context.changes = _changed.size();
    std::sort(objects.begin(), objects.end());
    for (std::size_t i = 0, end = 0; i < objects.size(); i = end)
    {
        for (end = i + 1; end < objects.size() && objects[end] <= objects[end - 1] + 1;)
            ++end;
        const std::size_t begin = objects[i], last = objects[end - 1];
        context.texture->write(state, (first + begin) * bytes, &_records[begin],
                               (last + 1 - begin) * bytes);
    }
    const bool allHave =
        std::all_of(_contexts.begin(), _contexts.end(),
                    [this](const auto& each) { return each.second.changes == _changed.size(); });
    if (allHave)
    {
        _changed.clear();
        for (auto& each : _contexts)
            each.second.changes = 0;
    }
    return context.stateSet.get();
}

void LabelObjects::writeAll(osg::State& state, BufferTexture& texture) const
{
    constexpr std::size_t bytes = sizeof(Words), most = 1u << 16;
    const Words none{};
    texture.write(state, 0, &none, bytes);
    std::vector<Words> part;
    _batches.forEach(
        [&](const PrimitiveBatch& batch, std::uint32_t first)
        {
            for (unsigned int i = 0; i < batch.getNumObjects(); ++i)
            {
                part.push_back(batch.getRecord(i).pack());
                if (part.size() < most && i + 1 < batch.getNumObjects())
                    continue;
                texture.write(state, (first + i + 1 - part.size()) * bytes, part.data(),
                              part.size() * bytes);
                part.clear();
            }
        });
    if (_records.size() > 1)
        texture.write(state, (_batches.getNumObjects() + 1) * bytes, &_records[1],
                      (_records.size() - 1) * bytes);
}

std::uint32_t LabelObjects::getIdentifier(std::uint32_t index) const
{
    std::uint32_t identifier = 0;
    _batches.forEach(
        [&](const PrimitiveBatch& batch, std::uint32_t first)
        {
            if (index >= first && index - first < batch.getNumObjects())
                identifier = batch.getIdentifier(index - first);
        });
    std::lock_guard<std::mutex> lock(_mutex);
    const std::size_t object = std::size_t(index) - _batches.getNumObjects();
    if (index > _batches.getNumObjects() && object < _records.size())
        identifier = _records[object].back();
    return identifier;
}

std::uint32_t LabelObjects::getShapes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _shapes | _batches.getShapes();
}

std::size_t LabelObjects::getBytes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return (_batches.getNumObjects() + _records.size()) * sizeof(Words);
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
