// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <string>

namespace osgShadowVolume
{

/// A colour for a value from 0 to 1 (what lies outside counts as the nearer end): from dark violet
/// over blue and green to yellow. In CIELAB its lightness rises evenly and its hue turns evenly, so
/// that what looks brighter is more, in print without colours too. sRGB, 0 to 1.
OSGSHADOWVOLUME_EXPORT glm::vec3 falseColor(double value);

/// GLSL that defines vec3 osgsv_falseColor(float value), the same.
std::string falseColorSource();

/// The smallest of 1, 2, 5, 10, … times a power of ten that is at least `value`; 1 for values that
/// are not above 0.
OSGSHADOWVOLUME_EXPORT double roundUp(double value);

} // namespace osgShadowVolume
