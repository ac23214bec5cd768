// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/ShadowTargets.h>
#include <osgShadowVolume/SilhouetteCache.h>
#include <osgShadowVolume/VolumePrograms.h>

namespace osgShadowVolume
{

/// What a ShadowedScene keeps from frame to frame for the shadows of all its views. Thread safe.
struct ShadowResources
{
    ShadowTargetPool targets;
    VolumePrograms programs;
    SilhouetteCache silhouettes;
    osg::ref_ptr<CasterCache> casters = CasterCache::instance();

    void releaseGLObjects(osg::State* state)
    {
        targets.releaseGLObjects(state);
        programs.releaseGLObjects(state);
        silhouettes.releaseGLObjects(state);
    }
};

} // namespace osgShadowVolume
