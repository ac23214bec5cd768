// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceState.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Multisample>
#include <osg/PointSprite>
#include <osg/Texture>
#include <osg/TextureCubeMap>
#include <osg/TextureRectangle>

#include <algorithm>

#ifndef GL_VERTEX_PROGRAM_ARB
#define GL_VERTEX_PROGRAM_ARB 0x8620
#endif
#ifndef GL_FRAGMENT_PROGRAM_ARB
#define GL_FRAGMENT_PROGRAM_ARB 0x8804
#endif
#ifndef GL_COLOR_SUM
#define GL_COLOR_SUM 0x8458
#endif
#ifndef GL_FRAMEBUFFER_SRGB
#define GL_FRAMEBUFFER_SRGB 0x8DB9
#endif

namespace osgMultiRender
{

namespace
{

using OverrideValue = osg::StateAttribute::OverrideValue;

bool isProtected(OverrideValue value)
{
    return (value & osg::StateAttribute::PROTECTED) != 0;
}

std::uint32_t bitOfMode(osg::StateAttribute::GLMode mode)
{
    if (mode >= GL_LIGHT0 && mode < GL_LIGHT0 + SurfaceState::MaxGLLights)
        return SurfaceState::Light0 << (mode - GL_LIGHT0);
    if (mode >= GL_CLIP_PLANE0 && mode < GL_CLIP_PLANE0 + SurfaceState::MaxClipPlanes)
        return SurfaceState::ClipPlane0 << (mode - GL_CLIP_PLANE0);
    switch (mode)
    {
    case GL_LIGHTING:
        return SurfaceState::Lighting;
    case GL_NORMALIZE:
        return SurfaceState::Normalize;
    case GL_RESCALE_NORMAL:
        return SurfaceState::RescaleNormal;
    case GL_FOG:
        return SurfaceState::Fog;
    case GL_COLOR_SUM:
        return SurfaceState::ColorSum;
    case GL_BLEND:
        return SurfaceState::Blend;
    case GL_DEPTH_TEST:
        return SurfaceState::DepthTest;
    case GL_ALPHA_TEST:
        return SurfaceState::AlphaTest;
    case GL_SAMPLE_ALPHA_TO_COVERAGE_ARB:
        return SurfaceState::AlphaToCoverage;
    case GL_POLYGON_OFFSET_FILL:
        return SurfaceState::PolygonOffset;
    case GL_STENCIL_TEST:
        return SurfaceState::StencilTest;
    case GL_COLOR_LOGIC_OP:
        return SurfaceState::ColorLogicOp;
    case GL_FRAMEBUFFER_SRGB:
        return SurfaceState::FramebufferSRGB;
    case GL_VERTEX_PROGRAM_ARB:
    case GL_FRAGMENT_PROGRAM_ARB:
        return SurfaceState::AssemblyProgram;
    case GL_POINT_SPRITE_ARB:
        return SurfaceState::PointSprites;
    default:
        return 0;
    }
}

std::uint32_t bitOfTextureMode(osg::StateAttribute::GLMode mode)
{
    switch (mode)
    {
    case GL_TEXTURE_1D:
        return SurfaceState::Texture1D;
    case GL_TEXTURE_2D:
        return SurfaceState::Texture2D;
    case GL_TEXTURE_RECTANGLE:
        return SurfaceState::TextureRectangle;
    case GL_TEXTURE_3D:
        return SurfaceState::Texture3D;
    case GL_TEXTURE_CUBE_MAP:
        return SurfaceState::TextureCube;
    case GL_TEXTURE_GEN_S:
        return SurfaceState::GenS;
    case GL_TEXTURE_GEN_T:
        return SurfaceState::GenT;
    case GL_TEXTURE_GEN_R:
        return SurfaceState::GenR;
    case GL_TEXTURE_GEN_Q:
        return SurfaceState::GenQ;
    case GL_POINT_SPRITE_ARB:
        return SurfaceState::PointSprite;
    default:
        return 0;
    }
}

int slotOfAttribute(osg::StateAttribute::Type type)
{
    switch (type)
    {
    case osg::StateAttribute::MATERIAL:
        return SurfaceState::Material;
    case osg::StateAttribute::LIGHTMODEL:
        return SurfaceState::LightModel;
    case osg::StateAttribute::FOG:
        return SurfaceState::FogAttribute;
    case osg::StateAttribute::SHADEMODEL:
        return SurfaceState::ShadeModel;
    case osg::StateAttribute::PROGRAM:
        return SurfaceState::Program;
    case osg::StateAttribute::POINT:
        return SurfaceState::Point;
    case osg::StateAttribute::DEPTH:
        return SurfaceState::Depth;
    case osg::StateAttribute::COLORMASK:
        return SurfaceState::ColorMask;
    case osg::StateAttribute::VIEWPORT:
        return SurfaceState::Viewport;
    default:
        return -1;
    }
}

int slotOfTextureAttribute(osg::StateAttribute::Type type)
{
    switch (type)
    {
    case osg::StateAttribute::TEXTURE:
        return SurfaceState::Texture;
    case osg::StateAttribute::TEXENV:
        return SurfaceState::TexEnv;
    case osg::StateAttribute::TEXGEN:
        return SurfaceState::TexGen;
    case osg::StateAttribute::TEXMAT:
        return SurfaceState::TexMat;
    default:
        return -1;
    }
}

} // namespace

void SurfaceState::Modes::apply(std::uint32_t bit, OverrideValue value)
{
    if ((overridden & bit) && !isProtected(value))
        return;
    on = (value & osg::StateAttribute::ON) ? on | bit : on & ~bit;
    overridden = (value & osg::StateAttribute::OVERRIDE) ? overridden | bit : overridden & ~bit;
}

void SurfaceState::Slot::apply(const osg::StateSet::RefAttributePair& pair)
{
    if (overridden && !isProtected(pair.second))
        return;
    attribute = pair.first.get();
    overridden = (pair.second & osg::StateAttribute::OVERRIDE) != 0;
}

void SurfaceState::apply(const osg::StateSet& stateSet)
{
    applyModes(stateSet.getModeList());
    applyTextureModes(stateSet);
    applyAttributes(stateSet);
}

void SurfaceState::applyModes(const osg::StateSet::ModeList& modes)
{
    ExtraLights* extra = nullptr;
    for (const auto& [mode, value] : modes)
    {
        if (std::uint32_t bit = bitOfMode(mode))
            _modes.apply(bit, value);
        else if (mode >= GL_LIGHT0 + MaxGLLights && mode < GL_LIGHT0 + FirstUnscopedLight)
            applyExtraLight(extra, mode - GL_LIGHT0, value);
    }
}

void SurfaceState::applyExtraLight(ExtraLights*& writable, unsigned int number, OverrideValue value)
{
    ExtraLight& light = mentionExtraLight(writable, number);
    if (light.overridden && !isProtected(value))
        return;
    light.on = (value & osg::StateAttribute::ON) != 0;
    light.overridden = (value & osg::StateAttribute::OVERRIDE) != 0;
}

SurfaceState::ExtraLight& SurfaceState::mentionExtraLight(ExtraLights*& writable,
                                                          unsigned int number)
{
    if (!writable)
    {
        auto copy = _extraLights ? std::make_shared<ExtraLights>(*_extraLights)
                                 : std::make_shared<ExtraLights>();
        writable = copy.get();
        _extraLights = std::move(copy);
    }
    auto found =
        std::lower_bound(writable->begin(), writable->end(), number,
                         [](const ExtraLight& light, unsigned int n) { return light.number < n; });
    if (found == writable->end() || found->number != number)
        found = writable->insert(found, {number, false, false});
    return *found;
}

void SurfaceState::applyTextureModes(const osg::StateSet& stateSet)
{
    const osg::StateSet::TextureModeList& units = stateSet.getTextureModeList();
    for (unsigned int unit = 0; unit < units.size(); ++unit)
        for (const auto& [mode, value] : units[unit])
        {
            const std::uint32_t bit = bitOfTextureMode(mode);
            if (!bit)
                continue;
            if (unit < MaxTextureUnits)
                _units[unit].modes.apply(bit, value);
            else if (unit < MaxTextureUnits + UnitsBeyond && (bit & AnyTexture))
                _unitsBeyond.apply(bit << (NumTargets * (unit - MaxTextureUnits)), value);
        }
}

void SurfaceState::applyAttributes(const osg::StateSet& stateSet)
{
    ExtraLights* extra = nullptr;
    for (const auto& [typeMember, pair] : stateSet.getAttributeList())
    {
        if (typeMember.first == osg::StateAttribute::LIGHT)
        {
            if (typeMember.second < MaxGLLights)
                _lights[typeMember.second].apply(pair);
            else
                mentionExtraLight(extra, typeMember.second);
        }
        else if (int slot = slotOfAttribute(typeMember.first); slot >= 0)
        {
            _attributes[slot].apply(pair);
            if (slot == Program && isProtected(pair.second))
                _programProtected = true;
        }
    }
    const osg::StateSet::TextureAttributeList& units = stateSet.getTextureAttributeList();
    for (unsigned int unit = 0; unit < units.size() && unit < MaxTextureUnits; ++unit)
        for (const auto& [typeMember, pair] : units[unit])
            if (int slot = slotOfTextureAttribute(typeMember.first); slot >= 0)
                _units[unit].attributes[slot].apply(pair);
}

bool SurfaceState::isLightOn(unsigned int number) const
{
    if (number < MaxGLLights)
        return (_modes.on & (Light0 << number)) != 0;
    if (!_extraLights)
        return false;
    auto found =
        std::lower_bound(_extraLights->begin(), _extraLights->end(), number,
                         [](const ExtraLight& light, unsigned int n) { return light.number < n; });
    return found != _extraLights->end() && found->number == number && found->on;
}

bool SurfaceState::isOpaque() const
{
    const auto* depth = static_cast<const osg::Depth*>(get(Depth));
    return isOn(DepthTest) && !isOn(Blend) && (!depth || depth->getWriteMask());
}

bool SurfaceState::isCopyable() const
{
    const auto* depth = static_cast<const osg::Depth*>(get(Depth));
    const auto* mask = static_cast<const osg::ColorMask*>(get(ColorMask));
    return isOpaque() && !(_modes.on & (StencilTest | ColorLogicOp | FramebufferSRGB)) &&
           (!depth || depth->getFunction() == osg::Depth::LESS) &&
           (!mask || (mask->getRedMask() && mask->getGreenMask() && mask->getBlueMask() &&
                      mask->getAlphaMask()));
}

std::vector<unsigned int> SurfaceState::getExtraLights(bool onlyOn) const
{
    std::vector<unsigned int> numbers;
    if (_extraLights)
        for (const ExtraLight& light : *_extraLights)
            if (light.on || !onlyOn)
                numbers.push_back(light.number);
    return numbers;
}

} // namespace osgMultiRender
