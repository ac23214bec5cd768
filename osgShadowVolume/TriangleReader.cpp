// SPDX-License-Identifier: MIT
#include <osgShadowVolume/TriangleReader.h>

#include <osg/Geometry>
#include <osg/TriangleFunctor>
#include <osg/TriangleIndexFunctor>

#include <glm/gtc/type_ptr.hpp>

#include <type_traits>
#include <vector>

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

struct UseIndexed
{
    const UseTriangle* use = nullptr;
    const std::vector<glm::vec3>* points = nullptr;
    std::size_t bad = 0;

    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        const std::size_t size = points->size();
        if (a < size && b < size && c < size)
            (*use)((*points)[a], (*points)[b], (*points)[c]);
        else
            ++bad;
    }
};

/// Triangles of primitives, with the quads of strips divided as Mesa draws them: along the diagonal
/// from the first corner to the fourth, not along the other one, which OSG's functor takes.
class ReadTriangles : public osg::TriangleIndexFunctor<UseIndexed>
{
public:
    void drawArrays(GLenum mode, GLint first, GLsizei count) override
    {
        if (mode == GL_QUAD_STRIP)
            readStrip(count, [=](GLsizei i) { return unsigned(first + i); });
        else
            osg::TriangleIndexFunctor<UseIndexed>::drawArrays(mode, first, count);
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
            osg::TriangleIndexFunctor<UseIndexed>::drawElements(mode, count, indices);
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

struct UseCorners
{
    const UseTriangle* use = nullptr;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false)
    {
        (*use)(glm::make_vec3(a.ptr()), glm::make_vec3(b.ptr()), glm::make_vec3(c.ptr()));
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

bool hasFaces(const osg::Geometry& geometry)
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

} // namespace

bool hasTriangles(const osg::Drawable& drawable)
{
    if (const osg::Geometry* geometry = drawable.asGeometry())
        return hasFaces(*geometry);
    osg::TriangleFunctor<UseCorners> functor;
    return drawable.supports(functor);
}

std::size_t readTriangles(const osg::Drawable& drawable, const UseTriangle& use)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry)
    {
        osg::TriangleFunctor<UseCorners> functor;
        functor.use = &use;
        drawable.accept(functor);
        return 0;
    }
    const osg::Array* array = vertexArrayOf(*geometry);
    if (!array)
        return 0;
    Positions positions;
    array->accept(positions);
    ReadTriangles functor;
    functor.use = &use;
    functor.points = &positions.points;
    for (unsigned int i = 0; i != geometry->getNumPrimitiveSets(); ++i)
        geometry->getPrimitiveSet(i)->accept(functor);
    return functor.bad;
}

} // namespace osgShadowVolume
