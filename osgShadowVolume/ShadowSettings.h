// SPDX-License-Identifier: MIT
#pragma once

namespace osgShadowVolume
{

enum class Shadows
{
    OFF,     ///< Light goes through everything.
    VOLUMES, ///< Silhouette shadow volumes: exact to the pixel.
    MAP      ///< One shadow map a light, six for a point light: fast, as coarse as its texels.
};

/// Who finds the silhouette edges. All decide alike to the last bit.
enum class Technique
{
    AUTO,     ///< The fastest that the context has.
    TESS,     ///< Tessellation control shader, OpenGL 4.0.
    GEOMETRY, ///< Geometry shader with `precise`: GLSL 4.00 or ARB_gpu_shader5.
    CPU       ///< Threads; any OpenGL that the kit works on.
};

/// Which blended surfaces cast shadows. Those that cast do it fully: a shadow has no colour.
enum class TransparentCasters
{
    NONE,
    ALL,
    BY_ALPHA ///< Where the material's alpha is at least 0.5.
};

/// What a ShadowedScene draws.
enum class Show
{
    PICTURE,
    MASK,        ///< White where `lightShown` reaches, black where its light is taken away.
    VOLUMES,     ///< The picture with the shadow volumes as translucent surfaces.
    ILLUMINANCE, ///< Direct illuminance in false colours, with a legend.
    LUX          ///< Direct illuminance in lux in all channels, for float targets.
};

/// All knobs of a ShadowedScene; see its setters.
struct ShadowSettings
{
    Shadows shadows = Shadows::VOLUMES;
    Technique technique = Technique::AUTO;
    TransparentCasters transparentCasters = TransparentCasters::BY_ALPHA;
    bool headlightShadow = false;
    unsigned int transparentLayers = 4;
    unsigned int mapSize = 1024;
    unsigned int mapSamples = 1;
    unsigned int mapMegabytes = 256;
    Show show = Show::PICTURE;
    int lightShown = -1;
    bool mirrors = true;
    unsigned int maxMirrors = 4;
    bool keys = true;
    double metresPerUnit = 0.0;
    double illuminanceMaximum = 0.0;
    double candela = 0.0;
    double lux = 0.0;
};

/// Whether illuminance is drawn instead of a picture.
inline bool measuresLight(const ShadowSettings& settings)
{
    return settings.show == Show::ILLUMINANCE || settings.show == Show::LUX;
}

} // namespace osgShadowVolume
