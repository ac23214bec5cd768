// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelBuffers.h>
#include <osgLabels/LabelObjects.h>
#include <osgLabels/LabelPrograms.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/LabelTargets.h>

#include <osgMultiRender/ScreenTriangle.h>
#include <osgMultiRender/TargetPool.h>

namespace osgLabels
{

/// What a LabelScene keeps from frame to frame for all its views. Thread safe.
struct LabelResources
{
    std::shared_ptr<LabelTable> table = std::make_shared<LabelTable>();
    LabelBuffers buffers{table};
    LabelObjects objects;
    osgMultiRender::TargetPool<LabelTargets> targets;
    LabelPrograms programs;
    osg::ref_ptr<osg::Geometry> screen = osgMultiRender::makeScreenTriangle();

    void releaseGLObjects(osg::State* state)
    {
        buffers.releaseGLObjects(state);
        objects.releaseGLObjects(state);
        targets.releaseGLObjects(state);
        programs.releaseGLObjects(state);
        screen->releaseGLObjects(state);
    }
};

} // namespace osgLabels
