// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/GlslWrap.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace osgMultiRender
{

/// One shader object of a rendering.
struct RenderingShader
{
    GlslStage stage = GlslStage::Fragment;
    std::string text;
    std::string fileName; ///< As it is named in messages.
};

/// What is known of a uniform beside its declaration in the shaders.
struct RenderingUniform
{
    std::string name;
    std::string type; ///< "float", "vec3", "sampler2D"; empty: as declared.
    int arraySize = 1;
    std::vector<double> values; ///< Components of all elements; empty: what the shaders say.
    double minimum = 0.0, maximum = 1.0; ///< What a user may choose; equal: anything.
};

/// A texture of a rendering's own. Numbers are OpenGL's.
struct RenderingTexture
{
    unsigned int unit = 0;           ///< As the rendering's sampler uniforms count.
    std::string fileName;            ///< Relative to the rendering's file or absolute.
    std::vector<std::string> faces;  ///< Of cube maps: +x, -x, +y, -y, +z, -z; else empty.
    unsigned int target = 0x0DE1;    ///< GL_TEXTURE_2D
    unsigned int minFilter = 0x2703; ///< GL_LINEAR_MIPMAP_LINEAR
    unsigned int magFilter = 0x2601; ///< GL_LINEAR
    std::array<unsigned int, 3> wrap = {0x2901, 0x2901, 0x2901}; ///< s, t, r; GL_REPEAT
};

using RenderingColor = std::array<float, 4>;

struct RenderingMaterial
{
    RenderingColor ambient = {0.2f, 0.2f, 0.2f, 1.0f};
    RenderingColor diffuse = {0.8f, 0.8f, 0.8f, 1.0f};
    RenderingColor specular = {0.0f, 0.0f, 0.0f, 1.0f};
    RenderingColor emission = {0.0f, 0.0f, 0.0f, 1.0f};
    float shininess = 0.0f; ///< 0 to 128.
};

struct RenderingLight
{
    unsigned int number = 0;
    bool enabled = false;
    RenderingColor position = {0.0f, 0.0f, 1.0f, 0.0f}; ///< Eye coordinates.
    RenderingColor ambient = {0.0f, 0.0f, 0.0f, 1.0f};
    RenderingColor diffuse = {1.0f, 1.0f, 1.0f, 1.0f};
    RenderingColor specular = {1.0f, 1.0f, 1.0f, 1.0f};
    std::array<float, 3> spotDirection = {0.0f, 0.0f, -1.0f};
    float spotExponent = 0.0f;
    float spotCutoff = 180.0f;                             ///< Degrees.
    std::array<float, 3> attenuation = {1.0f, 0.0f, 0.0f}; ///< Constant, linear, quadratic.
};

/// The fixed state that a rendering was made under. A mix takes what is the program's own: two
/// sides, flat shading, and the alpha test, which takes the rendering's weight away. Materials,
/// lights and the ambient light are the scene's, or, with MergeOptions::ownLighting, these. All
/// else is the model's: culling, polygon modes, blending and depth, which are of all that a
/// drawable shows.
struct RenderingState
{
    bool given = false;        ///< False: the description holds no state.
    bool hasMaterials = false; ///< And the ambient light.
    RenderingColor modelAmbient = {0.2f, 0.2f, 0.2f, 1.0f};
    RenderingMaterial front, back;
    std::vector<RenderingLight> lights;
    bool cullFace = false;
    bool twoSided = false; ///< GL_VERTEX_PROGRAM_TWO_SIDE: gl_Color is gl_BackColor behind.
    unsigned int polygonModeFront = 0x1B02, polygonModeBack = 0x1B02; ///< GL_FILL
    unsigned int shadeModel = 0x1D01;                                 ///< GL_SMOOTH
    bool alphaTest = false;
    unsigned int alphaFunction = 0x0204; ///< GL_GREATER
    float alphaReference = 0.0f;
    bool blending = false;
    unsigned int blendSource = 0x0302, blendDestination = 0x0303, blendEquation = 0x8006;
    bool depthTest = true;
    unsigned int depthFunction = 0x0203; ///< GL_LEQUAL
    RenderingColor clearColor = {0.0f, 0.0f, 0.0f, 1.0f};
};

/// A finding of an import, as a user reads it: "phong.gdp: …", one line.
struct RenderingMessage
{
    bool error = false; ///< The rendering can't be used.
    std::string text;
};

/// A complete GPU program with what it needs to run: what every import fills.
///
/// Holds data only.
struct Rendering
{
    std::string name;     ///< Of the file without folder and extension: "phong".
    std::string fileName; ///< What was imported; empty if it is no file.
    std::vector<RenderingShader> shaders;
    std::vector<RenderingUniform> uniforms;
    std::vector<RenderingTexture> textures;
    RenderingState state;
    std::map<std::string, unsigned int> attributeBindings;
    std::map<std::string, unsigned int> fragmentDataBindings;
    std::map<std::string, std::string> defines; ///< Macros that are set before the text.
    std::vector<RenderingMessage> messages;

    /// True if it has shaders and no message is an error.
    bool ok() const;

    const RenderingUniform* findUniform(const std::string& uniformName) const;
    const RenderingTexture* findTexture(unsigned int unit) const;
};

inline bool Rendering::ok() const
{
    for (const RenderingMessage& message : messages)
    {
        if (message.error)
        {
            return false;
        }
    }
    return !shaders.empty();
}

inline const RenderingUniform* Rendering::findUniform(const std::string& uniformName) const
{
    for (const RenderingUniform& uniform : uniforms)
    {
        if (uniform.name == uniformName)
        {
            return &uniform;
        }
    }
    return nullptr;
}

inline const RenderingTexture* Rendering::findTexture(unsigned int unit) const
{
    for (const RenderingTexture& texture : textures)
    {
        if (texture.unit == unit)
        {
            return &texture;
        }
    }
    return nullptr;
}

} // namespace osgMultiRender
