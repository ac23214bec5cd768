// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>
#include <osgLabels/ObjectRecord.h>

#include <osg/Drawable>
#include <osg/StateSet>

#include <map>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace osgUtil
{
class RenderLeaf;
}

namespace osgLabels
{

/// Which drawable is which labelled object. Thread safe.
class LabelObjects
{
public:
    /// Index of the record, from 1.
    std::uint32_t add(const osg::Drawable& drawable, const ObjectRecord& record);
    std::uint32_t indexOf(const osgUtil::RenderLeaf& leaf) const;
    const osg::StateSet* update(osg::State& state);
    void releaseGLObjects(osg::State* state);

private:
    struct Context
    {
        osg::ref_ptr<osg::StateSet> stateSet;
        osg::ref_ptr<BufferTexture> texture;
        std::size_t sent = 0;
    };
    mutable std::mutex _mutex;
    std::vector<std::array<std::uint32_t, ObjectRecord::Words>> _records{1};
    std::unordered_map<const osg::Drawable*, std::uint32_t> _indices;
    std::map<unsigned int, Context> _contexts;
};

} // namespace osgLabels
