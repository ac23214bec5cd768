// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSeams.h>
#include <osgPagedTexture/Pixels.h>

#include <array>
#include <vector>

namespace osgPagedTexture
{

/// A point of a seam as both photographs show it.
struct SeamSample
{
    struct Side
    {
        std::size_t photo = 0;
        glm::dvec2 place{0.0}; ///< In pixels from the photograph's bottom left corner.
        glm::vec3 color{0.0f}; ///< Of the photograph there, 0 to 255, bilinear.
    };
    std::array<Side, 2> sides;
    double weight = 0.0; ///< Length of the seam that it stands for, in the model's units.
};

/// Points about a pixel apart along all seams. Colours are 0.
OSGPAGEDTEXTURE_EXPORT std::vector<SeamSample> sampleSeams(const std::vector<Photo>& photos,
                                                           const std::vector<PhotoSeam>& seams);

/// Fills in what a photograph shows of the seams.
OSGPAGEDTEXTURE_EXPORT void readSamples(std::vector<SeamSample>& samples, std::size_t photo,
                                        const Pixels& pixels);

/// The colour at a place in pixels from the bottom left corner, bilinear; grey in all channels.
glm::vec3 lookUp(const Pixels& pixels, const glm::dvec2& place);

/// The mean over the seams' length of the difference of both sides' colours, the mean of the three
/// channels, 0 to 255.
OSGPAGEDTEXTURE_EXPORT double meanSeamStep(const std::vector<SeamSample>& samples);

} // namespace osgPagedTexture
