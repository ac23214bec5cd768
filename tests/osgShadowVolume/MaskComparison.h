// SPDX-License-Identifier: MIT
#pragma once

#include "ShadowTruth.h"

#include <osg/Image>

#include <string>
#include <vector>

namespace truth
{

/// What a pixel of a mask is, by how its answer is to be judged.
enum class Zone : std::uint8_t
{
    NOTHING, ///< The background, away from any edge.
    BAND,    ///< Within a pixel of an edge of a shadow or an object.
    GRAZING, ///< |N.L| < 0.02.
    OTHER
};

/// A mask beside the truth. Pixels outside a spot's cone count as right if they are not background.
struct MaskDifference
{
    unsigned int object = 0;       ///< Pixels that show an object.
    unsigned int band = 0;         ///< Of these and of the background beside them.
    unsigned int grazing = 0;      ///< |N.L| < 0.02, not in the band.
    unsigned int shadowed = 0;     ///< By the truth.
    unsigned int wrongBand = 0;    ///< Wrong, within a pixel of an edge of the truth.
    unsigned int wrongGrazing = 0; ///< Wrong at grazing light.
    /// Wrong, proved to lie within one depth quantum or the rasterizer's snapping of corners.
    unsigned int withinQuantum = 0;
    /// Wrong, and right for a light on the other side of a plane in which it lies but for rounding.
    unsigned int withinRounding = 0;
    unsigned int leaks = 0;                      ///< Wrong, all others.
    std::vector<std::pair<int, int>> leakPixels; ///< The first hundred.

    double getBandShare() const { return object ? double(band) / object : 0.0; }
    /// Wrong pixels of the object's.
    double getErrorShare() const;
};

/// Compares a mask (white lit, black shadowed, any other colour background), and appends to
/// `wrong` for each pixel 0 right, 1 wrong but excused, 2 leak.
MaskDifference compareMask(const osg::Image& mask, const ShadowTruth& truth, const Light& light,
                           const std::vector<Sample>& samples,
                           std::vector<unsigned char>* wrong = nullptr);

/// The zones of a picture of the truth.
std::vector<Zone> zonesOf(const std::vector<Sample>& samples, int width, int height);

/// Share of the object's pixels that lie in the band.
double bandShare(const std::vector<Sample>& samples, int width, int height);

/// The truth as a mask, on the given background.
osg::ref_ptr<osg::Image> toImage(const std::vector<Sample>& samples, int width, int height);

/// Writes <name>.{truth,mask,leaks}.png; returns where.
std::string writePictures(const osg::Image& mask, const std::vector<Sample>& samples,
                          const std::vector<unsigned char>& wrong, const std::string& name);

} // namespace truth
