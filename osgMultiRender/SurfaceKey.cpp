// SPDX-License-Identifier: MIT
#include <osgMultiRender/SurfaceKey.h>

#include <osgMultiRender/SurfaceTexture.h>

#include <osg/Fog>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/Point>
#include <osg/ShadeModel>

#include <sstream>

namespace osgMultiRender
{

namespace
{

template <class T> const T* as(const osg::StateAttribute* attribute)
{
    return dynamic_cast<const T*>(attribute);
}

std::uint8_t colorModeOf(const osg::Material* material)
{
    if (!material)
        return SurfaceKey::ColorOff;
    switch (material->getColorMode())
    {
    case osg::Material::AMBIENT:
        return SurfaceKey::Ambient;
    case osg::Material::DIFFUSE:
        return SurfaceKey::Diffuse;
    case osg::Material::SPECULAR:
        return SurfaceKey::Specular;
    case osg::Material::EMISSION:
        return SurfaceKey::Emission;
    case osg::Material::AMBIENT_AND_DIFFUSE:
        return SurfaceKey::AmbientAndDiffuse;
    default:
        return SurfaceKey::ColorOff;
    }
}

bool isBlack(const osg::Vec4& color)
{
    return color.r() == 0.0f && color.g() == 0.0f && color.b() == 0.0f;
}

/// GL's own default material, too, has a black specular colour.
bool hasSpecular(const osg::Material* material)
{
    if (!material)
        return false;
    return material->getColorMode() == osg::Material::SPECULAR ||
           !isBlack(material->getSpecular(osg::Material::FRONT)) ||
           !isBlack(material->getSpecular(osg::Material::BACK));
}

std::uint8_t typeOf(const osg::Light* light)
{
    if (!light) // GL's own default: directional.
        return SurfaceKey::Directional;
    if (light->getPosition().w() == 0.0f)
        return light->getSpotCutoff() == 180.0f ? SurfaceKey::Directional
                                                : SurfaceKey::DirectionalSpot;
    return light->getSpotCutoff() == 180.0f ? SurfaceKey::Point : SurfaceKey::Spot;
}

void fillLighting(const SurfaceState& state, LightingMode lighting, const GLLights& positioned,
                  SurfaceKey& key)
{
    if (!state.isOn(SurfaceState::Lighting) || lighting == LightingMode::Off)
        return;
    key.lighting = lighting;
    auto* material = as<osg::Material>(state.get(SurfaceState::Material));
    key.colorMode = colorModeOf(material);
    key.specular = hasSpecular(material);
    if (auto* model = as<osg::LightModel>(state.get(SurfaceState::LightModel)))
    {
        key.twoSided = model->getTwoSided();
        key.localViewer = key.specular && model->getLocalViewer();
        key.separateSpecular =
            key.specular && model->getColorControl() == osg::LightModel::SEPARATE_SPECULAR_COLOR;
    }
    if (lighting == LightingMode::Pixel)
    {
        auto* shade = as<osg::ShadeModel>(state.get(SurfaceState::ShadeModel));
        key.flat = shade && shade->getMode() == osg::ShadeModel::FLAT;
        return;
    }
    for (unsigned int i = 0; i < SurfaceState::MaxGLLights; ++i)
        if (state.isLightOn(i))
            key.lights[i] = typeOf(state.getLight(i) ? state.getLight(i) : positioned[i]);
}

void fillFog(const SurfaceState& state, SurfaceKey& key)
{
    if (!state.isOn(SurfaceState::Fog))
        return;
    auto* fog = as<osg::Fog>(state.get(SurfaceState::FogAttribute));
    if (!fog) // GL's own default.
    {
        key.fog = SurfaceKey::Exp;
        return;
    }
    key.fog = fog->getMode() == osg::Fog::LINEAR ? SurfaceKey::Linear
              : fog->getMode() == osg::Fog::EXP  ? SurfaceKey::Exp
                                                 : SurfaceKey::Exp2;
    key.fogCoordinate = fog->getFogCoordinateSource() == osg::Fog::FOG_COORDINATE;
}

std::string beyond(const SurfaceState& state)
{
    if (state.isOn(SurfaceState::AssemblyProgram))
        return "an ARB vertex or fragment program";
    if (state.isOn(SurfaceState::PointSprites))
        return "point sprites";
    if (state.usesUnitsBeyond())
        return "a texture unit above 3";
    if (auto* point = as<osg::Point>(state.get(SurfaceState::Point)))
        if (point->getDistanceAttenuation() != osg::Vec3(1.0f, 0.0f, 0.0f))
            return "distance attenuation of points";
    return {};
}

} // namespace

std::string makeSurfaceKey(const SurfaceState& state, LightingMode lighting,
                           const GLLights& positioned, unsigned int contextID, SurfaceKey& key)
{
    key = SurfaceKey();
    std::string reason = beyond(state);
    if (!reason.empty())
        return reason;
    fillLighting(state, lighting, positioned, key);
    fillFog(state, key);
    key.colorSum = key.lighting == LightingMode::Off && state.isOn(SurfaceState::ColorSum);
    key.clip = (state.getModes() & (SurfaceState::ClipPlane0 * 255u)) != 0;
    for (unsigned int unit = 0; unit < SurfaceState::MaxTextureUnits; ++unit)
    {
        reason = fillTexture(state, unit, contextID, key);
        if (!reason.empty())
            return reason;
    }
    if (key.usesNormals())
        key.normalScaling = state.isOn(SurfaceState::Normalize)       ? SurfaceKey::Normalized
                            : state.isOn(SurfaceState::RescaleNormal) ? SurfaceKey::Rescaled
                                                                      : SurfaceKey::AsIs;
    return {};
}

bool SurfaceKey::usesNormals() const
{
    if (lighting != LightingMode::Off)
        return true;
    for (const TextureKey& unit : textures)
        if (unit.target && unit.generated && unit.generation >= TextureKey::SphereMap)
            return true;
    return false;
}

bool SurfaceKey::usesEyePosition() const
{
    if (lighting != LightingMode::Off || (fog && !fogCoordinate) || clip)
        return true;
    for (const TextureKey& unit : textures)
        if (unit.target && unit.generated && unit.generation != TextureKey::ObjectLinear &&
            unit.generation != TextureKey::NormalMap)
            return true;
    return false;
}

namespace
{

bool equal(const TextureKey& a, const TextureKey& b)
{
    return a.target == b.target && a.environment == b.environment && a.baseFormat == b.baseFormat &&
           a.generation == b.generation && a.generated == b.generated && a.matrix == b.matrix &&
           a.sampled == b.sampled && a.function == b.function && a.source == b.source &&
           a.operand == b.operand && a.scale == b.scale;
}

struct Hasher
{
    std::uint64_t value = 1469598103934665603ull; // FNV-1a
    void add(std::uint64_t x) { value = (value ^ x) * 1099511628211ull; }
    template <class Array> void addAll(const Array& array)
    {
        for (std::uint8_t x : array)
            add(x);
    }
};

} // namespace

bool SurfaceKey::operator==(const SurfaceKey& other) const
{
    for (std::size_t i = 0; i < textures.size(); ++i)
        if (!equal(textures[i], other.textures[i]))
            return false;
    return lighting == other.lighting && normalScaling == other.normalScaling &&
           twoSided == other.twoSided && localViewer == other.localViewer &&
           specular == other.specular && separateSpecular == other.separateSpecular &&
           colorMode == other.colorMode && colorSum == other.colorSum && flat == other.flat &&
           fog == other.fog && fogCoordinate == other.fogCoordinate && clip == other.clip &&
           lights == other.lights && kit == other.kit && output == other.output &&
           texture == other.texture && program == other.program && instance == other.instance;
}

std::size_t SurfaceKeyHash::operator()(const SurfaceKey& key) const
{
    Hasher hash;
    for (std::uint64_t x :
         {std::uint64_t(key.lighting), std::uint64_t(key.normalScaling),
          std::uint64_t(key.twoSided), std::uint64_t(key.localViewer), std::uint64_t(key.specular),
          std::uint64_t(key.separateSpecular), std::uint64_t(key.colorMode),
          std::uint64_t(key.colorSum), std::uint64_t(key.flat), std::uint64_t(key.fog),
          std::uint64_t(key.fogCoordinate), std::uint64_t(key.clip), std::uint64_t(key.kit),
          std::uint64_t(key.output), std::uint64_t(key.texture), key.program, key.instance})
        hash.add(x);
    hash.addAll(key.lights);
    for (const TextureKey& texture : key.textures)
    {
        if (!texture.target)
            continue;
        for (std::uint8_t x :
             {texture.target, texture.environment, texture.baseFormat, texture.generation,
              texture.generated, texture.matrix, texture.sampled})
            hash.add(x);
        hash.addAll(texture.function);
        hash.addAll(texture.source);
        hash.addAll(texture.operand);
        hash.addAll(texture.scale);
    }
    return static_cast<std::size_t>(hash.value);
}

std::string toString(const SurfaceKey& key)
{
    static const char* const modes[] = {"off", "vertex", "pixel"};
    static const char* const lights[] = {"", "directional", "point", "spot", "directional-spot"};
    static const char* const scalings[] = {"", "normalize", "rescale"};
    static const char* const colors[] = {"",         "ambient",  "diffuse",
                                         "specular", "emission", "ambient+diffuse"};
    static const char* const fogs[] = {"", "linear", "exp", "exp2"};
    static const char* const targets[] = {"", "1D", "2D", "3D", "cube", "rectangle"};
    static const char* const environments[] = {"modulate", "replace", "decal",
                                               "blend",    "add",     "combine"};
    static const char* const formats[] = {"RGB", "RGBA", "A", "L", "LA", "I"};
    static const char* const generations[] = {"object", "eye", "sphere", "normal", "reflection"};

    std::ostringstream text;
    const auto flag = [&text](bool on, const char* name)
    {
        if (on)
            text << " " << name;
    };
    if (key.program)
        text << " program=" << std::hex << key.program << std::dec;
    if (key.lighting != LightingMode::Off)
        text << " lighting=" << modes[int(key.lighting)];
    for (std::size_t i = 0; i < key.lights.size(); ++i)
        if (key.lights[i])
            text << " light" << i << "=" << lights[key.lights[i]];
    flag(key.normalScaling, scalings[key.normalScaling]);
    flag(key.twoSided, "two-sided");
    flag(key.localViewer, "local-viewer");
    flag(key.specular && !key.separateSpecular, "specular");
    flag(key.separateSpecular, "separate-specular");
    if (key.colorMode)
        text << " color=" << colors[key.colorMode];
    flag(key.colorSum, "color-sum");
    flag(key.flat, "flat");
    for (std::size_t i = 0; i < key.textures.size(); ++i)
    {
        const TextureKey& texture = key.textures[i];
        if (!texture.target)
            continue;
        text << " tex" << i << "=" << targets[texture.target] << "/"
             << environments[texture.environment] << "/" << formats[texture.baseFormat];
        if (texture.generated)
            text << "/gen-" << generations[texture.generation];
        if (texture.matrix)
            text << "/matrix";
        if (texture.sampled)
            text << "/sampled";
    }
    if (key.fog)
        text << " fog=" << fogs[key.fog] << (key.fogCoordinate ? "/coordinate" : "");
    flag(key.clip, "clip");
    if (key.kit)
        text << " kit=" << std::hex << key.kit;
    if (key.output)
        text << " output=" << std::hex << key.output;
    if (key.texture)
        text << " texture=" << std::hex << key.texture;
    flag(key.instance != 0, "instanced");
    const std::string words = text.str();
    return words.empty() ? "plain" : words.substr(1);
}

} // namespace osgMultiRender
