// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>

#include <osg/Light>
#include <osg/Matrix>

namespace osgShadowVolume
{

/// A Light as GL would place it: `matrix` takes it to eye coordinates, null stands for identity.
EyeLight toEye(const osg::Light& light, const osg::Matrix* matrix);

} // namespace osgShadowVolume
