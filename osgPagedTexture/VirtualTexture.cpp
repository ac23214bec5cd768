// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualTexture.h>

#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/VirtualPages.h>

#include <osg/Image>

#include <cstring>

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

/// The coarsest level that is paged, which is a single page.
osg::ref_ptr<osg::Image> coarsestOf(const TileReader& reader)
{
    const TileGrid& grid = reader.getSettings().grid;
    const int level = pageLevels(grid) - 1;
    const bool hasAlpha = reader.getSettings().format == "png";
    ExtractSettings settings;
    settings.channels = hasAlpha ? 4 : 3;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(grid.getWidth(level)), int(grid.getHeight(level)), 1,
                         hasAlpha ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE);
    int y = image->t();
    readRegion(reader, level, {0, 0, image->s(), image->t()}, settings,
               [&](const std::uint8_t* row)
               {
                   --y;
                   std::memcpy(image->data(0, y), row,
                               std::size_t(image->s()) * std::size_t(settings.channels));
               });
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

std::string VirtualTexture::loadImage(const std::string& file)
{
    _file = file;
    try
    {
        setImage(coarsestOf(*openTileStore(file)));
        return {};
    }
    catch (const TileStoreError& error)
    {
        setImage(greyTexel());
        return error.what();
    }
}

} // namespace osgPagedTexture
