// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Node>

namespace osgLabels
{

/// Why a node, with all that is below, can't be part of a chunk; null if nothing is in the way.
///
/// Looks at the node itself and its StateSet: a plain group, a transform of the two usual kinds or
/// a plain Geometry without callbacks and a node mask, that is not said to change.
const char* whyNotChunked(const osg::Node& node);

} // namespace osgLabels
