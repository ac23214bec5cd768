// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>
#include <osgShadowVolume/ShadowHull.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace osgShadowVolume
{

/// How the depth maps of all lights share one array of layers.
struct MapBudget
{
    unsigned int size = 0;   ///< Texels on a side; 0 where there are no maps.
    unsigned int layers = 0; ///< Of all maps.
    std::size_t lights = 0;  ///< That have maps: the first ones.
    bool isSmaller = false;  ///< The size is not the one asked for.

    /// Of depths of 32 bits.
    std::size_t getBytes() const { return std::size_t(4) * size * size * layers; }
};

/// Fits maps into memory: `wanted` texels on a side, 16 to `largest`, halved until all fit into
/// `bytes`. Lights beyond `maxLayers`, or that do not fit with 16 texels, have none.
OSGSHADOWVOLUME_EXPORT MapBudget fitBudget(const std::vector<unsigned int>& layersOfLights,
                                           unsigned int wanted, unsigned int largest,
                                           unsigned int maxLayers, std::size_t bytes);

/// The depth map of one light: where a point in eye coordinates lies in it.
///
/// Maps are fixed to the axes of the world, so that shadow edges stay where they are while the
/// camera moves.
struct OSGSHADOWVOLUME_EXPORT ShadowMap
{
    enum Kind
    {
        Parallel, ///< Directional lights: `rows` give u, v in [0, 1] and the depth.
        Cone,     ///< Narrow spots: `rows` give x and y beside the axis and m along it.
        Cube      ///< Others: six faces; `rows` give the point relative to the light.
    };

    /// Where a point is looked up. The GLSL of shaders/map.frag does the same.
    struct Place
    {
        unsigned int face = 0;
        glm::dvec2 uv{0.0};
        double depth = 0.0;
        bool isInside = false; ///< Outside there is no caster, or no light.
    };

    unsigned int getLayers() const { return kind == Cube ? 6 : 1; }
    Place find(const glm::dvec3& eye) const;
    /// From eye to clip coordinates of a face. Face 2 a is along axis a, 2 a + 1 against it; x and
    /// y of a face are the axes that follow in turn.
    glm::dmat4 getMatrix(unsigned int face) const;
    /// Whether a caster may be seen on a face. Never false for one that is.
    bool mayShow(const Hexahedron& caster, unsigned int face) const;

    Kind kind = Parallel;
    glm::dvec4 rows[3] = {};
    double nearest = 0.0; ///< Cone, Cube: the depth of m is 1 - nearest / m.
    double spread = 1.0;  ///< Cone, Cube: x / m at the border of a face.
    /// How far a surface is moved towards the light before it is compared: half a texel. Parallel:
    /// in depths; Cone, Cube: as a share of m.
    double bias = 0.0;
};

/// What a map is fitted to.
struct MapView
{
    glm::dmat4 toWorld{1.0}; ///< From eye coordinates.
    /// Each holds all that is in view. One that is unknown is not used.
    std::vector<Hexahedron> receivers;
    std::vector<Hexahedron> casters; ///< Of one light.
};

/// Texels at each border of a map that samples of its edge may need.
OSGSHADOWVOLUME_EXPORT unsigned int mapBorder(unsigned int samples);

/// Which kind of map a light has: Cone for spots with a cutoff of less than 80 degrees.
OSGSHADOWVOLUME_EXPORT ShadowMap::Kind mapKindOf(const EyeLight& light);

/// The map of a light with `size` texels on a side, filtered over `samples` texels. None where no
/// caster can throw a shadow into the view, or where nothing bounds the map.
OSGSHADOWVOLUME_EXPORT std::optional<ShadowMap> fitMap(const EyeLight& light, const MapView& view,
                                                       unsigned int size, unsigned int samples);

} // namespace osgShadowVolume
