// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSurface.h>
#include <osgPagedTexture/Pixels.h>
#include <osgPagedTexture/SeamSamples.h>

#include <functional>
#include <memory>
#include <vector>

namespace osgPagedTexture
{

struct BlendSettings
{
    /// Pixels from one value of the correction to the next, a power of two, 1 to 256; 0: the
    /// smallest, from 4 on, with no more than a million values.
    int cell = 0;
    /// At most, of the finest of the grids; see `error`.
    int iterations = 200;
    /// Ends where the residual's length is this share of that of the right side.
    double error = 1e-4;
    /// Whether coarser grids are solved first, each as the next one's start.
    bool cascade = true;
};

struct BlendReport
{
    int cell = 0;
    std::size_t values = 0; ///< That were solved for, of each channel.
    int iterations = 0;     ///< Of the finest grid, the most of a channel.
    double residual = 0.0;  ///< Share of the right side that is left, of the worst channel.
    double solveSeconds = 0.0;
    double expectedStep = 0.0; ///< meanSeamStep() with corrections that are not rounded.
};

/// Takes the steps of colour at seams out of photographs: to each, a correction is added that is as
/// smooth as can be in what the model shows of the photograph, and at the seams makes both sides
/// equal. That is Poisson editing (P. Perez, M. Gangnet, A. Blake, 2003) of all photographs at
/// once: their gradients stay, and the steps go.
class OSGPAGEDTEXTURE_EXPORT SeamBlend
{
public:
    /// Samples have their colours. `maskOf` is asked for each photograph's mask, again for each
    /// grid; where it is 0 there is no correction.
    SeamBlend(const std::vector<Photo>& photos, std::vector<SeamSample> samples,
              std::function<Pixels(std::size_t photo)> maskOf);
    ~SeamBlend();
    SeamBlend(const SeamBlend&) = delete;
    SeamBlend& operator=(const SeamBlend&) = delete;

    BlendReport solve(const BlendSettings& settings = {});

    /// The correction of a photograph, in steps of 0 to 255, at a place in pixels from its bottom
    /// left corner; 0 where there is none.
    glm::vec3 getCorrection(std::size_t photo, const glm::dvec2& place) const;

    /// Adds the correction to the pixels that the mask has.
    void apply(std::size_t photo, Pixels& pixels) const;

private:
    struct State;
    std::unique_ptr<State> _state;
};

} // namespace osgPagedTexture
