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
        // Without OVERRIDE: a PrimitiveBatch brings its own.
        context.stateSet->setTextureAttribute(RecordsUnit, context.texture);
        context.stateSet->addUniform(new osg::Uniform("osgLabels_records", int(RecordsUnit)));
    }
    constexpr std::size_t bytes = sizeof(Words);
    if (!context.texture->resize(state, _records.size() * bytes))
    {
        context.texture->write(state, 0, _records.data(), _records.size() * bytes);
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
        const std::size_t first = objects[i], last = objects[end - 1];
        context.texture->write(state, first * bytes, &_records[first], (last + 1 - first) * bytes);
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

std::size_t LabelObjects::getBytes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _records.size() * sizeof(Words);
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
