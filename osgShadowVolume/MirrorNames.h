// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <osg/Node>

#include <optional>
#include <string>

namespace osgShadowVolume
{

/// Reflectivity of a mirror that says none: silvered glass.
constexpr double DefaultReflectivity = 0.8;

/// The share of light, 0 to 1, that a name says is reflected; empty for any other name.
///
/// "mirror", in small or capital letters, at its head, and then:
///
/// - a number with a point, or after "=": the share: "Mirror0.3", "mirror=1"
/// - two or three digits: per cent, for formats whose names have no points: "mirror30"
/// - anything else but a letter, or nothing: DefaultReflectivity: "mirror", "mirror_hall",
/// "Mirror2"
///
/// A number over 1 (or 100) says nothing.
OSGSHADOWVOLUME_EXPORT std::optional<double> reflectivityOfName(const std::string& name);

/// What a node says of itself and of what is below.
struct MirrorMark
{
    double reflectivity = 0.0;
    bool byMaterial = false; ///< Another material below takes it away.
};

/// What one node, which may be a Drawable, says. The first of these counts:
///
/// - its user value `mirror`: a number from 0 to 1, a bool, or a string that holds a number
/// - its description "mirror=<number>"
/// - the user value `mirror` of its StateSet
/// - its name, as reflectivityOfName()
/// - the name of the material of its StateSet, likewise
OSGSHADOWVOLUME_EXPORT std::optional<MirrorMark> mirrorMarkOf(const osg::Node& node);

/// Whether the node's StateSet has a material.
bool hasMaterial(const osg::Node& node);

} // namespace osgShadowVolume
