// SPDX-License-Identifier: MIT
#include <osgLabels/PrimitiveRun.h>

#include "PixelScale.h"
#include "PrimitiveMeshes.h"

#include <osgUtil/LineSegmentIntersector>

#include <algorithm>
#include <typeinfo>

namespace osgLabels
{

namespace
{

osg::BoundingBox boxOf(const ObjectRecord& record)
{
    const ShapeBox box = localBox(record);
    return {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
}

/// Gives a functor the triangles of one object after the other.
class Expansion
{
public:
    Expansion(const UnitMesh& mesh, osg::PrimitiveFunctor& functor)
        : _mesh(mesh), _functor(functor), _vertices(mesh.points.size())
    {
    }

    void add(const ObjectRecord& record)
    {
        for (std::size_t i = 0; i < _vertices.size(); ++i)
        {
            const glm::vec3 p = placePoint(record, _mesh.points[i]).position;
            _vertices[i].set(p.x, p.y, p.z);
        }
        _functor.setVertexArray(static_cast<unsigned int>(_vertices.size()), _vertices.data());
        _functor.drawElements(GL_TRIANGLES, static_cast<GLsizei>(_mesh.triangles.size()),
                              _mesh.triangles.data());
    }

private:
    const UnitMesh& _mesh;
    osg::PrimitiveFunctor& _functor;
    std::vector<osg::Vec3> _vertices;
};

/// One object of a run, as an intersector sees it.
class SingleObject : public osg::Drawable
{
public:
    explicit SingleObject(const UnitMesh& mesh) : _mesh(mesh) {}

    void set(const ObjectRecord& record)
    {
        _record = record;
        dirtyBound();
    }

    bool supports(const osg::PrimitiveFunctor&) const override { return true; }
    void accept(osg::PrimitiveFunctor& functor) const override
    {
        Expansion(_mesh, functor).add(_record);
    }
    osg::BoundingBox computeBoundingBox() const override { return boxOf(_record); }

private:
    const UnitMesh& _mesh;
    ObjectRecord _record;
};

using Segment = osgUtil::LineSegmentIntersector;

/// OSG keeps to itself what takes a visitor's segment to local coordinates.
class SegmentFrame : public Segment
{
public:
    static osg::Matrixd toLocal(osgUtil::IntersectionVisitor& visitor, const Segment& segment)
    {
        return getTransformation(visitor, segment.getCoordinateFrame());
    }
};

/// Hits of `single` become hits of `run`, with triangles counted over the whole run.
void rename(Segment::Intersections& hits, const osg::Drawable& single, osg::Drawable& run,
            unsigned int triangles)
{
    for (auto hit = hits.begin(); hit != hits.end();)
    {
        if (hit->drawable != &single)
        {
            ++hit;
            continue;
        }
        Segment::Intersection renamed = *hit;
        renamed.drawable = &run;
        renamed.primitiveIndex += triangles;
        hit = hits.erase(hit);
        hits.insert(renamed);
    }
}

/// Whether a segment, as start and difference, meets a box.
bool meets(const osg::Vec3d& start, const osg::Vec3d& along, const osg::BoundingBox& box)
{
    double from = 0.0, to = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
        double a = box._min[axis] - start[axis], b = box._max[axis] - start[axis];
        if (along[axis] == 0.0)
        {
            if (a > 0.0 || b < 0.0)
                return false;
            continue;
        }
        a /= along[axis];
        b /= along[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    // Rounding must not lose a box that is touched.
    return from <= to + 1e-6;
}

} // namespace

PrimitiveRun::PrimitiveRun(RecordPage* page, unsigned int first, unsigned int count,
                           unsigned int firstObject)
    : _page(page), _shape(count ? shapeOf(page->getRecord(first)) : Shape::None), _first(first),
      _count(count), _firstObject(firstObject)
{
    setUseDisplayList(false);
    setUseVertexBufferObjects(true);
    if (count)
        _meshes = PrimitiveMeshes::of(kindOf(page->getRecord(first)));
    findCurves();
}

PrimitiveRun::PrimitiveRun(const PrimitiveRun& other, const osg::CopyOp& copyop)
    : osg::Drawable(other, copyop), _page(other._page), _meshes(other._meshes),
      _curves(other._curves), _shape(other._shape), _first(other._first), _count(other._count),
      _firstObject(other._firstObject), _level(other._level)
{
}

PrimitiveRun::PrimitiveRun() = default;

PrimitiveRun::~PrimitiveRun() = default;

unsigned int PrimitiveRun::getNumTriangles() const
{
    return _meshes ? static_cast<unsigned int>(_meshes->visitorMesh().triangles.size() / 3) : 0;
}

unsigned int PrimitiveRun::getObject(unsigned int primitiveIndex) const
{
    const unsigned int triangles = getNumTriangles();
    return _firstObject + (triangles ? std::min(primitiveIndex / triangles, _count - 1) : 0);
}

/// Steps of a quarter: few, and no object is drawn much finer than it has to be.
void PrimitiveRun::findCurves()
{
    float largest = -1.0f, step = -1.0f;
    for (unsigned int i = _count; i-- > 0;)
    {
        largest = std::max(largest, curveOf(getRecord(i)));
        if (largest > step)
        {
            step = 1.25f * largest;
            _curves.push_back({i, step});
        }
        _curves.back().first = i;
    }
    std::reverse(_curves.begin(), _curves.end());
}

void PrimitiveRun::forEachRange(const PixelScale& scale,
                                const std::function<void(const Range&)>& draw) const
{
    if (!_count)
        return;
    if (_level >= 0)
        return draw({0, _count, std::min(_level, _meshes->size() - 1)});
    const osg::BoundingSphere& bound = getBound();
    if (scale.isNear(bound.center(), bound.radius()))
        forEachNear(scale, draw);
    else
        forEachFar(scale, draw);
}

/// All objects as if they were where the run is closest to the eye.
void PrimitiveRun::forEachFar(const PixelScale& scale,
                              const std::function<void(const Range&)>& draw) const
{
    const osg::BoundingSphere& bound = getBound();
    const double pixels =
        scale.at(scale.depthOf(bound.center()) + bound.radius() * scale.eyeScale());
    unsigned int end = _count, low = 0;
    while (low < end) // the first object that is too small to be seen
    {
        const unsigned int middle = (low + end) / 2;
        if (reachOf(getRecord(middle)) * pixels < scale.getSmallest())
            end = middle;
        else
            low = middle + 1;
    }
    Range range{0, 0, 0};
    for (std::size_t i = 0; i < _curves.size() && _curves[i].first < end; ++i)
    {
        const unsigned int next = i + 1 < _curves.size() ? _curves[i + 1].first : _count;
        const int level =
            std::min(levelFor(float(_curves[i].radius * pixels)), _meshes->size() - 1);
        if (range.count && level != range.level)
        {
            draw(range);
            range = {range.first + range.count, 0, level};
        }
        range.level = level;
        range.count = std::min(next, end) - range.first;
    }
    if (range.count)
        draw(range);
}

/// Each object by where it is itself.
void PrimitiveRun::forEachNear(const PixelScale& scale,
                               const std::function<void(const Range&)>& draw) const
{
    Range range{0, 0, 0};
    for (unsigned int i = 0; i < _count; ++i)
    {
        const ObjectRecord record = getRecord(i);
        const double reach = reachOf(record);
        const osg::Vec3d center(record.origin.x, record.origin.y, record.origin.z);
        const double pixels = scale.at(scale.depthOf(center) + reach * scale.eyeScale());
        const bool drawn =
            !scale.isOutside(center, reach) && !(reach * pixels < scale.getSmallest());
        const float curve = curveOf(record);
        const int level = curve > 0.0f ? levelFor(float(curve * pixels)) : 0;
        if (range.count && (!drawn || level != range.level))
        {
            draw(range);
            range.count = 0;
        }
        if (!drawn)
            continue;
        if (!range.count)
            range = {i, 0, level};
        ++range.count;
    }
    if (range.count)
        draw(range);
}

void PrimitiveRun::accept(osg::NodeVisitor& visitor)
{
    auto* intersections = dynamic_cast<osgUtil::IntersectionVisitor*>(&visitor);
    auto* segment =
        intersections ? dynamic_cast<Segment*>(intersections->getIntersector()) : nullptr;
    // Others, and subclasses that see triangles in their own way, get all triangles.
    if (!segment || typeid(*segment) != typeid(Segment) || !visitor.validNodeMask(*this))
    {
        if (visitor.validNodeMask(*this))
        {
            visitor.pushOntoNodePath(this);
            visitor.apply(*this);
            visitor.popFromNodePath();
        }
        return;
    }
    visitor.pushOntoNodePath(this);
    const osg::Matrixd toLocal = SegmentFrame::toLocal(*intersections, *segment);
    const osg::Vec3d start = segment->getStart() * toLocal;
    const osg::Vec3d along = segment->getEnd() * toLocal - start;
    const osg::ref_ptr<SingleObject> single = new SingleObject(_meshes->visitorMesh());
    for (unsigned int i = 0; meets(start, along, getBoundingBox()) && i < _count; ++i)
    {
        const ObjectRecord record = getRecord(i);
        if (!meets(start, along, boxOf(record)))
            continue;
        single->set(record);
        intersections->apply(static_cast<osg::Drawable&>(*single));
        rename(segment->getIntersections(), *single, *this, i * getNumTriangles());
    }
    visitor.popFromNodePath();
}

void PrimitiveRun::accept(osg::PrimitiveFunctor& functor) const
{
    if (!_count)
        return;
    Expansion expansion(_meshes->visitorMesh(), functor);
    for (unsigned int i = 0; i < _count; ++i)
        expansion.add(getRecord(i));
}

osg::BoundingBox PrimitiveRun::computeBoundingBox() const
{
    osg::BoundingBox box;
    for (unsigned int i = 0; i < _count; ++i)
        box.expandBy(boxOf(getRecord(i)));
    return box;
}

} // namespace osgLabels
