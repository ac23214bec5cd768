// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>
#include <osgLabels/ObjectRecord.h>

#include <osg/StateSet>

#include <array>
#include <map>
#include <mutex>
#include <vector>

namespace osgLabels
{

/// The object records of a scene, and their copies on the GPU. Thread safe.
class LabelObjects
{
public:
    /// Sets the record of an object.
    void set(std::uint32_t object, const ObjectRecord& record);

    /// Uploads what is new for the context, which is current. Returns texture and uniform.
    const osg::StateSet* update(osg::State& state);

    std::size_t getBytes() const;
    void releaseGLObjects(osg::State* state);

private:
    using Words = std::array<std::uint32_t, ObjectRecord::Words>;

    struct Context
    {
        osg::ref_ptr<osg::StateSet> stateSet;
        osg::ref_ptr<BufferTexture> texture;
        std::size_t changes = 0; ///< How many of _changed it has taken.
    };

    mutable std::mutex _mutex;
    std::vector<Words> _records{1};      ///< By object; 0 is none.
    std::vector<std::uint32_t> _changed; ///< Objects, in the order in which they were set.
    std::map<unsigned int, Context> _contexts;
};

} // namespace osgLabels
