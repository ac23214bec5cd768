// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixTexture.h>

#include <osg/Notify>
#include <osg/Texture1D>
#include <osg/Texture2D>
#include <osg/Texture3D>
#include <osg/TextureCubeMap>
#include <osg/TextureRectangle>
#include <osgDB/ReadFile>

namespace osgMultiRender
{

namespace
{

osg::ref_ptr<osg::Texture> makeTexture(unsigned int target)
{
    switch (target)
    {
    case GL_TEXTURE_1D:
        return new osg::Texture1D;
    case GL_TEXTURE_3D:
        return new osg::Texture3D;
    case GL_TEXTURE_CUBE_MAP:
        return new osg::TextureCubeMap;
    case GL_TEXTURE_RECTANGLE:
        return new osg::TextureRectangle;
    default:
        return new osg::Texture2D;
    }
}

osg::ref_ptr<osg::Image> whiteImage()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f), 0, 0);
    return image;
}

osg::ref_ptr<osg::Image> readImage(const std::string& fileName)
{
    osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->setObjectCacheHint(osgDB::Options::CACHE_IMAGES);
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(fileName, options);
    if (image)
        return image;
    OSG_WARN << "osgMultiRender::MixedScene: the texture '" << fileName
             << "' can't be read and is white; put the file there or name another one" << std::endl;
    return whiteImage();
}

} // namespace

osg::ref_ptr<osg::Texture> readTexture(const RenderingTexture& texture)
{
    osg::ref_ptr<osg::Texture> result = makeTexture(texture.target);
    result->setFilter(osg::Texture::MIN_FILTER, osg::Texture::FilterMode(texture.minFilter));
    result->setFilter(osg::Texture::MAG_FILTER, osg::Texture::FilterMode(texture.magFilter));
    const osg::Texture::WrapParameter axes[] = {osg::Texture::WRAP_S, osg::Texture::WRAP_T,
                                                osg::Texture::WRAP_R};
    for (std::size_t i = 0; i < texture.wrap.size(); ++i)
        result->setWrap(axes[i], osg::Texture::WrapMode(texture.wrap[i]));
    if (texture.faces.empty())
    {
        const osg::ref_ptr<osg::Image> image = readImage(texture.fileName);
        for (unsigned int face = 0; face < result->getNumImages() || face == 0; ++face)
            result->setImage(face, image);
    }
    for (std::size_t face = 0; face < texture.faces.size(); ++face)
        result->setImage(static_cast<unsigned int>(face), readImage(texture.faces[face]));
    return result;
}

osg::ref_ptr<osg::Texture> MixTextures::get(std::uint64_t id, const RenderingTexture& texture)
{
    const std::pair<std::uint64_t, unsigned int> key(id, texture.unit);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (const auto known = _textures.find(key); known != _textures.end())
            return known->second;
    }
    // Files are read outside of the lock; the first one that is there counts.
    const osg::ref_ptr<osg::Texture> read = readTexture(texture);
    std::lock_guard<std::mutex> lock(_mutex);
    return _textures.try_emplace(key, read).first->second;
}

osg::ref_ptr<osg::Texture> MixTextures::getWhite()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_white)
    {
        _white = new osg::Texture2D(whiteImage());
        _white->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    }
    return _white;
}

void MixTextures::keep(const std::set<std::uint64_t>& ids)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto at = _textures.begin(); at != _textures.end();)
        at = ids.count(at->first.first) ? std::next(at) : _textures.erase(at);
}

} // namespace osgMultiRender
