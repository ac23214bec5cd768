// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osg/Light>
#include <osg/StateSet>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace osgMultiRender
{

/// The modes and attributes in effect for one leaf, as osg::State would resolve them.
///
/// Holds only what decides how a surface looks under the fixed function. Built by apply()ing the
/// StateSets of a leaf's path from the root down; OVERRIDE and PROTECTED count as in osg::State.
/// Copying is cheap, so that the children of a StateGraph start from a copy of their parent's.
/// The pointers are those of the StateSets and live as long as these.
class OSGMULTIRENDER_EXPORT SurfaceState
{
public:
    static constexpr unsigned int MaxTextureUnits = 4; ///< Units that the surface functions know.
    static constexpr unsigned int MaxGLLights = 8;     ///< Lights that the fixed function has.
    static constexpr unsigned int MaxClipPlanes = 8;   ///< GL has at least 6.

    /// Modes that are tracked for all units together.
    enum Mode : std::uint32_t
    {
        Lighting = 1u << 0,
        Normalize = 1u << 1,
        RescaleNormal = 1u << 2,
        Fog = 1u << 3,
        ColorSum = 1u << 4,
        AssemblyProgram = 1u << 5, ///< GL_VERTEX_PROGRAM_ARB or GL_FRAGMENT_PROGRAM_ARB.
        PointSprites = 1u << 6,    ///< osg::PointSprite sets it as a mode of all units.
        Light0 = 1u << 8,          ///< GL_LIGHT0 to GL_LIGHT7.
        ClipPlane0 = 1u << 16,     ///< GL_CLIP_PLANE0 to GL_CLIP_PLANE7.
        Blend = 1u << 24,
        DepthTest = 1u << 25,
        AlphaTest = 1u << 26,
        AlphaToCoverage = 1u << 27,
        PolygonOffset = 1u << 28, ///< GL_POLYGON_OFFSET_FILL.
        StencilTest = 1u << 29,
        ColorLogicOp = 1u << 30,
        FramebufferSRGB = 1u << 31
    };

    /// Modes that are tracked for each texture unit.
    enum TextureMode : std::uint32_t
    {
        Texture1D = 1u << 0,
        Texture2D = 1u << 1,
        TextureRectangle = 1u << 2,
        Texture3D = 1u << 3,
        TextureCube = 1u << 4,
        GenS = 1u << 5,
        GenT = 1u << 6,
        GenR = 1u << 7,
        GenQ = 1u << 8,
        PointSprite = 1u << 9,
        AnyTexture = Texture1D | Texture2D | TextureRectangle | Texture3D | TextureCube
    };

    enum Attribute
    {
        Material,
        LightModel,
        FogAttribute,
        ShadeModel,
        Program,
        Point,
        Depth,
        ColorMask,
        Viewport,
        NumAttributes
    };

    enum TextureAttribute
    {
        Texture,
        TexEnv, ///< osg::TexEnv or osg::TexEnvCombine.
        TexGen,
        TexMat,
        NumTextureAttributes
    };

    /// Applies one StateSet of the path, on top of what was applied before.
    void apply(const osg::StateSet& stateSet);

    bool isOn(Mode mode) const { return (_modes.on & mode) != 0; }
    bool isLightOn(unsigned int number) const;
    std::uint32_t getModes() const { return _modes.on; }
    std::uint32_t getTextureModes(unsigned int unit) const { return _units[unit].modes.on; }

    const osg::StateAttribute* get(Attribute attribute) const
    {
        return _attributes[attribute].attribute;
    }
    const osg::StateAttribute* get(unsigned int unit, TextureAttribute attribute) const
    {
        return _units[unit].attributes[attribute].attribute;
    }
    /// The Light attribute that a StateSet of the path holds for GL_LIGHT0 + number, or null.
    const osg::Light* getLight(unsigned int number) const
    {
        return static_cast<const osg::Light*>(_lights[number].attribute);
    }

    /// Numbers of the lights above GL_LIGHT7 whose mode is on, or of all that the path mentions;
    /// ascending.
    std::vector<unsigned int> getExtraLights(bool onlyOn = true) const;
    /// Whether two states switch the same lights above GL_LIGHT7 for sure (equal pointers).
    const void* getExtraLightsIdentity() const { return _extraLights.get(); }

    /// Hides what lies behind it: it is not blended, and tests and writes depth.
    bool isOpaque() const;

    /// It is opaque, and what a pixel shows in the end can be found elsewhere and put into the
    /// view by a test of depth LESS: nothing else of the view's buffers is read, kept or written.
    bool isCopyable() const;

    /// Whether a StateSet of the path holds a Program with PROTECTED.
    bool isProgramProtected() const { return _programProtected; }

    /// Whether a texture unit beyond MaxTextureUnits has a texture mode on.
    bool usesUnitsBeyond() const { return _unitsBeyond.on != 0; }

private:
    struct Modes
    {
        std::uint32_t on = 0;
        std::uint32_t overridden = 0;
        void apply(std::uint32_t bit, osg::StateAttribute::OverrideValue value);
    };
    struct Slot
    {
        const osg::StateAttribute* attribute = nullptr;
        bool overridden = false;
        void apply(const osg::StateSet::RefAttributePair& pair);
    };
    struct Unit
    {
        Modes modes;
        std::array<Slot, NumTextureAttributes> attributes;
    };
    struct ExtraLight
    {
        unsigned int number;
        bool on;
        bool overridden;
    };
    using ExtraLights = std::vector<ExtraLight>;

    static constexpr unsigned int NumTargets = 5;  ///< Bits of AnyTexture.
    static constexpr unsigned int UnitsBeyond = 6; ///< Units whose targets one word holds.

    void applyModes(const osg::StateSet::ModeList& modes);
    void applyExtraLight(ExtraLights*& writable, unsigned int number,
                         osg::StateAttribute::OverrideValue value);
    ExtraLight& mentionExtraLight(ExtraLights*& writable, unsigned int number);
    void applyTextureModes(const osg::StateSet& stateSet);
    void applyAttributes(const osg::StateSet& stateSet);

    Modes _modes;
    std::array<Slot, NumAttributes> _attributes;
    std::array<Slot, MaxGLLights> _lights;
    std::array<Unit, MaxTextureUnits> _units;
    bool _programProtected = false;
    Modes _unitsBeyond;                              ///< NumTargets bits a unit, units 4 to 9.
    std::shared_ptr<const ExtraLights> _extraLights; ///< Sorted by number; shared until written.
};

/// Lights from this number up share GLenum values with other modes (GL_LIGHT0 + 16384 = 0x8000), so
/// that their mode can't scope them.
constexpr unsigned int FirstUnscopedLight = 16384;

} // namespace osgMultiRender
