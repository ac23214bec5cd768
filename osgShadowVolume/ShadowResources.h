// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/ScreenTriangle.h>
#include <osgMultiRender/TargetPool.h>
#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/MapPrograms.h>
#include <osgShadowVolume/MapTargets.h>
#include <osgShadowVolume/ShadowPasses.h>
#include <osgShadowVolume/ShadowTargets.h>
#include <osgShadowVolume/SilhouetteCache.h>

#include <osg/Notify>

#include <atomic>
#include <string>

namespace osgShadowVolume
{

/// What a ShadowedScene keeps from frame to frame for the shadows of all its views. Thread safe.
struct ShadowResources
{
    osgMultiRender::TargetPool<ShadowTargets> targets;
    osgMultiRender::TargetPool<MapTargets> maps;
    ShadowPasses passes;
    MapPrograms mapPrograms;
    SilhouetteCache silhouettes;
    osg::ref_ptr<osg::Geometry> screen =
        osgMultiRender::makeScreenTriangle(); ///< One triangle over the viewport.
    osg::ref_ptr<CasterCache> casters = CasterCache::instance();

    /// Says on the console, the first time, that there are no shadows; returns the reason for
    /// plans.
    std::string warnIncomplete(const std::string& status, int width, int height, int samples)
    {
        const std::string reason = "OpenGL can't draw into buffers of " + std::to_string(width) +
                                   "x" + std::to_string(height) + " pixels with " +
                                   std::to_string(samples) +
                                   (samples == 1 ? " sample (" : " samples (") + status + ")";
        if (!_saidIncomplete.exchange(true))
            OSG_WARN << "osgShadowVolume::ShadowedScene: no shadows, because " << reason
                     << "; fewer pixels or samples may help" << std::endl;
        return "no shadow: " + reason;
    }

    void releaseGLObjects(osg::State* state)
    {
        targets.releaseGLObjects(state);
        maps.releaseGLObjects(state);
        passes.releaseGLObjects(state);
        mapPrograms.releaseGLObjects(state);
        silhouettes.releaseGLObjects(state);
        screen->releaseGLObjects(state);
    }

private:
    std::atomic<bool> _saidIncomplete{false};
};

} // namespace osgShadowVolume
