// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SoonCollector.h>

#include <osg/Camera>
#include <osg/Transform>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

SoonCollector::SoonCollector(const Pager& pager, SurfaceCache& cache, const TexelView& view,
                             const osg::Matrixd& projection, const osg::Matrixd& toEye)
    : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), _pager(pager), _cache(cache),
      _view(view), _toEye{toEye}, _bound(1)
{
    _view.moved = glm::dvec3(0.0);
    // Left, right, bottom and top: w + x, w - x, w + y, w - y of what the projection makes.
    for (int i = 0; i < 4; ++i)
    {
        const int row = i / 2;
        const double sign = i % 2 ? -1.0 : 1.0;
        for (int c = 0; c < 4; ++c)
            _sides[i][c] = projection(c, 3) + sign * projection(c, row);
        _sides[i] /=
            std::max(1e-300, osg::Vec3d(_sides[i][0], _sides[i][1], _sides[i][2]).length());
    }
}

bool SoonCollector::isInView(const osg::BoundingSphere& bound) const
{
    if (!bound.valid())
        return false;
    const osg::Matrixd& m = _toEye.back();
    const osg::Vec3d center = osg::Vec3d(bound.center()) * m;
    double scale = 0.0;
    for (int i = 0; i < 3; ++i)
        scale = std::max(scale, osg::Vec3d(m(i, 0), m(i, 1), m(i, 2)).length());
    const double radius = bound.radius() * scale;
    return std::all_of(std::begin(_sides), std::end(_sides),
                       [&](const osg::Vec4d& side) {
                           return side[0] * center[0] + side[1] * center[1] + side[2] * center[2] +
                                      side[3] >
                                  -radius;
                       });
}

void SoonCollector::apply(osg::Node& node)
{
    if (node.isCullingActive() && !isInView(node.getBound()))
        return;
    const osg::StateSet* stateSet = node.getStateSet();
    const bool isBinding = stateSet && stateSet->getNumTextureAttributeLists() > 0;
    if (isBinding)
    {
        _bound.push_back(_bound.back());
        _bound.back().take(*stateSet, _pager);
    }
    traverse(node);
    if (isBinding)
        _bound.pop_back();
}

void SoonCollector::apply(osg::Drawable& drawable)
{
    if (drawable.isCullingActive() && !isInView(drawable.getBound()))
        return;
    BoundTextures bound = _bound.back();
    if (drawable.getStateSet())
        bound.take(*drawable.getStateSet(), _pager);
    if (bound.get().empty())
        return;
    _view.toEye = glm::make_mat4(_toEye.back().ptr());
    for (const BoundTexture& each : bound.get())
        _demands.push_back(
            {each.texture, 0.0, std::max(bound.pixels(each, drawable, _view, _cache), 1e-12)});
}

void SoonCollector::apply(osg::Transform& transform)
{
    // Those that hang on the eye go with it: they are in view already.
    if (transform.getReferenceFrame() != osg::Transform::RELATIVE_RF)
        return;
    osg::Matrixd matrix = _toEye.back();
    transform.computeLocalToWorldMatrix(matrix, this);
    const bool isOut = transform.isCullingActive() && !isInView(transform.getBound());
    if (isOut)
        return;
    _toEye.push_back(matrix);
    const osg::StateSet* stateSet = transform.getStateSet();
    _bound.push_back(_bound.back());
    if (stateSet)
        _bound.back().take(*stateSet, _pager);
    traverse(transform);
    _bound.pop_back();
    _toEye.pop_back();
}

/// What a camera of its own sees is not what this one will see.
void SoonCollector::apply(osg::Camera&) {}

float SoonCollector::getDistanceToViewPoint(const osg::Vec3& place, bool) const
{
    return float((osg::Vec3d(place) * _toEye.back()).length());
}

float SoonCollector::getDistanceToEyePoint(const osg::Vec3& place, bool scaled) const
{
    return getDistanceToViewPoint(place, scaled);
}

osg::Vec3 SoonCollector::getEyePoint() const
{
    return osg::Vec3d() * osg::Matrixd::inverse(_toEye.back());
}

} // namespace osgPagedTexture
