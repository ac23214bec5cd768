// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

#include <deque>
#include <mutex>

namespace osgUtil
{
class CullVisitor;
} // namespace osgUtil

namespace osgPagedTexture
{

class Pager;

/// The graph at the lower edge of a view: milliseconds of each frame's uploads as bars, the budget
/// as a line, and in words what is where. Any thread.
class PagedGraph
{
public:
    /// Adds it to what the view draws, in front of everything.
    void cull(osgUtil::CullVisitor& visitor, const Pager& pager);

private:
    std::mutex _mutex;
    std::deque<osg::ref_ptr<osg::Node>> _kept; ///< The draw thread may still need them.
};

} // namespace osgPagedTexture
