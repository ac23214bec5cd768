// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceTexture.h>

#include <osg/Image>
#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture2D>
#include <osg/Texture>

namespace osgMultiRender
{

namespace
{

template <class T> const T* as(const osg::StateAttribute* attribute)
{
    return dynamic_cast<const T*>(attribute);
}

std::uint8_t baseFormatOf(GLint format)
{
    // ASTC, plain and sRGB.
    if ((format >= 0x93B0 && format <= 0x93BD) || (format >= 0x93D0 && format <= 0x93DD))
        return TextureKey::RGBA;
    switch (format)
    {
    case GL_ALPHA:
    case 0x803B: // GL_ALPHA4
    case 0x803C: // GL_ALPHA8
    case 0x803D: // GL_ALPHA12
    case 0x803E: // GL_ALPHA16
    case 0x8816: // GL_ALPHA32F
    case 0x881C: // GL_ALPHA16F
    case 0x84E9: // GL_COMPRESSED_ALPHA
        return TextureKey::Alpha;
    case 1:
    case GL_LUMINANCE:
    case 0x803F: // GL_LUMINANCE4
    case 0x8040: // GL_LUMINANCE8
    case 0x8041: // GL_LUMINANCE12
    case 0x8042: // GL_LUMINANCE16
    case 0x8818: // GL_LUMINANCE32F
    case 0x881E: // GL_LUMINANCE16F
    case 0x84EA: // GL_COMPRESSED_LUMINANCE
    case 0x8C46: // GL_SLUMINANCE
    case 0x8C47: // GL_SLUMINANCE8
    case 0x1902: // GL_DEPTH_COMPONENT, read as luminance
        return TextureKey::Luminance;
    case 2:
    case GL_LUMINANCE_ALPHA:
    case 0x8043: // GL_LUMINANCE4_ALPHA4 and the sizes that follow
    case 0x8044:
    case 0x8045:
    case 0x8046:
    case 0x8047:
    case 0x8048: // GL_LUMINANCE16_ALPHA16
    case 0x8819: // GL_LUMINANCE_ALPHA32F
    case 0x881F: // GL_LUMINANCE_ALPHA16F
    case 0x84EB: // GL_COMPRESSED_LUMINANCE_ALPHA
    case 0x8837: // GL_COMPRESSED_LUMINANCE_ALPHA_3DC
    case 0x8C72: // GL_COMPRESSED_LUMINANCE_ALPHA_LATC2
    case 0x8C73: // GL_COMPRESSED_SIGNED_LUMINANCE_ALPHA_LATC2
    case 0x8C44: // GL_SLUMINANCE_ALPHA
    case 0x8C45: // GL_SLUMINANCE8_ALPHA8
        return TextureKey::LuminanceAlpha;
    case GL_INTENSITY:
    case 0x804A: // GL_INTENSITY4
    case 0x804B: // GL_INTENSITY8
    case 0x804C: // GL_INTENSITY12
    case 0x804D: // GL_INTENSITY16
    case 0x8817: // GL_INTENSITY32F
    case 0x881D: // GL_INTENSITY16F
    case 0x84EC: // GL_COMPRESSED_INTENSITY
        return TextureKey::Intensity;
    case 4:
    case GL_RGBA:
    case 0x80E1: // GL_BGRA
    case 0x8055: // GL_RGBA2 and the sizes that follow
    case 0x8056: // GL_RGBA4
    case 0x8057: // GL_RGB5_A1
    case 0x8058: // GL_RGBA8
    case 0x8059: // GL_RGB10_A2
    case 0x805A: // GL_RGBA12
    case 0x805B: // GL_RGBA16
    case 0x8814: // GL_RGBA32F
    case 0x881A: // GL_RGBA16F
    case 0x84EE: // GL_COMPRESSED_RGBA
    case 0x83F1: // GL_COMPRESSED_RGBA_S3TC_DXT1
    case 0x83F2: // GL_COMPRESSED_RGBA_S3TC_DXT3
    case 0x83F3: // GL_COMPRESSED_RGBA_S3TC_DXT5
    case 0x8C42: // GL_SRGB_ALPHA
    case 0x8C43: // GL_SRGB8_ALPHA8
    case 0x8C49: // GL_COMPRESSED_SRGB_ALPHA
    case 0x8C4D: // GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT1
    case 0x8C4E:
    case 0x8C4F:
    case 0x8E8C: // GL_COMPRESSED_RGBA_BPTC_UNORM
    case 0x8E8D: // GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM
    case 0x8F97: // GL_RGBA8_SNORM
    case 0x8F9B: // GL_RGBA16_SNORM
    case 0x8C02: // GL_COMPRESSED_RGBA_PVRTC_4BPPV1
    case 0x8C03: // GL_COMPRESSED_RGBA_PVRTC_2BPPV1
    case 0x9276: // GL_COMPRESSED_RGB8_PUNCHTHROUGH_ALPHA1_ETC2
    case 0x9277: // GL_COMPRESSED_SRGB8_PUNCHTHROUGH_ALPHA1_ETC2
    case 0x9278: // GL_COMPRESSED_RGBA8_ETC2_EAC
    case 0x9279: // GL_COMPRESSED_SRGB8_ALPHA8_ETC2_EAC
        return TextureKey::RGBA;
    default:
        return TextureKey::RGB;
    }
}

/// The internal format that the texture has or will have on the GPU. Its image may be freed.
GLint internalFormatOf(const osg::Texture& texture)
{
    const osg::Image* image = texture.getNumImages() ? texture.getImage(0) : nullptr;
    if (image && texture.getInternalFormatMode() != osg::Texture::USE_USER_DEFINED_FORMAT)
        return image->getInternalTextureFormat();
    return texture.getInternalFormat();
}

/// A texture without image, size or callback is incomplete: the fixed function then behaves as if
/// the unit were off.
bool isComplete(const osg::Texture& texture, unsigned int contextID)
{
    if (texture.getTextureObject(contextID))
        return true;
    for (unsigned int i = 0; i < texture.getNumImages(); ++i)
        if (const osg::Image* image = texture.getImage(i))
            if (image->s() > 0)
                return true;
    if (auto* texture2D = dynamic_cast<const osg::Texture2D*>(&texture))
        if (texture2D->getSubloadCallback())
            return true;
    return texture.getTextureWidth() > 0;
}

std::uint8_t targetOf(const osg::Texture& texture, std::uint32_t modes)
{
    switch (texture.getTextureTarget())
    {
    case GL_TEXTURE_1D:
        return (modes & SurfaceState::Texture1D) ? TextureKey::Target1D : TextureKey::None;
    case GL_TEXTURE_2D:
        return (modes & SurfaceState::Texture2D) ? TextureKey::Target2D : TextureKey::None;
    case GL_TEXTURE_3D:
        return (modes & SurfaceState::Texture3D) ? TextureKey::Target3D : TextureKey::None;
    case GL_TEXTURE_CUBE_MAP:
        return (modes & SurfaceState::TextureCube) ? TextureKey::TargetCube : TextureKey::None;
    case GL_TEXTURE_RECTANGLE:
        return (modes & SurfaceState::TextureRectangle) ? TextureKey::TargetRectangle
                                                        : TextureKey::None;
    default:
        return TextureKey::None;
    }
}

std::uint8_t combineFunctionOf(GLint function)
{
    switch (function)
    {
    case osg::TexEnvCombine::REPLACE:
        return 0;
    case osg::TexEnvCombine::ADD:
        return 2;
    case osg::TexEnvCombine::ADD_SIGNED:
        return 3;
    case osg::TexEnvCombine::INTERPOLATE:
        return 4;
    case osg::TexEnvCombine::SUBTRACT:
        return 5;
    case osg::TexEnvCombine::DOT3_RGB:
        return 6;
    case osg::TexEnvCombine::DOT3_RGBA:
        return 7;
    default:
        return 1; // GL_MODULATE
    }
}

/// Returns false for a texture unit that the surface functions do not know.
bool combineSourceOf(GLint source, unsigned int unit, std::uint8_t& result)
{
    switch (source)
    {
    case osg::TexEnvCombine::CONSTANT:
        result = SourceConstant;
        return true;
    case osg::TexEnvCombine::PRIMARY_COLOR:
        result = SourcePrimary;
        return true;
    case osg::TexEnvCombine::PREVIOUS:
        result = SourcePrevious;
        return true;
    case osg::TexEnvCombine::TEXTURE:
        result = static_cast<std::uint8_t>(unit);
        return true;
    default:
        result = static_cast<std::uint8_t>(source - GL_TEXTURE0);
        return source >= GL_TEXTURE0 && source < GLint(GL_TEXTURE0 + SurfaceState::MaxTextureUnits);
    }
}

std::uint8_t combineOperandOf(GLint operand)
{
    switch (operand)
    {
    case osg::TexEnvCombine::ONE_MINUS_SRC_COLOR:
        return 1;
    case osg::TexEnvCombine::SRC_ALPHA:
        return 2;
    case osg::TexEnvCombine::ONE_MINUS_SRC_ALPHA:
        return 3;
    default:
        return 0; // GL_SRC_COLOR
    }
}

std::uint8_t combineScaleOf(float scale)
{
    return scale >= 4.0f ? 2 : scale >= 2.0f ? 1 : 0;
}

bool fillCombine(const osg::TexEnvCombine& combine, unsigned int unit, TextureKey& key)
{
    key.environment = TextureKey::Combine;
    key.function = {combineFunctionOf(combine.getCombine_RGB()),
                    combineFunctionOf(combine.getCombine_Alpha())};
    const GLint sources[6] = {combine.getSource0_RGB(),   combine.getSource1_RGB(),
                              combine.getSource2_RGB(),   combine.getSource0_Alpha(),
                              combine.getSource1_Alpha(), combine.getSource2_Alpha()};
    const GLint operands[6] = {combine.getOperand0_RGB(),   combine.getOperand1_RGB(),
                               combine.getOperand2_RGB(),   combine.getOperand0_Alpha(),
                               combine.getOperand1_Alpha(), combine.getOperand2_Alpha()};
    const unsigned int used[8] = {1, 2, 2, 2, 3, 2, 2, 2}; // arguments of each function
    for (unsigned int i = 0; i < 6; ++i)
    {
        if (i % 3 >= used[key.function[i / 3]])
            continue; // what a function does not read must not split variants
        if (!combineSourceOf(sources[i], unit, key.source[i]))
            return false;
        key.operand[i] = combineOperandOf(operands[i]);
    }
    key.scale = {combineScaleOf(combine.getScale_RGB()), combineScaleOf(combine.getScale_Alpha())};
    return true;
}

TextureKey::Environment environmentOf(const osg::TexEnv& environment)
{
    switch (environment.getMode())
    {
    case osg::TexEnv::REPLACE:
        return TextureKey::Replace;
    case osg::TexEnv::DECAL:
        return TextureKey::Decal;
    case osg::TexEnv::BLEND:
        return TextureKey::Blend;
    case osg::TexEnv::ADD:
        return TextureKey::Add;
    default:
        return TextureKey::Modulate;
    }
}

TextureKey::Generation generationOf(osg::TexGen::Mode mode)
{
    switch (mode)
    {
    case osg::TexGen::OBJECT_LINEAR:
        return TextureKey::ObjectLinear;
    case osg::TexGen::SPHERE_MAP:
        return TextureKey::SphereMap;
    case osg::TexGen::NORMAL_MAP:
        return TextureKey::NormalMap;
    case osg::TexGen::REFLECTION_MAP:
        return TextureKey::ReflectionMap;
    default:
        return TextureKey::EyeLinear;
    }
}

} // namespace

std::string fillTexture(const SurfaceState& state, unsigned int unit, unsigned int contextID,
                        SurfaceKey& surface)
{
    const std::uint32_t modes = state.getTextureModes(unit);
    if (modes & SurfaceState::PointSprite)
        return "point sprites";
    if (!(modes & SurfaceState::AnyTexture))
        return {};
    auto* texture = as<osg::Texture>(state.get(unit, SurfaceState::Texture));
    if (!texture || !isComplete(*texture, contextID))
        return {};
    TextureKey& key = surface.textures[unit];
    key.target = targetOf(*texture, modes);
    if (key.target == TextureKey::None)
        return {};
    if (texture->getShadowComparison())
        return "depth comparison of a texture";
    key.baseFormat = baseFormatOf(internalFormatOf(*texture));
    const osg::StateAttribute* environment = state.get(unit, SurfaceState::TexEnv);
    if (auto* combine = as<osg::TexEnvCombine>(environment))
    {
        if (!fillCombine(*combine, unit, key))
            return "TexEnvCombine with a texture unit above 3";
    }
    else if (auto* env = as<osg::TexEnv>(environment))
        key.environment = environmentOf(*env);
    key.generated = static_cast<std::uint8_t>((modes / SurfaceState::GenS) & 15);
    if (key.generated)
    {
        auto* generation = as<osg::TexGen>(state.get(unit, SurfaceState::TexGen));
        key.generation = generationOf(generation ? generation->getMode() : osg::TexGen::EYE_LINEAR);
    }
    auto* matrix = as<osg::TexMat>(state.get(unit, SurfaceState::TexMat));
    key.matrix =
        matrix && (!matrix->getMatrix().isIdentity() || matrix->getScaleByTextureRectangleSize());
    return {};
}

} // namespace osgMultiRender
