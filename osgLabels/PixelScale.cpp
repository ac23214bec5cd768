// SPDX-License-Identifier: MIT
#include "PixelScale.h"

#include <osg/Camera>
#include <osg/State>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgLabels
{

PixelScale::PixelScale(const osg::Matrixd& modelView, const osg::Matrixd& projection, double width,
                       double height, double smallest)
    : _modelView(modelView), _depth(modelView(0, 2), modelView(1, 2), modelView(2, 2)),
      _depthOffset(modelView(3, 2)), _eyeScale(0.0), _perZ(projection(2, 3)),
      _atZero(projection(3, 3)), _smallest(smallest)
{
    for (int i = 0; i < 3; ++i)
    {
        const osg::Vec3d axis(modelView(i, 0), modelView(i, 1), modelView(i, 2));
        _eyeScale = std::max(_eyeScale, axis.length());
    }
    const osg::Matrixd m = modelView * projection;
    const auto column = [&m](int i) { return osg::Vec4d(m(0, i), m(1, i), m(2, i), m(3, i)); };
    for (int axis = 0; axis < 2; ++axis)
    {
        _planes[2 * axis].set(column(3) + column(axis));
        _planes[2 * axis + 1].set(column(3) - column(axis));
    }
    _planes[4].set(column(3));
    _pixels =
        0.5 * std::max(std::abs(projection(0, 0)) * width, std::abs(projection(1, 1)) * height);
}

PixelScale PixelScale::of(osg::RenderInfo& renderInfo)
{
    const osg::State& state = *renderInfo.getState();
    const osg::Camera* camera = renderInfo.getCurrentCamera();
    const osg::Viewport* viewport = state.getCurrentViewport();
    if (!viewport && camera)
        viewport = camera->getViewport();
    const bool small =
        camera && (camera->getCullingMode() & osg::CullSettings::SMALL_FEATURE_CULLING);
    return {state.getModelViewMatrix(), state.getProjectionMatrix(),
            viewport ? viewport->width() : 1000.0, viewport ? viewport->height() : 1000.0,
            small ? camera->getSmallFeatureCullingPixelSize() : 0.0};
}

double PixelScale::at(double z) const
{
    const double w = _perZ * z + _atZero;
    return w > 0.0 ? _pixels * _eyeScale / w : std::numeric_limits<double>::infinity();
}

bool PixelScale::isOutside(const osg::Vec3d& center, double radius) const
{
    for (const osg::Plane& plane : _planes)
    {
        // In an orthographic view the eye's plane is none.
        const double length = plane.getNormal().length();
        if (length > 0.0 && plane.distance(center) < -radius * length)
            return true;
    }
    return false;
}

bool PixelScale::isNear(const osg::Vec3d& center, double radius) const
{
    if (_perZ == 0.0)
        return false;
    const double distance = (center * _modelView).length();
    return 2.0 * radius * _eyeScale > distance;
}

} // namespace osgLabels
