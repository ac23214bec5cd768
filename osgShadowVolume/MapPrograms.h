// SPDX-License-Identifier: MIT
#pragma once

#include <osg/State>
#include <osg/StateSet>

#include <map>
#include <mutex>

namespace osgShadowVolume
{

/// The states in which depth maps are drawn. Thread safe.
class MapPrograms
{
public:
    /// For maps that are filtered over `samples` texels on a side. Lives as long as this.
    const osg::StateSet& get(unsigned int samples);

    void releaseGLObjects(osg::State* state) const;

private:
    mutable std::mutex _mutex;
    std::map<unsigned int, osg::ref_ptr<osg::StateSet>> _states;
};

} // namespace osgShadowVolume
