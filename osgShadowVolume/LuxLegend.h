// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>
#include <osg/State>

#include <mutex>
#include <vector>

namespace osgUtil
{
class CullVisitor;
}

namespace osgShadowVolume
{

/// The legend of the false colours: a colour bar with round values in lux at the left edge of a
/// view. Thread safe.
class LuxLegend
{
public:
    /// Adds the legend for 0 to `maximum` lux to what the view draws, in front of everything.
    void cull(osgUtil::CullVisitor& visitor, double maximum);

    void resizeGLObjectBuffers(unsigned int maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    /// One that was drawn lately; the draw thread may still need it.
    struct Entry
    {
        int width, height;
        double maximum;
        osg::ref_ptr<osg::Node> node;
        unsigned int frame; ///< Of its last use.
    };

    osg::Node& get(int width, int height, double maximum, unsigned int frame);

    mutable std::mutex _mutex;
    std::vector<Entry> _entries;
};

} // namespace osgShadowVolume
