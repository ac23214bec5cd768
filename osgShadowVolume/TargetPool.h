// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Referenced>
#include <osg/State>
#include <osg/ref_ptr>

#include <algorithm>
#include <map>
#include <mutex>
#include <vector>

namespace osgShadowVolume
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
        const auto found = std::find_if(free.begin(), free.end(),
                                        [&](const auto& t) { return t->getLayout() == layout; });
        if (found == free.end())
        {
            free.clear(); // a window that was resized, a number of lights that has changed
            return new Targets(contextID, layout);
        }
        osg::ref_ptr<Targets> targets = *found;
        free.erase(found);
        return targets;
    }

    void release(unsigned int contextID, osg::ref_ptr<Targets> targets)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _free[contextID].push_back(std::move(targets));
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
    std::mutex _mutex;
    std::map<unsigned int, std::vector<osg::ref_ptr<Targets>>> _free;
};

} // namespace osgShadowVolume
