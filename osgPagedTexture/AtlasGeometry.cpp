// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasGeometry.h>

#include <osgPagedTexture/ArrayPoint.h>
#include <osgPagedTexture/CellSplit.h>
#include <osgPagedTexture/MixedArrays.h>

#include <osg/TriangleIndexFunctor>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

namespace osgPagedTexture
{

namespace
{

/// Why a geometry stays as it is.
class Left : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// osg::TriangleIndexFunctor makes its own object of the class that it is given.
struct TriangleList
{
    std::vector<std::array<unsigned int, 3>>* triangles = nullptr;
    void operator()(unsigned int a, unsigned int b, unsigned int c) const
    {
        triangles->push_back({a, b, c});
    }
};

bool isFinite(const glm::dvec2& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y);
}

bool isOfTriangles(GLenum mode)
{
    return mode != GL_POINTS && mode != GL_LINES && mode != GL_LINE_STRIP && mode != GL_LINE_LOOP &&
           mode <= GL_POLYGON;
}

class Mover
{
public:
    Mover(const osg::Geometry& geometry, const GeometryPhoto& photo, const AtlasPlaces& places,
          std::int64_t mostRepeats)
        : _coordinates(*geometry.getTexCoordArray(0)), _photo(photo), _places(places),
          _mostRepeats(mostRepeats), _vertexCount(geometry.getVertexArray()->getNumElements())
    {
    }

    osg::ref_ptr<osg::PrimitiveSet> move(const osg::PrimitiveSet& set)
    {
        if (!isOfTriangles(set.getMode()))
            return moveWhole(set);
        std::vector<std::array<unsigned int, 3>> triangles;
        osg::TriangleIndexFunctor<TriangleList> list;
        list.triangles = &triangles;
        set.accept(list);
        osg::ref_ptr<osg::DrawElementsUInt> moved = new osg::DrawElementsUInt(GL_TRIANGLES);
        for (const auto& triangle : triangles)
            moveTriangle(triangle, *moved);
        counts.triangles += triangles.size();
        counts.written += moved->size() / 3;
        return moved;
    }

    std::vector<MixedVertex> vertices;
    std::vector<glm::dvec2> placed; ///< Coordinates of the vertices in the atlas.
    GeometryCounts counts;

private:
    using Key = std::tuple<unsigned int, std::int64_t, std::int64_t, std::size_t>;

    glm::dvec2 read(unsigned int index) const
    {
        const bool same = _coordinates.getBinding() == osg::Array::BIND_OVERALL;
        if (index >= _vertexCount || (!same && index >= _coordinates.getNumElements()))
            throw Left("an index is beyond the end of its arrays");
        const glm::dvec3 point = pointOf(_coordinates, same ? 0 : index);
        osg::Vec4d turned(point.x, point.y, point.z, 1.0);
        if (!_photo.toTexture.isIdentity())
            turned = turned * _photo.toTexture;
        // A texture without a matrix is looked up by floats, so those of one with a matrix are too.
        const glm::dvec2 coordinate(float(turned.x() / turned.w()), float(turned.y() / turned.w()));
        return coordinate;
    }

    glm::dvec2 inPhoto(const glm::dvec2& coordinate, std::int64_t cellS, std::int64_t cellT) const
    {
        return glm::clamp(glm::dvec2(wrapIntoPhoto(coordinate.x, cellS, _photo.wrapS),
                                     wrapIntoPhoto(coordinate.y, cellT, _photo.wrapT)),
                          0.0, 1.0);
    }

    unsigned int add(const MixedVertex& vertex, std::size_t photo, const glm::dvec2& point)
    {
        vertices.push_back(vertex);
        placed.push_back(_places.place(photo, point));
        return static_cast<unsigned int>(vertices.size() - 1);
    }

    void moveTriangle(const std::array<unsigned int, 3>& triangle, osg::DrawElementsUInt& moved)
    {
        std::array<glm::dvec2, 3> corners;
        bool finite = true;
        for (std::size_t i = 0; i < 3; ++i)
        {
            corners[i] = read(triangle[i]);
            finite = finite && isFinite(corners[i]);
        }
        if (!finite)
            return addNowhere(triangle, moved);
        const std::vector<CellPart> parts =
            splitAtCells(corners, _photo.wrapS, _photo.wrapT, _mostRepeats);
        if (parts.empty())
            throw Left("a triangle repeats it more than " + std::to_string(_mostRepeats) +
                       " times");
        counts.split += parts.size() > 1;
        for (const CellPart& part : parts)
            addPart(triangle, part, moved);
    }

    /// What no texture can show right has the photograph's first pixel.
    void addNowhere(const std::array<unsigned int, 3>& triangle, osg::DrawElementsUInt& moved)
    {
        ++counts.notFinite;
        for (unsigned int index : triangle)
            moved.push_back(nowhere(index));
    }

    unsigned int nowhere(unsigned int index)
    {
        constexpr std::int64_t NoCell = std::numeric_limits<std::int64_t>::min();
        const std::size_t photo = _photo.pieces->front();
        return whole(index, NoCell, NoCell, photo, _places.firstPixel(photo));
    }

