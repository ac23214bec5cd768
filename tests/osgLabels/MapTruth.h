// SPDX-License-Identifier: MIT
#pragma once

#include "MapTruthScene.h"

#include <support/HeadlessViewer.h>

#include <memory>

namespace mapTruth
{

/// A label as far as it matters what hides it.
struct Label
{
    double depth = 0.0;  ///< From the eye along the view, in units of the scene.
    std::string feature; ///< What lies below nodes of this name never hides it; empty: none.
    /// Where the ray leaves the feature the nearest such place counts instead of that depth.
    bool isAtBack = false;
};

/// What hides map labels, by ray tracing: Embree finds the triangles near a ray, with room for the
/// rounding of its floats; double precision decides.
///
/// The ray of a pixel runs from the near plane to the label. A closed mesh hides the label where
/// the ray leaves it on this way, an open one where the ray meets it at all. All functions may be
/// called from several threads.
class MapTruth
{
public:
    /// Takes a copy of what it needs. Pixels are those of a picture of width x height.
    MapTruth(osg::Node& node, const support::CameraSpec& camera, int width, int height,
             const EffectOf& effectOf = effectByClass({}));
    ~MapTruth();
    MapTruth(const MapTruth&) = delete;
    MapTruth& operator=(const MapTruth&) = delete;

    /// At a place in pixels from the lower left corner: centres of pixels are at halves.
    Effect at(const Label& label, double x, double y) const;

    /// As at(), but by looking at every triangle, without Embree: for tests of that one.
    Effect atByAll(const Label& label, double x, double y) const;

    /// Whether the effect is the same all over within a pixel of the place, and with labels nearer
    /// or farther by a share of 4e-6 of the depth, what single precision needs.
    bool isCertain(const Label& label, double x, double y) const;

private:
    struct State;
    std::unique_ptr<State> _state;
};

} // namespace mapTruth
