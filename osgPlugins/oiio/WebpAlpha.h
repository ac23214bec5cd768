// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

namespace osgKitsOiio
{

// OpenImageIO 2.4 converts the alpha of WebP files, which is unassociated as OSG's is, whatever it
// is asked: its reader multiplies the colours by alpha, its writer divides them by alpha in linear
// light. These undo that in 8-bit RGBA pixels, to half a step divided by alpha.

/// Divides the colours by alpha, after reading; those of alpha 0 are lost and stay 0.
void undoWebpReader(osg::Image& image);

/// Multiplies count RGBA pixels of sRGB colours by alpha in linear light, before writing.
void undoWebpWriter(unsigned char* pixels, std::size_t count);

} // namespace osgKitsOiio
