// SPDX-License-Identifier: MIT
// What a view needs, as the GPU has seen it. Not installed.
#pragma once

#include <osgPagedTexture/VirtualPages.h>

#include <osgMultiRender/Framebuffer.h>
#include <osgMultiRender/TargetTexture.h>

#include <osg/BufferObject>

#include <deque>
#include <memory>
#include <vector>

namespace osgPagedTexture
{

/// The feedback pictures of one view in one context, as virtualFeedback.glsl draws them, and their
/// way to the CPU, for which nobody waits.
class VirtualFeedback
{
public:
    explicit VirtualFeedback(unsigned int contextID);

    /// Binds targets of this size and clears them. Leaves them bound.
    void bind(osg::State& state, int width, int height);

    /// Sends what is bound on its way; false where too many are, and this one does not count.
    bool start(osg::State& state);

    /// The next picture that has come; false where none has. Called until then in each frame.
    bool take(osg::State& state, std::vector<PageNeed>& needs);

    /// What is bound, at once.
    std::vector<PageNeed> readNow() const;

    bool isOnItsWay() const { return !_ways.empty(); }
    void releaseGLObjects(osg::State* state);

private:
    struct Way
    {
        int width = 0, height = 0;
        osg::ref_ptr<osg::PixelDataBufferObject> buffer;
        GLsync fence = nullptr; ///< Null where GL has none.
        unsigned int age = 0;   ///< Calls of take().
    };
    void makeTargets(int width, int height);

    const unsigned int _contextID;
    int _width = 0, _height = 0;
    osg::ref_ptr<osgMultiRender::TargetTexture> _pages, _depth;
    osgMultiRender::Framebuffer _framebuffer;
    std::deque<Way> _ways;
    std::vector<osg::ref_ptr<osg::PixelDataBufferObject>> _free;
};

} // namespace osgPagedTexture
