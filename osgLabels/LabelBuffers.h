// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>
#include <osgLabels/LabelTable.h>

#include <osg/StateSet>

#include <map>
#include <memory>
#include <mutex>

namespace osgLabels
{

/// A LabelTable on the GPU, one set of buffers a graphics context, as labelTable.glsl reads it.
///
/// Requires GL 3.3.
class OSGLABELS_EXPORT LabelBuffers
{
public:
    /// `isPaged`: buffers are paged even where the context would not need it, for tests.
    explicit LabelBuffers(std::shared_ptr<LabelTable> table, bool isPaged = false);
    ~LabelBuffers();
    LabelBuffers(const LabelBuffers&) = delete;
    LabelBuffers& operator=(const LabelBuffers&) = delete;

    /// Texts sent in one frame to a context, unless the table says otherwise; see LabelTable::take.
    static constexpr std::size_t TextBytesPerFrame = std::size_t(4) << 20;

    /// Uploads what changed since the context's last call. Returns the textures (units of
    /// LabelUnits.h) and uniforms, with OVERRIDE, over the model's own; it stays the same object
    /// for the context. To be called with the context current, once a frame or more often.
    osg::ref_ptr<const osg::StateSet> update(osg::State& state);

    /// Whether labelTable.glsl needs OSGLABELS_PAGED in the context. Never changes.
    bool isPaged(osg::State& state);

    /// What the context's buffers take and the last update() sent.
    struct Traffic
    {
        std::size_t bytesHeld = 0;
        std::size_t bytesSent = 0;
        unsigned int calls = 0; ///< Of glBufferSubData.
    };
    Traffic getTraffic(unsigned int contextID) const;

    void releaseGLObjects(osg::State* state) const;

private:
    class Context;
    /// Others may release it meanwhile.
    std::shared_ptr<Context> get(osg::State& state);

    const std::shared_ptr<LabelTable> _table;
    const bool _isPaged;
    mutable std::mutex _mutex;
    mutable std::map<unsigned int, std::shared_ptr<Context>> _contexts;
};

} // namespace osgLabels
