// SPDX-License-Identifier: MIT
#include <osgLabels/FaceRooms.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace osgLabels
{

namespace
{

constexpr int Half = int(FittedShape::FullRoom), Side = 2 * Half; // cells
constexpr int LeastRoom = Half / 5;
const double FoldCosine = std::cos(glm::radians(40.0));

/// What is labelled from a face leans by at most 54.7 degrees, which is a slope of 1.42: what falls
/// off faster between cells is a step.
constexpr double StepSlope = 1.75;

/// A face of the box, as it is seen from outside, in cells.
class FaceGrid
{
public:
    /// `size`: half extents along the face's first, second and outward axis.
    explicit FaceGrid(const glm::dvec3& size) : _size(size), _cells(Side * Side) {}

    /// Corners by the face's axes, in shares of the half extents; the last one grows outwards.
    void draw(const glm::dvec3 corners[3], const glm::dvec3& normal, bool isOwn)
    {
        const glm::dvec2 a(corners[0]), ab = glm::dvec2(corners[1]) - a;
        const glm::dvec2 ac = glm::dvec2(corners[2]) - a;
        const double area = ab.x * ac.y - ab.y * ac.x;
        if (std::abs(area) < 1e-12)
            return;
        int low[2], high[2];
        for (int i = 0; i < 2; ++i)
        {
            const auto [least, most] = std::minmax({corners[0][i], corners[1][i], corners[2][i]});
            low[i] = std::max(0, int(std::floor((least + 1.0) * Half - 0.5)));
            high[i] = std::min(Side - 1, int(std::ceil((most + 1.0) * Half - 0.5)));
        }
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x)
            {
                const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) / double(Half) - 1.0 - a;
                const double s = (p.x * ac.y - p.y * ac.x) / area;
                const double t = (ab.x * p.y - ab.y * p.x) / area;
                if (s < -1e-6 || t < -1e-6 || s + t > 1.0 + 2e-6)
                    continue;
                const double out = corners[0].z + s * (corners[1].z - corners[0].z) +
                                   t * (corners[2].z - corners[0].z);
                Cell& cell = _cells[std::size_t(y * Side + x)];
                if (out > cell.out + 1e-9)
                    cell = {out, normal, isOwn};
                _isEmpty = false;
            }
    }

    /// Of the largest rectangle without a fault; Half for a face that is not there.
    int room() const
    {
        if (_isEmpty)
            return Half;
        int room = Half;
        for (int y = 0; y < Side; ++y)
            for (int x = 0; x < Side; ++x)
                if (!isGood(x, y))
                    room = std::min(room, std::max(fromMiddle(x), fromMiddle(y)));
        return room < LeastRoom ? 0 : room;
    }

private:
    struct Cell
    {
        double out = -std::numeric_limits<double>::infinity();
        glm::dvec3 normal{0.0};
        bool isOwn = false;
    };

    /// Whole cells between it and the middle.
    static int fromMiddle(int x) { return x < Half ? Half - 1 - x : x - Half; }

    const Cell& at(int x, int y) const { return _cells[std::size_t(y * Side + x)]; }

    /// Whether the surface goes on from the cell to all that touch it, so that its corners are
    /// covered, too.
    bool isGood(int x, int y) const
    {
        for (int j = std::max(0, y - 1); j <= std::min(Side - 1, y + 1); ++j)
            for (int i = std::max(0, x - 1); i <= std::min(Side - 1, x + 1); ++i)
                if (!at(i, j).isOwn || !continues(at(x, y), at(i, j), glm::dvec2(i - x, j - y)))
                    return false;
        return true;
    }

    bool continues(const Cell& from, const Cell& to, const glm::dvec2& cells) const
    {
        const double step = std::abs(to.out - from.out) * _size.z;
        const double way = glm::length(cells * glm::dvec2(_size)) / Half;
        // Whichever way facets are wound.
        return std::abs(glm::dot(from.normal, to.normal)) > FoldCosine &&
               step <= StepSlope * way + 1e-3 * _size.z;
    }

    const glm::dvec3 _size;
    std::vector<Cell> _cells;
    bool _isEmpty = true;
};

} // namespace

glm::uvec3 faceRooms(const FitMesh& mesh, const FittedShape& shape)
{
    const glm::dmat3 frame = glm::mat3_cast(shape.rotation);
    const glm::dvec3 moved = frame * (mesh.center - shape.origin);
    const glm::dvec3 size = glm::max(shape.size, glm::dvec3(1e-9 * mesh.scale));
    glm::uvec3 rooms(0);
    for (int axis = 0; axis < 3; ++axis)
    {
        const int order[] = {(axis + 1) % 3, (axis + 2) % 3, axis};
        const glm::dvec3 sides(size[order[0]], size[order[1]], size[order[2]]);
        int room = Half;
        for (const double sign : {-1.0, 1.0})
        {
            FaceGrid grid(sides);
            for (const FitMesh::Facet& facet : mesh.facets)
            {
                const glm::dvec3 normal = frame * facet.normal, n = glm::abs(normal);
                glm::dvec3 corners[3];
                for (int i = 0; i < 3; ++i)
                {
                    const glm::dvec3 p =
                        frame * (mesh.scale * mesh.points[facet.corners[i]]) + moved;
                    corners[i] = {p[order[0]] / sides.x, p[order[1]] / sides.y,
                                  sign * p[order[2]] / sides.z};
                }
                grid.draw(corners, normal, n[axis] >= std::max(n[order[0]], n[order[1]]) - 1e-6);
            }
            room = std::min(room, grid.room());
        }
        rooms[axis] = unsigned(room);
    }
    return rooms;
}

} // namespace osgLabels
