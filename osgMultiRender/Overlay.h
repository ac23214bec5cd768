// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/Projection>

namespace osgMultiRender
{

/// `content` in front of the view it is drawn in, blended and unlit, whatever the model above asks
/// for. Its coordinates are pixels, from (0, 0), the lower left corner of a view of `width` x
/// `height`. It is never culled.
OSGMULTIRENDER_EXPORT osg::ref_ptr<osg::Projection> makeOverlay(double width, double height,
                                                                osg::Node& content);

} // namespace osgMultiRender
