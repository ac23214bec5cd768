// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/EdgeMesh.h>

#include <osg/BoundingBox>
#include <osg/Geometry>

#include <mutex>
#include <vector>

namespace osgShadowVolume
{

/// The Drawables that one CasterMesh is made of. They have one local frame.
using CasterSource = std::vector<osg::ref_ptr<const osg::Drawable>>;

/// What keeps a Drawable from casting a shadow.
enum class NoCaster
{
    CASTS,
    TEXT,
    POINTS_AND_LINES, ///< Only these, or nothing at all.
    NO_TRIANGLES      ///< A class of Drawable that can't say what its triangles are: particles.
};

/// Looks at its class and its primitive types, not at vertices.
OSGSHADOWVOLUME_EXPORT NoCaster whyNoCaster(const osg::Drawable& drawable);

/// Says on the console that so many triangles cast no shadow, and why. Once for Drawables of a name
/// and a reason: a mesh that changes is built again and again. Silent for no triangles.
void warnLeftOut(const CasterSource& source, std::size_t triangles, const char* reason);

/// The welded triangles of some Drawables, and what draws them.
///
/// Reads what readTriangles() reads; triangles with indices beyond the vertices are left out and
/// counted. Where GL draws a quad that is not planar along the other diagonal the quad may shadow
/// itself. Functions may be called from any thread.
class OSGSHADOWVOLUME_EXPORT CasterMesh : public osg::Referenced
{
public:
    /// Does not look at the Drawables yet.
    CasterMesh() = default;

    /// Takes the triangles out of the Drawables, the first time that it is called; returns when
    /// they are there.
    void build(const CasterSource& source);

    const EdgeMesh& getEdges() const { return _edges; }
    const osg::BoundingBox& getBoundingBox() const { return _box; } ///< Of the triangles.
    std::size_t getBadIndices() const { return _badIndices; } ///< Triangles left out for them.

    /// One of each group of the EdgeMesh, in its order: GL_PATCHES of 2 + opposites vertices. Draws
    /// with that patch size whatever the state says.
    const std::vector<osg::ref_ptr<osg::Geometry>>& getPatches();
    /// The edges as GL_LINES_ADJACENCY: the two ends, then two opposite vertices; edges with more
    /// come several times. What is missing is the first end again.
    osg::Geometry* getLines();
    /// The triangles, with ascending indices.
    osg::Geometry* getTriangles();
    /// The vertices with w = 1, then once more with w = 0, for the indices of a Silhouette.
    osg::Vec4Array* getExtrudable();

protected:
    ~CasterMesh() override;

private:
    osg::ref_ptr<osg::Geometry> makeGeometry(osg::Geometry* geometry,
                                             osg::PrimitiveSet* primitives);

    std::once_flag _built;
    EdgeMesh _edges;
    osg::BoundingBox _box;
    std::size_t _badIndices = 0;

    std::mutex _mutex; ///< Of what follows: all made when asked for.
    osg::ref_ptr<osg::Vec3Array> _vertices;
    std::vector<osg::ref_ptr<osg::Geometry>> _patches;
    osg::ref_ptr<osg::Geometry> _lines;
    osg::ref_ptr<osg::Geometry> _triangles;
    osg::ref_ptr<osg::Vec4Array> _extrudable;
};

} // namespace osgShadowVolume
