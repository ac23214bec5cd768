// SPDX-License-Identifier: MIT
#include "PixelScale.h"

#include <osg/Camera>
#include <osg/State>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgLabels
{

PixelScale::PixelScale(osg::RenderInfo& renderInfo)
    : _modelView(renderInfo.getState()->getModelViewMatrix())
{
    const osg::Matrixd& m = _modelView;
    const osg::Matrixd& p = renderInfo.getState()->getProjectionMatrix();
    _depth.set(m(0, 2), m(1, 2), m(2, 2));
    _depthOffset = m(3, 2);
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, osg::Vec3d(m(axis, 0), m(axis, 1), m(axis, 2)).length());
    _eyeScale = largest;
    _perZ = p(2, 3);
    _atZero = p(3, 3);
    const osg::Camera* camera = renderInfo.getCurrentCamera();
    const osg::Viewport* viewport = renderInfo.getState()->getCurrentViewport();
    if (!viewport && camera)
        viewport = camera->getViewport();
    const double width = viewport ? viewport->width() : 1000.0;
    const double height = viewport ? viewport->height() : 1000.0;
    _pixels = 0.5 * std::max(std::abs(p(0, 0)) * width, std::abs(p(1, 1)) * height);
    if (camera && (camera->getCullingMode() & osg::CullSettings::SMALL_FEATURE_CULLING))
        _smallest = camera->getSmallFeatureCullingPixelSize();
}

double PixelScale::at(double z) const
{
    const double w = _perZ * z + _atZero;
    return w > 0.0 ? _pixels * _eyeScale / w : std::numeric_limits<double>::infinity();
}

bool PixelScale::isNear(const osg::Vec3d& center, double radius) const
{
    if (_perZ == 0.0)
        return false;
    const double distance = (center * _modelView).length();
    return 2.0 * radius * _eyeScale > distance;
}

} // namespace osgLabels
