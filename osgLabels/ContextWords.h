// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>

#include <map>
#include <mutex>
#include <vector>

namespace osgLabels
{

/// Words that shaders read, in a texture a context. `Source` is what they are made of: they are
/// sent again where it is another one. Thread safe.
template <class Source> class ContextWords
{
public:
    /// Uploads what `wordsOf` makes of the source, if the context, which is current, does not have
    /// that already. A source that was never set (`Source()`) has no words.
    template <class WordsOf>
    osg::ref_ptr<BufferTexture> upload(osg::State& state, const Source& source, WordsOf wordsOf)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        Context& context = _contexts[state.getContextID()];
        if (!context.texture)
            context.texture =
                new BufferTexture(state.getContextID(), 1, BufferTexture::needsPages(state));
        if (!(context.source == source))
        {
            const std::vector<std::uint32_t>& words = wordsOf();
            const std::size_t bytes = words.size() * sizeof(words.front());
            context.texture->resize(state, bytes);
            context.texture->write(state, 0, words.data(), bytes);
            context.source = source;
        }
        return context.texture;
    }

    void releaseGLObjects(osg::State* state)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        for (auto context = _contexts.begin(); context != _contexts.end();)
            if (!state || state->getContextID() == context->first)
                context = _contexts.erase(context);
            else
                ++context;
    }

private:
    struct Context
    {
        osg::ref_ptr<BufferTexture> texture;
        Source source{};
    };
    std::mutex _mutex;
    std::map<unsigned int, Context> _contexts;
};

} // namespace osgLabels
