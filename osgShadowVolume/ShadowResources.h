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

    void releaseGLObjects(osg::State* state)
    {
        targets.releaseGLObjects(state);
        maps.releaseGLObjects(state);
        passes.releaseGLObjects(state);
        mapPrograms.releaseGLObjects(state);
        silhouettes.releaseGLObjects(state);
        screen->releaseGLObjects(state);
    }
};

} // namespace osgShadowVolume
