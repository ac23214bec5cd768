// SPDX-License-Identifier: MIT
#include <osgShadowVolume/SilhouetteCache.h>

#include <osg/Geometry>
#include <osg/State>

namespace osgShadowVolume
{

namespace
{

osg::ref_ptr<osg::Geometry> makeGeometry(osg::Vec4Array* vertices,
                                         const std::vector<std::uint32_t>& indices)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawElementsUInt(
        GL_TRIANGLES, static_cast<unsigned int>(indices.size()), indices.data()));
    return geometry;
}

osg::ref_ptr<SilhouetteCache::Volume> makeVolume(CasterMesh& mesh, const MeshLight& light)
{
    const Silhouette silhouette = silhouetteOf(mesh.getEdges(), light, 0);
    osg::Vec4Array* vertices = mesh.getExtrudable();
    osg::ref_ptr<SilhouetteCache::Volume> volume = new SilhouetteCache::Volume;
    for (const Silhouette::Sides& sides : silhouette.sides)
        if (!sides.indices.empty())
            volume->sides.emplace_back(float(sides.weight), makeGeometry(vertices, sides.indices));
    for (const auto* caps : {&silhouette.nearCaps, &silhouette.farCaps})
        if (!caps->empty())
            volume->caps.emplace_back(1.0f, makeGeometry(vertices, *caps));
    return volume;
}

} // namespace

osg::ref_ptr<SilhouetteCache::Volume> SilhouetteCache::get(const osg::ref_ptr<CasterMesh>& mesh,
                                                           const MeshLight& light,
                                                           unsigned int contextID,
                                                           unsigned int frameNumber)
{
    std::lock_guard<std::mutex> lock(_mutex);
    evict(contextID, frameNumber);
    Entry& entry = _entries[Key(contextID, mesh.get(), light.light.x, light.light.y, light.light.z,
                                light.light.w, light.rest.x, light.rest.y, light.rest.z,
                                light.endsInAPoint())];
    if (!entry.volume)
    {
        entry.mesh = mesh;
        entry.volume = makeVolume(*mesh, light);
    }
    entry.frameNumber = frameNumber;
    return entry.volume;
}

void SilhouetteCache::evict(unsigned int contextID, unsigned int frameNumber)
{
    if (const auto [last, isNew] = _frameNumbers.emplace(contextID, frameNumber);
        !isNew && last->second == frameNumber)
        return;
    _frameNumbers[contextID] = frameNumber;
    for (auto entry = _entries.begin(); entry != _entries.end();)
        // A viewer that starts anew counts from 0 again: that is far away, too.
        if (std::get<0>(entry->first) == contextID &&
            frameNumber - entry->second.frameNumber > FramesUnused)
            entry = _entries.erase(entry);
        else
            ++entry;
}

void SilhouetteCache::releaseGLObjects(osg::State* state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto entry = _entries.begin(); entry != _entries.end();)
        if (!state || std::get<0>(entry->first) == state->getContextID())
        {
            for (const auto* parts : {&entry->second.volume->sides, &entry->second.volume->caps})
                for (const auto& [weight, geometry] : *parts)
                    geometry->releaseGLObjects(state);
            entry = _entries.erase(entry);
        }
        else
            ++entry;
}

} // namespace osgShadowVolume
