// SPDX-License-Identifier: MIT
#pragma once

#include <CoveragePage.h>

#include <osg/StateAttribute>

#include <string>
#include <vector>

namespace precision
{

/// A way to look a letter's coverage up, to compare coverage.glsl with.
struct LabelMethod
{
    std::string name;
    std::string source;                       ///< GLSL, as CoveragePage::makeNode() takes it.
    osg::ref_ptr<osg::StateAttribute> images; ///< On unit 0, sampler `images`; may be null.
};

/// What labels have been drawn with: nearest, alpha test, bilinear, trilinear, distance fields and
/// summed areas.
std::vector<LabelMethod> makeLabelMethods(const osgLabels::GlyphSet& glyphs);

} // namespace precision
