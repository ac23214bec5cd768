// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/SurfaceState.h>

#include <array>
#include <cstdint>
#include <string>

namespace osgMultiRender
{

/// Where light is evaluated.
enum class LightingMode : std::uint8_t
{
    Off,    ///< Nowhere: the vertex colour is the surface's colour.
    Vertex, ///< Per vertex by GL's own lights, as the fixed function does.
    Pixel   ///< Per fragment by the lights of a kit.
};

/// What one texture unit adds to a program.
struct TextureKey
{
    enum Target : std::uint8_t
    {
        None,
        Target1D,
        Target2D,
        Target3D,
        TargetCube,
        TargetRectangle
    };
    enum Environment : std::uint8_t
    {
        Modulate,
        Replace,
        Decal,
        Blend,
        Add,
        Combine
    };
    /// Base internal formats; GL_RED and GL_RG behave as RGB.
    enum BaseFormat : std::uint8_t
    {
        RGB,
        RGBA,
        Alpha,
        Luminance,
        LuminanceAlpha,
        Intensity
    };
    enum Generation : std::uint8_t
    {
        ObjectLinear,
        EyeLinear,
        SphereMap,
        NormalMap,
        ReflectionMap
    };

    std::uint8_t target = None;
    std::uint8_t environment = Modulate;
    std::uint8_t baseFormat = RGB;
    std::uint8_t generation = ObjectLinear; ///< Meant only where generated is not 0.
    std::uint8_t generated = 0;             ///< Bit 0 to 3: s, t, r, q come from TexGen.
    std::uint8_t matrix = 0;                ///< 1: a texture matrix applies.
    std::uint8_t sampled = 0;               ///< 1: the texture pass says what it gives; 2D only.
    /// TexEnvCombine: function (0-7) of RGB and alpha, then sources (0-6) and operands (0-3), then
    /// scales (0-2 for 1, 2, 4). Zero for the other environments.
    std::array<std::uint8_t, 2> function{};
    std::array<std::uint8_t, 6> source{};
    std::array<std::uint8_t, 6> operand{};
    std::array<std::uint8_t, 2> scale{};
};

/// Sources of TexEnvCombine in TextureKey::source.
enum CombineSource : std::uint8_t
{
    SourceTexture0,
    SourceTexture1,
    SourceTexture2,
    SourceTexture3,
    SourceConstant,
    SourcePrimary,
    SourcePrevious
};

/// Says all that a surface program depends on, and nothing that it does not: two states with equal
/// keys share a program, and a state that uses nothing has the default key.
struct OSGMULTIRENDER_EXPORT SurfaceKey
{
    enum NormalScaling : std::uint8_t
    {
        AsIs,
        Normalized,
        Rescaled
    };
    enum LightType : std::uint8_t
    {
        LightOff,
        Directional,
        Point,
        Spot,
        DirectionalSpot ///< At infinity, with a cone: its factor depends on directions alone.
    };
    enum FogMode : std::uint8_t
    {
        NoFog,
        Linear,
        Exp,
        Exp2
    };
    enum ColorMode : std::uint8_t
    {
        ColorOff,
        Ambient,
        Diffuse,
        Specular,
        Emission,
        AmbientAndDiffuse
    };

    LightingMode lighting = LightingMode::Off;
    std::uint8_t normalScaling = AsIs;
    std::uint8_t twoSided = 0;
    std::uint8_t localViewer = 0;
    std::uint8_t specular = 0;         ///< 0: the material has no specular colour.
    std::uint8_t separateSpecular = 0; ///< Only told apart where specular.
    std::uint8_t colorMode = ColorOff;
    std::uint8_t colorSum = 0;
    std::uint8_t flat = 0; ///< Only told apart with LightingMode::Pixel.
    std::uint8_t fog = NoFog;
    std::uint8_t fogCoordinate = 0; ///< 1: the fog coordinate array instead of the depth.
    std::uint8_t clip = 0;          ///< 1: a user clip plane is on.
    std::array<std::uint8_t, SurfaceState::MaxGLLights> lights{}; ///< LightType; vertex mode only.
    std::array<TextureKey, SurfaceState::MaxTextureUnits> textures{};
    std::uint32_t kit = 0;      ///< What the snippet of the light pass depends on; its own meaning.
    std::uint32_t output = 0;   ///< What the snippet of the output pass depends on.
    std::uint32_t texture = 0;  ///< What the snippet of the texture pass depends on.
    std::uint64_t program = 0;  ///< Content of the model's own Program, 0 for none.
    std::uint64_t instance = 0; ///< Content of a VertexSnippet, 0 for none.

    bool operator==(const SurfaceKey& other) const;
    bool operator!=(const SurfaceKey& other) const { return !(*this == other); }

    /// Whether normals take part.
    bool usesNormals() const;
    /// Whether the position in eye coordinates takes part.
    bool usesEyePosition() const;
};

struct OSGMULTIRENDER_EXPORT SurfaceKeyHash
{
    std::size_t operator()(const SurfaceKey& key) const;
};

/// The variant in words, for plans: "lighting=vertex light0=spot tex0=2D/modulate/RGB fog=exp".
/// A key that uses nothing is "plain".
OSGMULTIRENDER_EXPORT std::string toString(const SurfaceKey& key);

/// GL's lights at draw, for the types of vertex lights; null where none was positioned.
using GLLights = std::array<const osg::Light*, SurfaceState::MaxGLLights>;

/// The key of a state. `lighting` is where the kit wants light evaluated; it counts only where the
/// state has GL_LIGHTING on. Returns an empty string, or what the surface functions do not cover:
/// then the leaf keeps the fixed function ("point sprites", "texture unit 4 and up", ...).
OSGMULTIRENDER_EXPORT std::string makeSurfaceKey(const SurfaceState& state, LightingMode lighting,
                                                 const GLLights& positioned, unsigned int contextID,
                                                 SurfaceKey& key);

} // namespace osgMultiRender