    void addPart(const std::array<unsigned int, 3>& triangle, const CellPart& part,
                 osg::DrawElementsUInt& moved)
    {
        std::vector<glm::dvec2> points;
        glm::dvec2 low(1.0), high(0.0);
        for (const SplitPoint& point : part.points)
        {
            points.push_back(inPhoto(point.coordinate, part.cellS, part.cellT));
            low = glm::min(low, points.back());
            high = glm::max(high, points.back());
        }
        const std::size_t piece = _places.pieceOf(*_photo.pieces, low, high);
        if (piece == _photo.pieces->size())
            throw Left("the layout has no piece of it that holds a triangle; make the layout anew");
        std::vector<unsigned int> indices;
        for (std::size_t i = 0; i < points.size(); ++i)
            indices.push_back(vertexOf(triangle, part, i, (*_photo.pieces)[piece], points[i]));
        for (std::size_t i = 2; i < indices.size(); ++i)
        {
            moved.push_back(indices[0]);
            moved.push_back(indices[i - 1]);
            moved.push_back(indices[i]);
        }
    }

    /// A vertex of the model stays one for all triangles of its cell.
    unsigned int vertexOf(const std::array<unsigned int, 3>& triangle, const CellPart& part,
                          std::size_t number, std::size_t photo, const glm::dvec2& point)
    {
        const MixedVertex vertex{triangle, part.points[number].weights};
        for (int i = 0; i < 3; ++i)
            if (vertex.weights[i] == 1.0)
                return whole(triangle[std::size_t(i)], part.cellS, part.cellT, photo, point);
        return add(vertex, photo, point);
    }

    unsigned int whole(unsigned int index, std::int64_t cellS, std::int64_t cellT,
                       std::size_t photo, const glm::dvec2& point)
    {
        const auto [place, isNew] = _known.insert({Key(index, cellS, cellT, photo), 0});
        if (isNew)
            place->second = add({{index, index, index}}, photo, point);
        return place->second;
    }

    osg::ref_ptr<osg::PrimitiveSet> moveWhole(const osg::PrimitiveSet& set)
    {
        osg::ref_ptr<osg::DrawElementsUInt> moved = new osg::DrawElementsUInt(set.getMode());
        for (unsigned int i = 0; i < set.getNumIndices(); ++i)
        {
            const glm::dvec2 coordinate = read(set.index(i));
            if (!isFinite(coordinate))
            {
                moved->push_back(nowhere(set.index(i)));
                continue;
            }
            const WrapRun s = wrapRunOf(coordinate.x, coordinate.x, _photo.wrapS);
            const WrapRun t = wrapRunOf(coordinate.y, coordinate.y, _photo.wrapT);
            const glm::dvec2 point = inPhoto(coordinate, s.first, t.first);
            std::size_t piece = _places.pieceOf(*_photo.pieces, point, point);
            if (piece == _photo.pieces->size())
                piece = 0; // Pieces are made of triangles.
            moved->push_back(whole(set.index(i), s.first, t.first, (*_photo.pieces)[piece], point));
        }
        return moved;
    }

    const osg::Array& _coordinates;
    const GeometryPhoto& _photo;
    const AtlasPlaces& _places;
    const std::int64_t _mostRepeats;
    const unsigned int _vertexCount;
    std::map<Key, unsigned int> _known;
};

void setCoordinates(osg::Geometry& geometry, const std::vector<glm::dvec2>& placed,
                    const AtlasLayout& layout, GeometryCounts& counts)
{
    osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array(osg::Array::BIND_PER_VERTEX);
    coordinates->reserve(placed.size());
    const glm::dvec2 size(double(layout.width), double(layout.height));
    for (const glm::dvec2& point : placed)
    {
        const glm::vec2 rounded(point);
        coordinates->push_back({rounded.x, rounded.y});
        const glm::dvec2 error = glm::abs(glm::dvec2(rounded) - point) * size;
        counts.largestRounding = std::max({counts.largestRounding, error.x, error.y});
    }
    geometry.setTexCoordArray(0, coordinates);
}

} // namespace

std::string moveGeometry(osg::Geometry& geometry, const GeometryPhoto& photo,
                         const AtlasPlaces& places, const AtlasLayout& layout,
                         std::int64_t mostRepeats, GeometryCounts& counts)
{
    if (geometry.containsDeprecatedData())
        geometry.fixDeprecatedData();
    if (!isReadable(geometry.getTexCoordArray(0), false) ||
        !isReadable(geometry.getVertexArray(), true))
        return "a drawable has no coordinates for it";
    Mover mover(geometry, photo, places, mostRepeats);
    osg::Geometry::PrimitiveSetList moved;
    try
    {
        for (const osg::ref_ptr<osg::PrimitiveSet>& set : geometry.getPrimitiveSetList())
            moved.push_back(mover.move(*set));
    }
    catch (const Left& reason)
    {
        return reason.what();
    }
    replaceVertices(geometry, mover.vertices);
    setCoordinates(geometry, mover.placed, layout, mover.counts);
    geometry.setPrimitiveSetList(moved);
    geometry.dirtyGLObjects();
    geometry.dirtyBound();
    counts.triangles += mover.counts.triangles;
    counts.split += mover.counts.split;
    counts.written += mover.counts.written;
    counts.notFinite += mover.counts.notFinite;
    counts.largestRounding = std::max(counts.largestRounding, mover.counts.largestRounding);
    return {};
}

} // namespace osgPagedTexture
