// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/MapPrograms.h>
#include <osgShadowVolume/MapTargets.h>
#include <osgShadowVolume/ShadowTargets.h>
#include <osgShadowVolume/SilhouetteCache.h>
#include <osgShadowVolume/TargetPool.h>
#include <osgShadowVolume/VolumePrograms.h>

namespace osgShadowVolume
{

/// What a ShadowedScene keeps from frame to frame for the shadows of all its views. Thread safe.
struct ShadowResources
{
    TargetPool<ShadowTargets> targets;
    TargetPool<MapTargets> maps;
    MapPrograms mapPrograms;
    VolumePrograms programs;
    SilhouetteCache silhouettes;
    osg::ref_ptr<CasterCache> casters = CasterCache::instance();

    void releaseGLObjects(osg::State* state)
    {
        targets.releaseGLObjects(state);
        maps.releaseGLObjects(state);
        mapPrograms.releaseGLObjects(state);
        programs.releaseGLObjects(state);
        silhouettes.releaseGLObjects(state);
    }
};

} // namespace osgShadowVolume
