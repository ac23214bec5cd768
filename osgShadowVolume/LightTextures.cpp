// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightTextures.h>

#include <osg/Image>

#include <cmath>
#include <cstring>

namespace osgShadowVolume
{

namespace
{

constexpr int texelsPerLight = FloatsPerLight / 4;
constexpr int lightsPerRow = 256;
constexpr int listPerRow = 1024;

osg::ref_ptr<osg::Texture2D> makeTexture(GLint internalFormat, GLenum format, GLenum type)
{
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setInternalFormat(internalFormat);
    texture->setSourceFormat(format);
    texture->setSourceType(type);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

/// Puts `bytes` into the texture's image, which grows to powers of two and never shrinks.
void update(osg::Texture2D& texture, int width, int rows, GLint internalFormat, GLenum format,
            GLenum type, const void* data, std::size_t bytes)
{
    osg::Image* image = texture.getImage();
    if (!image || image->s() != width || image->t() < rows)
    {
        int capacity = 1;
        while (capacity < rows)
            capacity *= 2;
        osg::ref_ptr<osg::Image> larger = new osg::Image;
        larger->setDataVariance(osg::Object::DYNAMIC); // never freed after the upload
        larger->allocateImage(width, capacity, 1, format, type);
        larger->setInternalTextureFormat(internalFormat);
        std::memset(larger->data(), 0, larger->getTotalSizeInBytes());
        texture.setImage(larger);
        image = larger.get();
    }
    else if (std::memcmp(image->data(), data, bytes) == 0)
        return;
    std::memcpy(image->data(), data, bytes);
    image->dirty();
}

} // namespace

void packLight(const EyeLight& light, float shadow, float* to)
{
    const float cosine =
        static_cast<float>(std::cos(glm::radians(double(light.spotCutoffDegrees))));
    const float values[FloatsPerLight] = {float(light.position.x),
                                          float(light.position.y),
                                          float(light.position.z),
                                          float(light.type),
                                          light.ambient.x,
                                          light.ambient.y,
                                          light.ambient.z,
                                          light.constantAttenuation,
                                          light.diffuse.x,
                                          light.diffuse.y,
                                          light.diffuse.z,
                                          light.linearAttenuation,
                                          light.specular.x,
                                          light.specular.y,
                                          light.specular.z,
                                          light.quadraticAttenuation,
                                          float(light.spotDirection.x),
                                          float(light.spotDirection.y),
                                          float(light.spotDirection.z),
                                          cosine,
                                          light.spotExponent,
                                          shadow,
                                          float(light.luxAtUnit),
                                          0.0f};
    std::memcpy(to, values, sizeof(values));
}

LitScene::LightTextures::Context::Context()
    : osg::Referenced(true), lights(makeTexture(GL_RGBA32F_ARB, GL_RGBA, GL_FLOAT)),
      lists(makeTexture(GL_R32I, GL_RED_INTEGER_EXT, GL_INT)), stateSet(new osg::StateSet)
{
    stateSet->setTextureAttribute(LightsUnit, lights, osg::StateAttribute::OVERRIDE);
    stateSet->setTextureAttribute(ListsUnit, lists, osg::StateAttribute::OVERRIDE);
}

void LitScene::LightTextures::Context::set(const LitPass* pass,
                                           const std::vector<const EyeLight*>& eyeLights,
                                           const std::vector<float>& shadows,
                                           const std::vector<std::int32_t>& list)
{
    _pass = pass;
    // Rows are whole: the tail of the last one stays as it was, and nothing reads it.
    const int lightRows =
        std::max<int>(1, int((eyeLights.size() + lightsPerRow - 1) / lightsPerRow));
    std::vector<float> data(std::size_t(lightRows) * lightsPerRow * FloatsPerLight, 0.0f);
    for (std::size_t i = 0; i < eyeLights.size(); ++i)
        packLight(*eyeLights[i], shadows[i], &data[i * FloatsPerLight]);
    update(*lights, lightsPerRow * texelsPerLight, lightRows, GL_RGBA32F_ARB, GL_RGBA, GL_FLOAT,
           data.data(), data.size() * sizeof(float));

    const int listRows = std::max<int>(1, int((list.size() + listPerRow - 1) / listPerRow));
    std::vector<std::int32_t> padded(list);
    padded.resize(std::size_t(listRows) * listPerRow, 0);
    update(*lists, listPerRow, listRows, GL_R32I, GL_RED_INTEGER_EXT, GL_INT, padded.data(),
           padded.size() * sizeof(std::int32_t));
}

osg::ref_ptr<LitScene::LightTextures::Context> LitScene::LightTextures::get(unsigned int contextID)
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<Context>& context = _contexts[contextID];
    if (!context)
        context = new Context;
    return context;
}

void LitScene::LightTextures::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [id, context] : _contexts)
        if (!state || state->getContextID() == id)
            context->stateSet->releaseGLObjects(state);
}

} // namespace osgShadowVolume
