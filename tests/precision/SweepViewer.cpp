// SPDX-License-Identifier: MIT
#include <precision/SweepViewer.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace precision
{

SweepViewer::SweepViewer()
{
    if (!_viewer.isValid())
        throw std::runtime_error(_viewer.getError());
    _viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
}

osg::Image& SweepViewer::clear(osg::Camera& camera)
{
    osg::Image& picture = *camera.getBufferAttachmentMap()[osg::Camera::COLOR_BUFFER]._image;
    std::fill_n(reinterpret_cast<float*>(picture.data()), picture.getTotalSizeInBytes() / 4,
                std::nanf(""));
    return picture;
}

} // namespace precision
