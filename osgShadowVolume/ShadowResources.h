// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/CasterCache.h>
#include <osgShadowVolume/MapPrograms.h>
#include <osgShadowVolume/MapTargets.h>
#include <osgShadowVolume/ShadowPasses.h>
#include <osgShadowVolume/ShadowTargets.h>
#include <osgShadowVolume/SilhouetteCache.h>
#include <osgShadowVolume/TargetPool.h>

#include <osg/Geometry>

namespace osgShadowVolume
{

inline osg::ref_ptr<osg::Geometry> makeScreen()
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::Vec3 corners[] = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
    geometry->setVertexArray(new osg::Vec3Array(3, corners));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}

/// What a ShadowedScene keeps from frame to frame for the shadows of all its views. Thread safe.
struct ShadowResources
{
    TargetPool<ShadowTargets> targets;
    TargetPool<MapTargets> maps;
    ShadowPasses passes;
    MapPrograms mapPrograms;
    SilhouetteCache silhouettes;
    osg::ref_ptr<osg::Geometry> screen = makeScreen(); ///< One triangle over the viewport.
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
