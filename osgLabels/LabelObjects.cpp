// SPDX-License-Identifier: MIT
#include <osgLabels/LabelObjects.h>

#include <osgLabels/LabelUnits.h>

#include <osgUtil/RenderLeaf>

namespace osgLabels
{

std::uint32_t LabelObjects::add(const osg::Drawable& drawable, const ObjectRecord& record)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto index = std::uint32_t(_records.size());
    _indices[&drawable] = index;
    _records.push_back(record.pack());
    return index;
}

std::uint32_t LabelObjects::indexOf(const osgUtil::RenderLeaf& leaf) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _indices.find(leaf._drawable.get());
    return found == _indices.end() ? 0 : found->second;
}

const osg::StateSet* LabelObjects::update(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    Context& context = _contexts[state.getContextID()];
    if (!context.stateSet)
    {
        context.stateSet = new osg::StateSet;
        context.texture = new BufferTexture(state.getContextID(), 4, false);
        context.stateSet->setTextureAttribute(RecordsUnit, context.texture);
        context.stateSet->addUniform(new osg::Uniform("osgLabels_objects", int(RecordsUnit)));
    }
    const std::size_t bytes = sizeof(_records.front());
    if (!context.texture->resize(state, _records.size() * bytes))
        context.sent = 0;
    if (context.sent < _records.size())
        context.texture->write(state, context.sent * bytes, _records[context.sent].data(),
                               (_records.size() - context.sent) * bytes);
    context.sent = _records.size();
    return context.stateSet.get();
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
