// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CasterMesh.h>

#include <osgShadowVolume/EdgeMeshBuilder.h>

#include <osg/Notify>
#include <osg/PatchParameter>
#include <osg/State>
#include <osg/TriangleFunctor>
#include <osg/TriangleIndexFunctor>
#include <osgText/TextBase>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <type_traits>

namespace osgShadowVolume
{

namespace
{

/// The positions of any kind of vertex array, as GL converts them.
class Positions : public osg::ConstArrayVisitor
{
public:
    std::vector<glm::vec3> points;

#define OSGSV_ARRAY(Type)                                                                          \
    void apply(const osg::Type& array) override                                                    \
    {                                                                                              \
        convert(array);                                                                            \
    }
    OSGSV_ARRAY(Vec2Array)
    OSGSV_ARRAY(Vec3Array)
    OSGSV_ARRAY(Vec4Array)
    OSGSV_ARRAY(Vec2dArray)
    OSGSV_ARRAY(Vec3dArray)
    OSGSV_ARRAY(Vec4dArray)
    OSGSV_ARRAY(Vec2sArray)
    OSGSV_ARRAY(Vec3sArray)
    OSGSV_ARRAY(Vec4sArray)
    OSGSV_ARRAY(Vec2iArray)
    OSGSV_ARRAY(Vec3iArray)
    OSGSV_ARRAY(Vec4iArray)
    OSGSV_ARRAY(Vec2bArray)
    OSGSV_ARRAY(Vec3bArray)
    OSGSV_ARRAY(Vec4bArray)
#undef OSGSV_ARRAY

private:
    template <class Array> void convert(const Array& array)
    {
        points.reserve(array.size());
        for (const auto& element : array)
        {
            constexpr int size = std::decay_t<decltype(element)>::num_components;
            glm::vec3 point{float(element[0]), float(element[1]), 0.0f};
            if constexpr (size > 2)
                point.z = float(element[2]);
            if constexpr (size > 3)
                if (float(element[3]) != 1.0f)
                    point /= float(element[3]);
            points.push_back(point);
        }
    }
};

struct AddIndexed
{
    EdgeMeshBuilder* builder = nullptr;
    const std::vector<glm::vec3>* points = nullptr;
    std::size_t bad = 0;

    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        const std::size_t size = points->size();
        if (a < size && b < size && c < size)
            builder->addTriangle((*points)[a], (*points)[b], (*points)[c]);
        else
            ++bad;
    }
};

/// Triangles of primitives, with the quads of strips divided as Mesa draws them: along the diagonal
/// from the first corner to the fourth, not along the other one, which OSG's functor takes.
class ReadTriangles : public osg::TriangleIndexFunctor<AddIndexed>
{
public:
    void drawArrays(GLenum mode, GLint first, GLsizei count) override
    {
        if (mode == GL_QUAD_STRIP)
            readStrip(count, [=](GLsizei i) { return unsigned(first + i); });
        else
            osg::TriangleIndexFunctor<AddIndexed>::drawArrays(mode, first, count);
    }
    void drawElements(GLenum mode, GLsizei count, const GLubyte* indices) override
    {
        readElements(mode, count, indices);
    }
    void drawElements(GLenum mode, GLsizei count, const GLushort* indices) override
    {
        readElements(mode, count, indices);
    }
    void drawElements(GLenum mode, GLsizei count, const GLuint* indices) override
    {
        readElements(mode, count, indices);
    }

private:
    template <class T> void readElements(GLenum mode, GLsizei count, const T* indices)
    {
        if (mode == GL_QUAD_STRIP)
            readStrip(count, [=](GLsizei i) { return unsigned(indices[i]); });
        else
            osg::TriangleIndexFunctor<AddIndexed>::drawElements(mode, count, indices);
    }

    template <class At> void readStrip(GLsizei count, const At& at)
    {
        for (GLsizei i = 0; i + 3 < count; i += 2)
        {
            (*this)(at(i), at(i + 1), at(i + 3));
            (*this)(at(i), at(i + 3), at(i + 2));
        }
    }
};

struct AddTriangles
{
    EdgeMeshBuilder* builder = nullptr;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false)
    {
        builder->addTriangle({a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}, {c.x(), c.y(), c.z()});
    }
};

const osg::Array* vertexArrayOf(const osg::Geometry& geometry)
{
    // As osg::Geometry itself: generic attribute 0 is the position.
    const osg::Array* array = geometry.getVertexArray();
    if ((!array || array->getNumElements() == 0) && geometry.getNumVertexAttribArrays() > 0)
        array = geometry.getVertexAttribArray(0);
    return array;
}

/// Returns how many triangles had indices beyond the vertices.
std::size_t addDrawable(const osg::Drawable& drawable, EdgeMeshBuilder& builder)
{
    if (whyNoCaster(drawable) != NoCaster::CASTS)
        return 0;
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry)
    {
        osg::TriangleFunctor<AddTriangles> functor;
        functor.builder = &builder;
        drawable.accept(functor);
        return 0;
    }
    const osg::Array* array = vertexArrayOf(*geometry);
    if (!array)
        return 0;
    Positions positions;
    array->accept(positions);
    ReadTriangles functor;
    functor.builder = &builder;
    functor.points = &positions.points;
    for (unsigned int i = 0; i != geometry->getNumPrimitiveSets(); ++i)
        geometry->getPrimitiveSet(i)->accept(functor);
    return functor.bad;
}

bool hasTriangles(const osg::Geometry& geometry)
{
    for (unsigned int i = 0; i != geometry.getNumPrimitiveSets(); ++i)
        switch (geometry.getPrimitiveSet(i)->getMode())
        {
        case GL_TRIANGLES:
        case GL_TRIANGLE_STRIP:
        case GL_TRIANGLE_FAN:
        case GL_QUADS:
        case GL_QUAD_STRIP:
        case GL_POLYGON:
            return true;
        default:
            break;
        }
    return false;
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
    if (const osg::Geometry* geometry = drawable.asGeometry())
        return hasTriangles(*geometry) ? NoCaster::CASTS : NoCaster::POINTS_AND_LINES;
    if (dynamic_cast<const osgText::TextBase*>(&drawable))
        return NoCaster::TEXT;
    // By name: the kit does not need the library for anything else.
    if (std::strcmp(drawable.libraryName(), "osgParticle") == 0)
        return NoCaster::PARTICLES;
    osg::TriangleFunctor<AddTriangles> functor;
    return drawable.supports(functor) ? NoCaster::CASTS : NoCaster::NO_TRIANGLES;
}

CasterMesh::~CasterMesh() = default;

namespace
{

/// Says once what is wrong with Drawables of a name: a mesh that changes is built again and again.
void warnOnce(const CasterSource& source, std::size_t triangles, const char* reason)
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

} // namespace

void CasterMesh::build(const CasterSource& source)
{
    std::call_once(_built,
                   [&]
                   {
                       EdgeMeshBuilder builder;
                       for (const auto& drawable : source)
                           _badIndices += addDrawable(*drawable, builder);
                       _edges = builder.build();
                       for (const glm::vec3& v : _edges.vertices)
                           _box.expandBy(v.x, v.y, v.z);
                       warnOnce(source, _edges.notFinite,
                                "a coordinate is infinite or not a number");
                       warnOnce(source, _badIndices, "an index is beyond the vertices");
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
