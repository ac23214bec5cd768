// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Referenced>
#include <osg/State>
#include <osg/ref_ptr>

#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

namespace osgMultiRender
{

/// What views draw into before their surfaces, kept from frame to frame: views that are drawn one
/// after the other share it. `Targets` is made from a context and a Layout. Thread safe.
template <class Targets> class TargetPool
{
public:
    using Layout = typename Targets::Layout;

    osg::ref_ptr<Targets> acquire(unsigned int contextID, const Layout& layout)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        auto& free = _free[contextID];
        ++_uses;
        // Of a window that was resized, of a number of lights that has changed.
        free.erase(std::remove_if(free.begin(), free.end(),
                                  [this](const Free& f) { return f.use + UsesUnused < _uses; }),
                   free.end());
        const auto found =
            std::find_if(free.begin(), free.end(),
                         [&](const Free& f) { return f.targets->getLayout() == layout; });
        if (found == free.end())
            return new Targets(contextID, layout);
        osg::ref_ptr<Targets> targets = found->targets;
        free.erase(found);
        return targets;
    }

    void release(unsigned int contextID, osg::ref_ptr<Targets> targets)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _free[contextID].push_back({std::move(targets), _uses});
    }

    void releaseGLObjects(osg::State* state)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!state)
            _free.clear();
        else
            _free.erase(state->getContextID());
    }

private:
    /// Views that a frame may have, times some frames.
    static constexpr unsigned int UsesUnused = 32;

    struct Free
    {
        osg::ref_ptr<Targets> targets;
        unsigned int use; ///< When it was given back.
    };

    std::mutex _mutex;
    unsigned int _uses = 0;
    std::map<unsigned int, std::vector<Free>> _free;
};

} // namespace osgMultiRender
