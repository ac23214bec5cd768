// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Object>

namespace osgShadowVolume
{

/// Whether a node, drawable or light says that it casts no shadow: a user value `castShadow` of
/// false, 0, "false" or "0", or a description "castShadow=0".
bool saysNoShadow(const osg::Object& object);

} // namespace osgShadowVolume
