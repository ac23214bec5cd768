// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceSource.h>

#include <osgMultiRender/Shaders.h>

#include <osg/Shader>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace osgMultiRender
{

namespace
{

/// Text of a shader file: found on OSG_FILE_PATH, else the built-in one.
std::string shaderText(osg::Shader::Type type, const char* file, const char* fallback)
{
    osg::ref_ptr<osg::Shader> shader = osgDB::readRefShaderFileWithFallback(type, file, fallback);
    return shader ? shader->getShaderSource() : std::string(fallback);
}

std::string definesOf(const SurfaceKey& key)
{
    std::ostringstream text;
    const auto define = [&text](bool on, const char* name)
    {
        if (on)
            text << "#define " << name << "\n";
    };
    define(key.lighting == LightingMode::Vertex, "OSGMR_LIGHTING_VERTEX");
    define(key.lighting == LightingMode::Pixel, "OSGMR_LIGHTING_PIXEL");
    define(key.usesNormals(), "OSGMR_NORMALS");
    define(key.usesEyePosition(), "OSGMR_EYE");
    define(key.normalScaling == SurfaceKey::Normalized, "OSGMR_NORMALIZE");
    define(key.normalScaling == SurfaceKey::Rescaled, "OSGMR_RESCALE");
    define(key.twoSided, "OSGMR_TWO_SIDED");
    define(key.localViewer, "OSGMR_LOCAL_VIEWER");
    define(key.specular, "OSGMR_SPECULAR");
    define(key.separateSpecular, "OSGMR_SEPARATE_SPECULAR");
    define(key.colorSum, "OSGMR_COLOR_SUM");
    define(key.fogCoordinate, "OSGMR_FOG_COORDINATE");
    define(key.clip, "OSGMR_CLIP");
    define(key.instance, "OSGMR_INSTANCE");
    text << "#define OSGMR_COLOR_MODE " << int(key.colorMode) << "\n";
    text << "#define OSGMR_FLAT " << (key.flat ? "flat" : "smooth") << "\n";
    if (key.fog)
        text << "#define OSGMR_FOG " << int(key.fog) << "\n";
    return text.str();
}

std::string lightsOf(const SurfaceKey& key)
{
    std::ostringstream text;
    text << "void osgmr_lights(vec3 normal, float shininess)\n{\n";
    for (std::size_t i = 0; i < key.lights.size(); ++i)
        if (key.lights[i])
            text << "    osgmr_addLight(gl_LightSource[" << i << "], " << int(key.lights[i])
                 << ", normal, shininess);\n";
    text << "}\n";
    return text.str();
}

/// Texture coordinates of one unit, OpenGL 2.1 specification, section 2.11.4.
void writeTexCoord(std::ostream& text, unsigned int unit, const TextureKey& key)
{
    text << "    {\n        vec4 coord = gl_MultiTexCoord" << unit << ";\n";
    if (key.generated && key.generation == TextureKey::SphereMap)
        text << "        vec3 u = normalize(osgmr_eye.xyz);\n"
                "        vec3 r = u - 2.0 * osgmr_vNormal * dot(osgmr_vNormal, u);\n"
                "        float m = 2.0 * sqrt(r.x * r.x + r.y * r.y + (r.z + 1.0) * (r.z + 1.0));\n"
                "        vec4 generated = vec4(r.xy / m + 0.5, 0.0, 1.0);\n";
    else if (key.generated && key.generation == TextureKey::ReflectionMap)
        text << "        vec3 u = normalize(osgmr_eye.xyz);\n"
                "        vec4 generated = vec4(u - 2.0 * osgmr_vNormal * dot(osgmr_vNormal, u), "
                "1.0);\n";
    else if (key.generated && key.generation == TextureKey::NormalMap)
        text << "        vec4 generated = vec4(osgmr_vNormal, 1.0);\n";
    else if (key.generated)
    {
        const bool eye = key.generation == TextureKey::EyeLinear;
        const char* from = eye ? "osgmr_eye4" : "OSGMR_VERTEX";
        const char* plane = eye ? "gl_EyePlane" : "gl_ObjectPlane";
        if (eye)
            text << "        vec4 osgmr_eye4 = gl_ModelViewMatrix * OSGMR_VERTEX;\n";
        text << "        vec4 generated = vec4(";
        for (unsigned int i = 0; i < 4; ++i)
            text << (i ? ", " : "") << "dot(" << from << ", " << plane << "STRQ"[i] << "[" << unit
                 << "])";
        text << ");\n";
    }
    for (unsigned int i = 0; i < 4; ++i)
        if (key.generated & (1u << i))
            text << "        coord."
                 << "xyzw"[i] << " = generated."
                 << "xyzw"[i] << ";\n";
    text << "        gl_TexCoord[" << unit << "] = " << (key.matrix ? "gl_TextureMatrix[" : "");
    if (key.matrix)
        text << unit << "] * ";
    text << "coord;\n    }\n";
}

std::string texCoordsOf(const SurfaceKey& key)
{
    std::ostringstream text;
    text << "void osgmr_texCoords()\n{\n";
    for (unsigned int unit = 0; unit < key.textures.size(); ++unit)
        if (key.textures[unit].target)
            writeTexCoord(text, unit, key.textures[unit]);
    text << "}\n";
    return text.str();
}

std::string fetchOf(unsigned int unit, const TextureKey& key)
{
    const std::string sampler = "osgmr_texture" + std::to_string(unit);
    const std::string coord = "gl_TexCoord[" + std::to_string(unit) + "]";
    if (key.sampled)
        return "osgmr_sample(" + std::to_string(unit) + ", " + sampler + ", " + coord + ".st / " +
               coord + ".q)";
    if (key.target == TextureKey::TargetCube)
        return "texture(" + sampler + ", " + coord + ".xyz)";
    return "textureProj(" + sampler + ", " + coord + ")";
}

/// The texture environments, OpenGL 2.1 specification, tables 3.22 and 3.23. What these leave
/// undefined (GL_DECAL without RGB) keeps the colour, as NV_texture_shader and Mesa do.
void writeEnvironment(std::ostream& text, unsigned int unit, const TextureKey& key)
{
    const std::string t = "t" + std::to_string(unit);
    const std::string constant = "gl_TextureEnvColor[" + std::to_string(unit) + "]";
    const bool hasColor = key.baseFormat != TextureKey::Alpha;
    const bool hasAlpha =
        key.baseFormat != TextureKey::RGB && key.baseFormat != TextureKey::Luminance;
    std::string rgb = "c.rgb", alpha = "c.a";
    switch (key.environment)
    {
    case TextureKey::Replace:
        rgb = hasColor ? t + ".rgb" : rgb;
        alpha = hasAlpha ? t + ".a" : alpha;
        break;
    case TextureKey::Decal:
        if (key.baseFormat == TextureKey::RGB)
            rgb = t + ".rgb";
        else if (key.baseFormat == TextureKey::RGBA)
            rgb = "mix(c.rgb, " + t + ".rgb, " + t + ".a)";
        break;
    case TextureKey::Blend:
        rgb = hasColor ? "mix(c.rgb, " + constant + ".rgb, " + t + ".rgb)" : rgb;
        if (key.baseFormat == TextureKey::Intensity)
            alpha = "mix(c.a, " + constant + ".a, " + t + ".a)";
        else
            alpha = hasAlpha ? "c.a * " + t + ".a" : alpha;
        break;
    case TextureKey::Add:
        rgb = hasColor ? "c.rgb + " + t + ".rgb" : rgb;
        if (key.baseFormat == TextureKey::Intensity)
            alpha = "c.a + " + t + ".a";
        else
            alpha = hasAlpha ? "c.a * " + t + ".a" : alpha;
        break;
    default:
        rgb = hasColor ? "c.rgb * " + t + ".rgb" : rgb;
        alpha = hasAlpha ? "c.a * " + t + ".a" : alpha;
        break;
    }
    text << "    c = clamp(vec4(" << rgb << ", " << alpha << "), 0.0, 1.0);\n";
}

/// One argument of TexEnvCombine, as "vec3" for RGB and "float" for alpha.
std::string combineArgument(const SurfaceKey& surface, unsigned int unit, std::uint8_t source,
                            std::uint8_t operand, bool alpha)
{
    std::string value;
    if (source <= SourceTexture3)
        // A unit that is off has no texture to give; the previous colour keeps the result defined.
        value = surface.textures[source].target ? "t" + std::to_string(source) : std::string("c");
    else if (source == SourceConstant)
        value = "gl_TextureEnvColor[" + std::to_string(unit) + "]";
    else
        value = source == SourcePrimary ? "primary" : "c";
    const bool ofAlpha = alpha || operand >= 2;
    const std::string swizzled = value + (alpha ? ".a" : ofAlpha ? ".aaa" : ".rgb");
    return operand & 1 ? "(1.0 - " + swizzled + ")" : swizzled;
}

std::string combineFunction(std::uint8_t function, const std::string (&a)[3], bool alpha)
{
    switch (function)
    {
    case 0:
        return a[0];
    case 2:
        return a[0] + " + " + a[1];
    case 3:
        return a[0] + " + " + a[1] + " - 0.5";
    case 4:
        return "mix(" + a[1] + ", " + a[0] + ", " + a[2] + ")";
    case 5:
        return a[0] + " - " + a[1];
    case 6:
    case 7:
        if (!alpha)
            return "vec3(4.0 * dot(" + a[0] + " - 0.5, " + a[1] + " - 0.5))";
        return a[0] + " * " + a[1];
    default:
        return a[0] + " * " + a[1];
    }
}

void writeCombine(std::ostream& text, unsigned int unit, const SurfaceKey& surface)
{
    const TextureKey& key = surface.textures[unit];
    std::string rgb[3], alpha[3];
    for (unsigned int i = 0; i < 3; ++i)
    {
        rgb[i] = combineArgument(surface, unit, key.source[i], key.operand[i], false);
        alpha[i] = combineArgument(surface, unit, key.source[3 + i], key.operand[3 + i], true);
    }
    text << "    {\n        vec3 rgb = " << (1 << key.scale[0]) << ".0 * ("
         << combineFunction(key.function[0], rgb, false) << ");\n";
    if (key.function[0] == 7) // GL_DOT3_RGBA writes alpha too
        text << "        float alpha = rgb.r;\n";
    else
        text << "        float alpha = " << (1 << key.scale[1]) << ".0 * ("
             << combineFunction(key.function[1], alpha, true) << ");\n";
    text << "        c = clamp(vec4(rgb, alpha), 0.0, 1.0);\n    }\n";
}

std::string texturesOf(const SurfaceKey& key)
{
    static const char* const samplers[] = {"",          "sampler1D",   "sampler2D",
                                           "sampler3D", "samplerCube", "sampler2DRect"};
    std::ostringstream text;
    for (unsigned int unit = 0; unit < key.textures.size(); ++unit)
        if (key.textures[unit].target)
            text << "uniform " << samplers[key.textures[unit].target] << " osgmr_texture" << unit
                 << ";\n";
    if (std::any_of(key.textures.begin(), key.textures.end(),
                    [](const TextureKey& texture) { return texture.sampled; }))
        text << "vec4 osgmr_sample(int unit, sampler2D own, vec2 coord);\n";
    text << "vec4 osgmr_textures(vec4 primary)\n{\n    vec4 c = primary;\n";
    for (unsigned int unit = 0; unit < key.textures.size(); ++unit)
        if (key.textures[unit].target)
            text << "    vec4 t" << unit << " = " << fetchOf(unit, key.textures[unit]) << ";\n";
    for (unsigned int unit = 0; unit < key.textures.size(); ++unit)
    {
        const TextureKey& texture = key.textures[unit];
        if (texture.target && texture.environment == TextureKey::Combine)
            writeCombine(text, unit, key);
        else if (texture.target)
            writeEnvironment(text, unit, texture);
    }
    text << "    return c;\n}\n";
    return text.str();
}

} // namespace

std::string glslVersionLine(float languageVersion)
{
    const int version = std::clamp(int(std::lround(languageVersion * 100.0f)), 330, 450);
    return "#version " + std::to_string(version) + " compatibility\n";
}

SurfaceSource makeSurfaceSource(const SurfaceKey& key, const VertexParts& parts)
{
    const std::string defines = definesOf(key);
    SurfaceSource source;
    source.vertex = defines + shaderText(osg::Shader::VERTEX, "osgMultiRender/surface.vert",
                                         shaders::surface_vert);
    if (key.lighting == LightingMode::Vertex)
        source.vertex += lightsOf(key);
    source.vertex += texCoordsOf(key) + parts.instance + parts.text +
                     "void main()\n{\n    osgmr_vertex();\n" + parts.statements + "}\n";
    source.fragment =
        defines +
        shaderText(osg::Shader::FRAGMENT, "osgMultiRender/surface.frag", shaders::surface_frag) +
        texturesOf(key);
    return source;
}

} // namespace osgMultiRender
