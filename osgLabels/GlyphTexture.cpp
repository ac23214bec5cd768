// SPDX-License-Identifier: MIT
#include <osgLabels/GlyphTexture.h>

#include <osgLabels/UnpackState.h>

#include <osg/GLExtensions>
#include <osg/Notify>
#include <osg/State>

#include <algorithm>

namespace osgLabels
{

namespace
{

constexpr GLenum Texture2DArray = 0x8C1A, MaxArrayTextureLayers = 0x88FF, R8 = 0x8229;
constexpr int LeastLayers = 64, MostLayers = 2048;

int roundUpToPowerOfTwo(std::size_t count, int least)
{
    int power = least;
    while (static_cast<std::size_t>(power) < count)
        power *= 2;
    return power;
}

} // namespace

struct GlyphTexture::Images
{
    std::mutex mutex;
    std::vector<std::vector<std::uint8_t>> pixels;
};

GlyphTexture::GlyphTexture(GLenum format, int imageWidth, int imageHeight)
    : ContentTexture(format == GL_RGBA ? GL_RGBA8 : R8, LINEAR), _format(format),
      _imageWidth(imageWidth), _imageHeight(imageHeight), _images(std::make_shared<Images>())
{
}

GlyphTexture::GlyphTexture(const GlyphTexture& other, const osg::CopyOp& copyop)
    : osgMultiRender::ContentTexture(other, copyop), _format(other._format),
      _imageWidth(other._imageWidth), _imageHeight(other._imageHeight), _images(other._images)
{
}

void GlyphTexture::add(std::vector<std::uint8_t> pixels)
{
    const std::lock_guard<std::mutex> lock(_images->mutex);
    _images->pixels.push_back(std::move(pixels));
}

std::size_t GlyphTexture::getNumGlyphImages() const
{
    const std::lock_guard<std::mutex> lock(_images->mutex);
    return _images->pixels.size();
}

std::size_t GlyphTexture::getBytes() const
{
    const std::lock_guard<std::mutex> lock(_images->mutex);
    std::size_t bytes = 0;
    for (const std::vector<std::uint8_t>& pixels : _images->pixels)
        bytes += pixels.size();
    return bytes;
}

GLenum GlyphTexture::getTextureTarget() const
{
    return Texture2DArray;
}

void GlyphTexture::apply(osg::State& state) const
{
    if (!_images) // what osg::State unbinds with
    {
        glBindTexture(Texture2DArray, 0);
        return;
    }
    const std::lock_guard<std::mutex> lock(_images->mutex);
    const std::size_t count = _images->pixels.size();
    Uploaded& uploaded = _uploaded[state.getContextID()];
    TextureObject* const object = getTextureObject(state.getContextID());
    const auto capacity =
        static_cast<std::size_t>(uploaded.layers) * static_cast<std::size_t>(uploaded.columns);
    if (!object || count > capacity)
    {
        if (!allocate(state, count, uploaded))
            return;
    }
    else
    {
        object->bind();
        if (getTextureParameterDirty(state.getContextID()))
            applyTexParameters(Texture2DArray, state);
    }
    const auto held =
        static_cast<std::size_t>(uploaded.layers) * static_cast<std::size_t>(uploaded.columns);
    for (; uploaded.images < std::min(count, held); ++uploaded.images)
        upload(state, uploaded.images, uploaded);
}

bool GlyphTexture::allocate(osg::State& state, std::size_t count, Uploaded& uploaded) const
{
    GLint mostLayers = 0, mostTexels = 0;
    glGetIntegerv(MaxArrayTextureLayers, &mostLayers);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostTexels);
    const int limit = mostLayers >= MostLayers ? MostLayers : 256; // GL 3.0 has 256 at least
    const int layers = std::min(roundUpToPowerOfTwo(count, LeastLayers), limit);
    const std::size_t perColumn = static_cast<std::size_t>(layers);
    int columns = roundUpToPowerOfTwo((count + perColumn - 1) / perColumn, 1);
    const int mostColumns = std::max(1, mostTexels / std::max(1, _imageWidth));
    if (columns > mostColumns)
    {
        OSG_WARN << "osgLabels::GlyphTexture: " << count << " glyphs are more than a texture of "
                 << mostTexels << " texels a side holds; the last ones are not shown\n";
        columns = mostColumns;
    }
    const unsigned int contextID = state.getContextID();
    if (uploaded.layers == layers && uploaded.columns == columns && getTextureObject(contextID))
    {
        getTextureObject(contextID)->bind();
        return true;
    }
    _textureObjectBuffer[contextID] = nullptr;
    generateAndAssignTextureObject(contextID, Texture2DArray, 1, _internalFormat,
                                   columns * _imageWidth, _imageHeight, layers, 0)
        ->bind();
    applyTexParameters(Texture2DArray, state);
    const UnpackState unpack(*state.get<osg::GLExtensions>());
    state.get<osg::GLExtensions>()->glTexImage3D(Texture2DArray, 0, _internalFormat,
                                                 columns * _imageWidth, _imageHeight, layers, 0,
                                                 _format, GL_UNSIGNED_BYTE, nullptr);
    getTextureObject(contextID)->setAllocated(true);
    uploaded.images = 0;
    uploaded.layers = layers;
    uploaded.columns = columns;
    return true;
}

void GlyphTexture::upload(osg::State& state, std::size_t image, const Uploaded& uploaded) const
{
    const auto layers = static_cast<std::size_t>(uploaded.layers);
    const UnpackState unpack(*state.get<osg::GLExtensions>());
    state.get<osg::GLExtensions>()->glTexSubImage3D(
        Texture2DArray, 0, static_cast<GLint>(image / layers) * _imageWidth, 0,
        static_cast<GLint>(image % layers), _imageWidth, _imageHeight, 1, _format, GL_UNSIGNED_BYTE,
        _images->pixels[image].data());
}

} // namespace osgLabels
