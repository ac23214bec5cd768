// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/Geometry>

namespace osgMultiRender
{

/// One triangle over the whole viewport, in clip coordinates: for full-screen passes.
OSGMULTIRENDER_EXPORT osg::ref_ptr<osg::Geometry> makeScreenTriangle();

} // namespace osgMultiRender
