// SPDX-License-Identifier: MIT
#include <osgLabels/MapNests.h>

namespace osgLabels
{

osg::ref_ptr<BufferTexture>
MapNests::upload(osg::State& state, const std::shared_ptr<const FeatureTree::Nesting>& nesting,
                 const std::vector<std::uint32_t>& depths)
{
    std::lock_guard<std::mutex> lock(_mutex);
    Context& context = _contexts[state.getContextID()];
    if (!context.texture)
        context.texture =
            new BufferTexture(state.getContextID(), 1, BufferTexture::needsPages(state));
    if (context.nesting == nesting && context.depths == depths)
        return context.texture;
    std::vector<std::uint32_t> words;
    for (const std::uint32_t depth : depths)
        for (int number = 0; number < getNumbers(*nesting); ++number)
        {
            const FeatureTree::Range range = nesting->at(std::uint32_t(number), depth);
            words.push_back(range.first);
            words.push_back(range.last);
        }
    const std::size_t bytes = words.size() * sizeof(words.front());
    context.texture->resize(state, bytes);
    context.texture->write(state, 0, words.data(), bytes);
    context.nesting = nesting;
    context.depths = depths;
    return context.texture;
}

void MapNests::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto context = _contexts.begin(); context != _contexts.end();)
        if (!state || state->getContextID() == context->first)
            context = _contexts.erase(context);
        else
            ++context;
}

} // namespace osgLabels
