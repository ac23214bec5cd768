// SPDX-License-Identifier: MIT
#pragma once

#include "TruthScene.h"

#include <support/HeadlessViewer.h>

#include <osg/Vec2d>

#include <cstdint>
#include <memory>
#include <vector>

namespace truth
{

enum class Seen : std::uint8_t
{
    NOTHING,
    LIT,
    SHADOWED,
    UNREACHED ///< Outside the cone of a spot.
};

/// What the ray through a point of the picture finds.
struct Sample
{
    Seen seen = Seen::NOTHING;
    int triangle = -1;  ///< Of the scene's.
    osg::Vec3d point;   ///< Eye coordinates.
    osg::Vec3d normal;  ///< Of the triangle, unit, eye coordinates.
    double grazing = 1; ///< |N.L|.
};

/// Shadows by ray tracing: Embree finds the triangles near a ray, with room for the rounding of its
/// floats; double precision decides.
///
/// The triangle that is seen casts on itself where the light lies on the other side of its plane. A
/// triangle with the light in its plane casts nothing. All functions may be called from several
/// threads.
class ShadowTruth
{
public:
    /// Takes a copy of what it needs.
    ShadowTruth(osg::Node& node, const support::CameraSpec& camera);
    ~ShadowTruth();
    ShadowTruth(const ShadowTruth&) = delete;
    ShadowTruth& operator=(const ShadowTruth&) = delete;

    const Scene& getScene() const;

    /// The light with this number; null where the scene has none.
    const Light* findLight(int number) const;

    /// At a point of normalized device coordinates, -1 to 1.
    Sample sample(const Light& light, double x, double y) const;

    /// As sample(), but by looking at every triangle, without Embree: for tests of that one.
    Sample sampleByAll(const Light& light, double x, double y) const;

    /// Points within a pixel of (x, y) where the edges of triangles, as they are seen or as shadows
    /// on the plane of what is seen at (x, y), come nearest to it: for what is so thin that a
    /// look at many points misses it. `pixel` is the size of one.
    std::vector<osg::Vec2d> findEdgePoints(const Light& light, double x, double y,
                                           const osg::Vec2d& pixel) const;

    /// Whether on the way between two points of the picture the surface that is seen at the first
    /// one ends before or behind another one, more than a quantum of depth away: at its own edge,
    /// at one of another before it, or where the near plane cuts either.
    bool isObjectEdgeBetween(const osg::Vec2d& from, const osg::Vec2d& to) const;

    /// Whether `seen` is the answer too for a surface that is found one quantum of a 24-bit depth
    /// buffer (2^-24) nearer or farther. What the surface casts on itself is not asked anew.
    bool isWithinDepthQuantum(const Light& light, double x, double y, Seen seen) const;

    /// Whether a face of a shadow volume (a caster or a side of its volume) lies before the surface
    /// at (x, y) or behind it depending on where within 1/256 of a pixel, the size that a
    /// rasterizer with 8 subpixel bits snaps corners to, and within a quantum of depth. Matters for
    /// faces that are seen nearly edge-on. `pixel` is the size of one.
    bool isWithinSnapping(const Light& light, double x, double y, const osg::Vec2d& pixel) const;

    /// Row by row from the bottom, at the centers of the pixels; uses all cores.
    std::vector<Sample> render(const Light& light, int width, int height) const;

private:
    struct State;
    std::unique_ptr<State> _state;
};

} // namespace truth
