// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterMesh.h>

#include <osgShadowVolume/EdgeMeshBuilder.h>
#include <osgShadowVolume/TriangleReader.h>

#include <osg/Notify>
#include <osg/PatchParameter>
#include <osg/State>
#include <osgText/TextBase>

#include <algorithm>
#include <set>
#include <string>

namespace osgShadowVolume
{

namespace
{

/// Returns how many triangles had indices beyond the vertices.
std::size_t readCaster(const osg::Drawable& drawable, EdgeMeshBuilder& builder)
{
    if (whyNoCaster(drawable) != NoCaster::CASTS)
        return 0;
    return readTriangles(drawable, [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
                         { builder.addTriangle(a, b, c); });
}

/// GL_PATCHES of a size of their own.
class PatchGeometry : public osg::Geometry
{
public:
    explicit PatchGeometry(unsigned int size) : _size(new osg::PatchParameter(GLint(size))) {}

    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        renderInfo.getState()->applyAttribute(_size.get());
        osg::Geometry::drawImplementation(renderInfo);
    }

private:
    osg::ref_ptr<osg::PatchParameter> _size;
};

osg::DrawElementsUInt* makeIndices(GLenum mode, const std::vector<std::uint32_t>& indices)
{
    return new osg::DrawElementsUInt(mode, indices.begin(), indices.end());
}

std::vector<std::uint32_t> pairOpposites(const std::vector<EdgeMesh::Group>& groups)
{
    std::vector<std::uint32_t> lines;
    for (const EdgeMesh::Group& group : groups)
    {
        const std::size_t size = 2 + group.opposites;
        for (std::size_t at = 0; at != group.indices.size(); at += size)
        {
            const std::uint32_t* record = group.indices.data() + at;
            for (std::size_t i = 2; i < size; i += 2)
                lines.insert(lines.end(), {record[0], record[1], record[i],
                                           i + 1 < size ? record[i + 1] : record[0]});
        }
    }
    return lines;
}

} // namespace

NoCaster whyNoCaster(const osg::Drawable& drawable)
{
    if (drawable.asGeometry())
        return hasTriangles(drawable) ? NoCaster::CASTS : NoCaster::POINTS_AND_LINES;
    if (dynamic_cast<const osgText::TextBase*>(&drawable))
        return NoCaster::TEXT;
    return hasTriangles(drawable) ? NoCaster::CASTS : NoCaster::NO_TRIANGLES;
}

CasterMesh::~CasterMesh() = default;

void warnLeftOut(const CasterSource& source, std::size_t triangles, const char* reason)
{
    static std::mutex mutex;
    static std::set<std::string> said;
    if (!triangles)
        return;
    std::string name;
    for (const auto& drawable : source)
        if (name.empty())
            name = drawable->getName();
    name = name.empty() ? "a drawable" : "drawable '" + name + "'";
    std::lock_guard<std::mutex> lock(mutex);
    if (said.size() < 100 && said.insert(name + reason).second)
        OSG_WARN << "osgShadowVolume: " << name << ": " << triangles << " of its triangles "
                 << (triangles == 1 ? "casts" : "cast") << " no shadow, because " << reason
                 << std::endl;
}

void CasterMesh::build(const CasterSource& source)
{
    std::call_once(_built,
                   [&]
                   {
                       EdgeMeshBuilder builder;
                       for (const auto& drawable : source)
                           _badIndices += readCaster(*drawable, builder);
                       _edges = builder.build();
                       for (const glm::vec3& v : _edges.vertices)
                           _box.expandBy(v.x, v.y, v.z);
                       warnLeftOut(source, _edges.notFinite,
                                   "a coordinate is infinite or not a number");
                       warnLeftOut(source, _badIndices, "an index is beyond the vertices");
                   });
}

osg::ref_ptr<osg::Geometry> CasterMesh::makeGeometry(osg::Geometry* geometry,
                                                     osg::PrimitiveSet* primitives)
{
    osg::ref_ptr<osg::Geometry> made = geometry;
    if (!_vertices)
    {
        _vertices = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
        _vertices->reserve(_edges.vertices.size());
        for (const glm::vec3& v : _edges.vertices)
            _vertices->push_back(osg::Vec3(v.x, v.y, v.z));
    }
    made->setUseDisplayList(false);
    made->setUseVertexBufferObjects(true);
    made->setCullingActive(false);
    made->setVertexArray(_vertices);
    made->addPrimitiveSet(primitives);
    return made;
}

const std::vector<osg::ref_ptr<osg::Geometry>>& CasterMesh::getPatches()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (_patches.empty())
        for (const EdgeMesh::Group& group : _edges.groups)
            _patches.push_back(makeGeometry(new PatchGeometry(2 + group.opposites),
                                            makeIndices(GL_PATCHES, group.indices)));
    return _patches;
}

osg::Geometry* CasterMesh::getLines()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_lines)
        _lines = makeGeometry(new osg::Geometry,
                              makeIndices(GL_LINES_ADJACENCY, pairOpposites(_edges.groups)));
    return _lines;
}

osg::Geometry* CasterMesh::getTriangles()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_triangles)
    {
        std::vector<std::uint32_t> indices;
        indices.reserve(3 * _edges.triangles.size());
        for (const glm::uvec3& t : _edges.triangles)
            indices.insert(indices.end(), {t.x, t.y, t.z});
        _triangles = makeGeometry(new osg::Geometry, makeIndices(GL_TRIANGLES, indices));
    }
    return _triangles;
}

osg::Vec4Array* CasterMesh::getExtrudable()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_extrudable)
    {
        _extrudable = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
        _extrudable->reserve(2 * _edges.vertices.size());
        for (const float w : {1.0f, 0.0f})
            for (const glm::vec3& v : _edges.vertices)
                _extrudable->push_back(osg::Vec4(v.x, v.y, v.z, w));
    }
    return _extrudable;
}

} // namespace osgShadowVolume
