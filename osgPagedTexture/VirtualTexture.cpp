// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualTexture.h>

#include <osgPagedTexture/MakeMipChain.h>
#include <osgPagedTexture/PageTexels.h>
#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/VirtualPages.h>

#include <osgMultiRender/ContentTexture.h>

#include <osg/Image>
#include <osg/State>
#include <osgDB/FileUtils>

#include <algorithm>
#include <cstring>
#include <vector>

namespace osgPagedTexture
{

namespace
{

osg::ref_ptr<osg::Image> greyTexel()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::memset(image->data(), 128, 3);
    return image;
}

/// All levels of a picture, that one first.
std::vector<Pixels> levelsOf(const Pixels& picture)
{
    std::vector<Pixels> levels = {picture};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halve(levels.back(), TexelUse::Color));
    return levels;
}

bool isOpaque(const Pixels& picture)
{
    if (picture.channels != 4)
        return false;
    for (std::size_t i = 3; i < picture.bytes.size(); i += 4)
        if (picture.bytes[i] != 255)
            return false;
    return true;
}

Pixels withoutAlpha(const Pixels& picture)
{
    Pixels opaque(picture.width, picture.height, 3);
    for (std::size_t i = 0; i < opaque.bytes.size() / 3; ++i)
        std::copy_n(&picture.bytes[4 * i], 3, &opaque.bytes[3 * i]);
    return opaque;
}

/// The coarsest level that is paged, which is a single page. Its channels say whether the texture
/// has alpha: what surfaces do depends on that.
Pixels coarsestOf(const TileReader& reader)
{
    const TileGrid& grid = reader.getSettings().grid;
    const int level = pageLevels(grid) - 1;
    const bool mayHaveAlpha = pageFormatOf(reader.getSettings()) != BlockFormat::BC1;
    Pixels picture(int(grid.getWidth(level)), int(grid.getHeight(level)), mayHaveAlpha ? 4 : 3);
    ExtractSettings settings;
    settings.channels = picture.channels;
    int y = picture.height;
    readRegion(reader, level, {0, 0, picture.width, picture.height}, settings,
               [&](const std::uint8_t* row)
               { std::copy_n(row, picture.width * picture.channels, picture.row(--y)); });
    return isOpaque(picture) ? withoutAlpha(picture) : picture;
}

osg::ref_ptr<osg::Image> imageOf(const Pixels& picture)
{
    const std::vector<Pixels> levels = levelsOf(picture);
    osg::Image::MipmapDataType offsets;
    std::size_t size = 0;
    for (const Pixels& level : levels)
    {
        if (size > 0)
            offsets.push_back(unsigned(size));
        size += level.bytes.size();
    }
    auto* const data = new unsigned char[size];
    std::size_t at = 0;
    for (const Pixels& level : levels)
    {
        std::copy(level.bytes.begin(), level.bytes.end(), data + at);
        at += level.bytes.size();
    }
    const GLenum layout = picture.channels == 4 ? GL_RGBA : GL_RGB;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setImage(picture.width, picture.height, 1, GLint(layout), layout, GL_UNSIGNED_BYTE, data,
                    osg::Image::USE_NEW_DELETE);
    image->setMipmapLevels(offsets);
    return image;
}

} // namespace

VirtualTexture::VirtualTexture() : VirtualTexture(std::string()) {}

VirtualTexture::VirtualTexture(const std::string& store) : _store(store)
{
    setImage(greyTexel());
    setFilter(MIN_FILTER, LINEAR_MIPMAP_LINEAR);
    setFilter(MAG_FILTER, LINEAR);
    setWrap(WRAP_S, CLAMP_TO_EDGE);
    setWrap(WRAP_T, CLAMP_TO_EDGE);
    setResizeNonPowerOfTwoHint(false);
    setDataVariance(STATIC);
}

VirtualTexture::VirtualTexture(const osg::Texture2D& like, const std::string& store)
    : VirtualTexture(store)
{
    setName(like.getName());
    setWrap(WRAP_S, like.getWrap(WRAP_S));
    setWrap(WRAP_T, like.getWrap(WRAP_T));
    setMaxAnisotropy(like.getMaxAnisotropy());
}

VirtualTexture::VirtualTexture(const VirtualTexture& other, const osg::CopyOp& copyop)
    : osg::Texture2D(other, copyop), _store(other._store), _file(other._file)
{
}

int VirtualTexture::compare(const osg::StateAttribute& other) const
{
    COMPARE_StateAttribute_Types(VirtualTexture, other);
    if (const int order = _store.compare(rhs._store))
        return order;
    return osg::Texture2D::compare(rhs);
}

void VirtualTexture::setStore(const std::string& store)
{
    _store = store;
    _file.clear();
    setImage(greyTexel());
}

bool VirtualTexture::find(const osgDB::Options* options)
{
    _file = osgDB::findDataFile(_store, options);
    return !_file.empty();
}

std::string VirtualTexture::loadImage()
{
    try
    {
        setImage(imageOf(coarsestOf(*openTileStore(getFile()))));
        return {};
    }
    catch (const TileStoreError& error)
    {
        setImage(greyTexel());
        return error.what();
    }
}

void VirtualTexture::showPicture(osg::State& state, const Pixels& picture) const
{
    const osg::Image* const image = getImage();
    if (!image || image->s() != picture.width || image->t() != picture.height)
        return;
    osgMultiRender::bindToUpload(state, *this);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    const GLenum layout = picture.channels == 4 ? GL_RGBA : GL_RGB;
    GLint number = 0;
    for (const Pixels& level : levelsOf(picture))
        glTexSubImage2D(GL_TEXTURE_2D, number++, 0, 0, level.width, level.height, layout,
                        GL_UNSIGNED_BYTE, level.bytes.data());
}

} // namespace osgPagedTexture
