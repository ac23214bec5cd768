// SPDX-License-Identifier: MIT
#pragma once

#include "ShadowTruth.h"

#include <osg/Image>

#include <functional>
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

/// A picture of the truth, row by row from the bottom, at the centers of the pixels.
struct TruthPicture
{
    int width = 0, height = 0;
    std::vector<Sample> samples;
    std::vector<Zone> zones;

    TruthPicture() = default;
    /// Uses all cores.
    TruthPicture(const ShadowTruth& truth, const Light& light, int width, int height);

    /// Share of the object's pixels that lie in the band.
    double getBandShare() const;
};

/// The largest channel of what the light adds to the color of a pixel where it is not taken away, 1
/// for white.
using LightColor = std::function<float(int x, int y)>;

/// What the light adds to a matte white surface, to within 0.02 of what can be seen: |N.L|.
LightColor matteWhite(const TruthPicture& picture);

/// A mask beside the truth. Pixels outside a spot's cone count as right if they are not background.
struct MaskDifference
{
    unsigned int object = 0;       ///< Pixels that show an object.
    unsigned int band = 0;         ///< Of these and of the background beside them.
    unsigned int grazing = 0;      ///< |N.L| < 0.02, not in the band.
    unsigned int shadowed = 0;     ///< By the truth.
    unsigned int wrongBand = 0;    ///< Wrong, within a pixel of an edge of the truth.
    unsigned int wrongGrazing = 0; ///< Wrong at grazing light, and colored right to 1/255.
    float worstGrazing = 0.0f;     ///< The largest error of a color among these.
    /// Wrong, proved to lie within one depth quantum or the rasterizer's snapping of corners.
    unsigned int withinQuantum = 0;
    /// Wrong, and right for a light on the other side of a plane in which it lies but for rounding.
    unsigned int withinRounding = 0;
    unsigned int leaks = 0;                      ///< Wrong, all others.
    std::vector<std::pair<int, int>> leakPixels; ///< The first hundred.

    double getBandShare() const { return object ? double(band) / object : 0.0; }
    /// Wrong pixels of the object's.
    double getErrorShare() const;
    /// One line with all numbers.
    std::string describe() const;
    /// Adds the numbers of another picture.
    void add(const MaskDifference& other);
};

/// Compares a mask (white lit, black shadowed, any other colour background), and appends to
/// `wrong` for each pixel 0 right, 1 wrong but excused, 2 leak. At grazing light a wrong pixel is
/// excused where the color is off by at most 1/255; elsewhere where one of the proofs of
/// ShadowTruth holds.
MaskDifference compareMask(const osg::Image& mask, const ShadowTruth& truth, const Light& light,
                           const TruthPicture& picture, const LightColor& color,
                           std::vector<unsigned char>* wrong = nullptr);

/// The truth as a mask, on the given background.
osg::ref_ptr<osg::Image> toImage(const std::vector<Sample>& samples, int width, int height);

/// Writes <name>.{truth,mask,leaks}.png; returns where.
std::string writePictures(const osg::Image& mask, const std::vector<Sample>& samples,
                          const std::vector<unsigned char>& wrong, const std::string& name);

} // namespace truth
