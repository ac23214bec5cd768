// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

#include <vector>

namespace precision
{

/// What encoders of blocks are measured on. RGB, sides that are multiples of 4.
enum class EncoderSubject
{
    Photographs, ///< Of Debian's wallpapers, the middle of each; procedural ones for what is
                 ///< missing.
    NormalMaps,
    LineArt
};

std::vector<osgPagedTexture::Pixels> makeEncoderSamples(EncoderSubject subject);

/// Sum of the squared differences over RGB.
double squaredError(const osgPagedTexture::Pixels& a, const osgPagedTexture::Pixels& b);

/// Structural similarity of the luma (Wang et al. 2004), mean over windows of 8x8 every 4 texels.
double similarity(const osgPagedTexture::Pixels& a, const osgPagedTexture::Pixels& b);

} // namespace precision
