// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <osg/Array>
#include <osg/Geometry>
#include <osg/Matrixd>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgLabels
{

/// Which vertex arrays a Geometry has. Geometries of one layout can be one.
struct MeshLayout
{
    static constexpr std::size_t Units = 8;

    enum Colors : std::uint8_t
    {
        NONE,
        FLOATS,
        BYTES
    };
    bool hasNormals = false;
    Colors colors = NONE;
    std::array<std::uint8_t, Units> texCoords{}; ///< Components a unit, 0 for none.

    bool operator<(const MeshLayout& other) const;

    /// None for what can't be gathered: other arrays than these, of other types than OSG's usual
    /// ones, too short or bound to anything but vertices or the whole; anything but triangles,
    /// quads and polygons; indices out of range.
    static std::optional<MeshLayout> of(const osg::Geometry& geometry);
};

/// One Geometry made of several, with the number of the object at each vertex.
///
/// Vertices and indices are taken over as they are: what was welded stays so. Strips and fans
/// become triangles and quads with the same last vertex, so that flat shading stays, too.
class OSGLABELS_EXPORT ChunkMesh
{
public:
    /// Generic vertex attribute of the object's number, an integer.
    static constexpr unsigned int ObjectAttribute = 6;
    static constexpr char ObjectsName[] = "osgLabels.objects"; ///< Of the array of the attribute.

    /// Whether the drawable is what finish() has returned: its vertices say which objects they are
    /// of.
    static bool isOne(const osg::Drawable& drawable);

    explicit ChunkMesh(const MeshLayout& layout);

    /// `geometry` has the layout.
    void add(const osg::Geometry& geometry, const osg::Matrixd& localToChunk, std::uint32_t object);

    /// Static, drawn from buffer objects.
    osg::ref_ptr<osg::Geometry> finish();

private:
    void addColors(const osg::Array* colors, std::size_t count);
    void addIndices(const osg::PrimitiveSet& set, std::uint32_t first);
    void addPrimitives(GLenum mode, const std::vector<std::uint32_t>& indices, std::size_t begin,
                       std::size_t count);

    const MeshLayout _layout;
    osg::ref_ptr<osg::Vec3Array> _vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> _normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Array> _colors;
    std::array<osg::ref_ptr<osg::Array>, MeshLayout::Units> _texCoords;
    osg::ref_ptr<osg::IntArray> _objects = new osg::IntArray;
    std::vector<std::uint32_t> _triangles, _quads;
};

} // namespace osgLabels
