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
#include <osg/Notify>

#include <atomic>
#include <string>

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
