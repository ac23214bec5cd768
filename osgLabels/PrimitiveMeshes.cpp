// SPDX-License-Identifier: MIT
#include "PrimitiveMeshes.h"

#include <osg/BufferObject>
#include <osg/observer_ptr>

#include <algorithm>
#include <map>
#include <mutex>

namespace osgLabels
{

osg::ref_ptr<const PrimitiveMeshes> PrimitiveMeshes::of(const MeshKind& kind)
{
    static std::mutex mutex;
    static std::map<std::uint32_t, osg::observer_ptr<PrimitiveMeshes>> shared;
    const std::lock_guard<std::mutex> lock(mutex);
    osg::observer_ptr<PrimitiveMeshes>& known = shared[kind.number()];
    osg::ref_ptr<PrimitiveMeshes> meshes;
    if (!known.lock(meshes))
        known = meshes = new PrimitiveMeshes(kind);
    return meshes;
}

PrimitiveMeshes::PrimitiveMeshes(const MeshKind& kind) : osg::Referenced(true)
{
    for (int i = 0; i < levelsOf(kind.shape); ++i)
    {
        Level level{makeUnitMesh(kind, LevelSides[i]), _indices->size()};
        const std::size_t first = _positions->size();
        for (const SurfacePoint& point : level.mesh.points)
        {
            _positions->push_back({point.position.x, point.position.y, point.position.z});
            _normals->push_back({point.normal.x, point.normal.y, point.normal.z});
        }
        for (std::uint16_t index : level.mesh.triangles)
            _indices->push_back(static_cast<GLushort>(first + index));
        _levels.push_back(std::move(level));
    }
    _normals->setBinding(osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::VertexBufferObject> vertices = new osg::VertexBufferObject;
    _positions->setBufferObject(vertices);
    _normals->setBufferObject(vertices);
    _indices->setElementBufferObject(new osg::ElementBufferObject);
    _positions->setThreadSafeRefUnref(true);
    _normals->setThreadSafeRefUnref(true);
    _indices->setThreadSafeRefUnref(true);
}

const UnitMesh& PrimitiveMeshes::visitorMesh() const
{
    return _levels[std::min(VisitorLevel, size() - 1)].mesh;
}

} // namespace osgLabels
