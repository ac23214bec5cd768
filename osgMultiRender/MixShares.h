// SPDX-License-Identifier: MIT
// How much of a picture each rendering has. Not installed; free of OSG and GL.
#pragma once

#include <osgMultiRender/MixBounds.h>

namespace osgMultiRender
{

/// A thing that is seen.
struct MixPart
{
    MixBox box;
    double size = 1.0; ///< Of the picture, as a share or in any unit.
};

/// The mean weight of each rendering over what is seen, 0 to 1, by places spread in the boxes, some
/// thousand in all. Parts that are not finite say nothing; without any part all have the same
/// share.
OSGMULTIRENDER_EXPORT std::vector<double>
sharesOf(const KeyPoints& points, const MixWeights& weights, const std::vector<MixPart>& parts);

} // namespace osgMultiRender
