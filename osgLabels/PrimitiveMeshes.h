// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/UnitMesh.h>

#include <osg/Array>
#include <osg/PrimitiveSet>

namespace osgLabels
{

/// The unit meshes of one kind, level by level, in one vertex and one index buffer. All batches
/// share them.
class PrimitiveMeshes : public osg::Referenced
{
public:
    /// Those of `kind`, made at the first call and kept while somebody has them. Any thread.
    static osg::ref_ptr<const PrimitiveMeshes> of(const MeshKind& kind);

    struct Level
    {
        UnitMesh mesh;              ///< Indices from 0.
        std::size_t firstIndex = 0; ///< In indices().
    };

    int size() const { return static_cast<int>(_levels.size()); }
    const Level& level(int i) const { return _levels[i]; }
    /// The mesh that other visitors than cull see.
    const UnitMesh& visitorMesh() const;

    const osg::Array* positions() const { return _positions.get(); }
    const osg::Array* normals() const { return _normals.get(); }
    const osg::DrawElementsUShort* indices() const { return _indices.get(); }

protected:
    ~PrimitiveMeshes() override = default;

private:
    explicit PrimitiveMeshes(const MeshKind& kind);

    std::vector<Level> _levels;
    osg::ref_ptr<osg::Vec3Array> _positions = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> _normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUShort> _indices = new osg::DrawElementsUShort(GL_TRIANGLES);
};

} // namespace osgLabels
