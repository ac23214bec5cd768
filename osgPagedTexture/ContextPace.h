// SPDX-License-Identifier: MIT
// One budget of uploads for all scenes of a graphics context. Not installed.
#pragma once

#include <osgPagedTexture/UploadPace.h>

#include <osg/ContextData>
#include <osg/GLObjects>
#include <osg/State>

namespace osgPagedTexture
{

/// The pace of a context's uploads, in its draw thread: PagedScenes and VirtualScenes that are
/// drawn in one frame share that frame's time, which is the largest that one of them allows.
class ContextPace : public osg::GraphicsObjectManager
{
public:
    explicit ContextPace(unsigned int contextID)
        : osg::GraphicsObjectManager("osgPagedTexture::ContextPace", contextID)
    {
    }

    static ContextPace& of(osg::State& state) { return *state.get<ContextPace>(); }

    /// What is left of the frame for somebody who may take that many milliseconds.
    UploadPace& begin(const osg::State& state, double milliseconds)
    {
        const osg::FrameStamp* stamp = state.getFrameStamp();
        const unsigned int frame = stamp ? stamp->getFrameNumber() : 0;
        if (!_isBegun || !stamp || frame != _frame)
            _pace.begin(milliseconds);
        else
            _pace.widen(milliseconds);
        _isBegun = true;
        _frame = frame;
        return _pace;
    }

    void flushDeletedGLObjects(double, double&) override {}
    void flushAllDeletedGLObjects() override {}
    void deleteAllGLObjects() override {}
    void discardAllGLObjects() override {}

private:
    UploadPace _pace;
    bool _isBegun = false;
    unsigned int _frame = 0;
};

} // namespace osgPagedTexture
