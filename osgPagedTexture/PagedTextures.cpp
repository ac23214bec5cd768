// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedTextures.h>

#include <osgPagedTexture/FileImages.h>
#include <osgPagedTexture/PagedSubload.h>

#include <osg/ImageStream>
#include <osg/NodeVisitor>
#include <osgDB/ClassInterface>
#include <osgDB/FileUtils>

#include <cstdlib>
#include <set>

namespace osgPagedTexture
{

namespace
{

/// A texture, and where it was met first.
struct MetTexture
{
    osg::ref_ptr<osg::Texture> texture;
    TextureSite site;
};

/// All textures of a subgraph, each once, in the order in which they are met.
class TextureCollector : public osg::NodeVisitor
{
public:
    TextureCollector() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override
    {
        const int outerBumpUnit = _bumpUnit;
        if (node.getCompoundClassName() == "osgFX::BumpMapping")
            osgDB::ClassInterface().getProperty(&node, "NormalMapTextureUnit", _bumpUnit);
        osg::StateSet* stateSet = node.getStateSet();
        if (stateSet)
        {
            _path.push_back(stateSet);
            collect(*stateSet);
        }
        traverse(node);
        if (stateSet)
            _path.pop_back();
        _bumpUnit = outerBumpUnit;
    }
    void apply(osg::Drawable& drawable) override { apply(static_cast<osg::Node&>(drawable)); }

    std::vector<MetTexture> met;

private:
    void collect(osg::StateSet& stateSet)
    {
        for (unsigned int unit = 0; unit < stateSet.getNumTextureAttributeLists(); ++unit)
        {
            osg::StateAttribute* attribute =
                stateSet.getTextureAttribute(unit, osg::StateAttribute::TEXTURE);
            osg::Texture* texture = attribute ? attribute->asTexture() : nullptr;
            if (texture && _seen.insert(texture).second)
                met.push_back({texture, {_path, unit, _bumpUnit}});
        }
    }

    std::set<const osg::Texture*> _seen;
    std::vector<const osg::StateSet*> _path;
    int _bumpUnit = -1;
};

/// That the option BUMP=<unit> of the Wavefront reader says; -1 for none.
int bumpUnitOf(const osgDB::Options* options)
{
    const std::string text = options ? " " + options->getOptionString() : std::string();
    const std::size_t at = text.find(" BUMP=");
    return at == std::string::npos ? -1 : std::atoi(text.c_str() + at + 6);
}

/// Why a texture that has an image can't be paged; empty where it can.
std::string obstacle(const osg::Texture2D& texture)
{
    if (texture.getSubloadCallback())
        return "it has a subload callback of its own";
    if (texture.getBorderWidth() != 0)
        return "it has texels as its border";
    if (texture.getShadowComparison())
        return "it compares depths";
    if (texture.getInternalFormatMode() == osg::Texture::USE_USER_DEFINED_FORMAT)
        return "it asks for a format of its own";
    if (texture.getUpdateCallback() || dynamic_cast<const osg::ImageStream*>(texture.getImage()))
        return "its image moves";
    return {};
}

bool hasMipmaps(const osg::Texture2D& texture)
{
    const osg::Texture::FilterMode mode = texture.getFilter(osg::Texture::MIN_FILTER);
    return mode != osg::Texture::LINEAR && mode != osg::Texture::NEAREST;
}

PagedImage imageOf(const std::string& file, const ImageInfo& info, const osg::Texture2D& texture,
                   const TextureSite& site, const std::string& name)
{
    PagedImage image;
    image.file = file;
    image.width = info.width;
    image.height = info.height;
    image.channels = info.channels;
    image.translucent = info.translucent;
    image.use = useOf(texture, site, {name.empty() ? file : name, info.channels});
    image.anisotropy = texture.getMaxAnisotropy();
    // A texture without mip levels shows its finest one from anywhere.
    image.lodBias = hasMipmaps(texture) ? 0.0 : -64.0;
    return image;
}

class Paging
{
public:
    Paging(std::shared_ptr<Pager> pager, const FileImages* images)
        : _pager(std::move(pager)), _images(images)
    {
    }

    void page(const MetTexture& met)
    {
        osg::Texture& texture = *met.texture;
        osg::Texture2D* flat = dynamic_cast<osg::Texture2D*>(&texture);
        if (flat && dynamic_cast<const PagedSubload*>(flat->getSubloadCallback()))
            return; // Another scene's, or this one's already.
        const std::string reason = !flat               ? "it is not a 2D texture"
                                   : !flat->getImage() ? std::string()
                                                       : obstacle(*flat);
        if (!flat || !reason.empty())
            leave(texture, reason);
        else if (flat->getImage())
            pageFlat(*flat, met.site);
    }

    std::vector<LeftTexture> left;

private:
    void leave(osg::Texture& texture, const std::string& reason)
    {
        for (unsigned int i = 0; i < texture.getNumImages(); ++i)
        {
            osg::Image* image = texture.getImage(i);
            if (!image)
                continue;
            left.push_back({image->getFileName(), reason});
            if (const FileImages::Found* found = _images ? _images->find(*image) : nullptr)
                _images->restore(*image, *found);
        }
    }

    void pageFlat(osg::Texture2D& texture, const TextureSite& site)
    {
        const osg::ref_ptr<osg::Image> image = texture.getImage();
        if (const FileImages::Found* found = _images ? _images->find(*image) : nullptr)
        {
            TextureSite here = site;
            if (here.bumpUnit < 0)
                here.bumpUnit = bumpUnitOf(found->options);
            const std::string& name = image->getFileName();
            give(texture, imageOf(found->file, found->info, texture, here, name),
                 {name, found->file});
            return;
        }
        if (!giveFile(texture, *image, site))
            giveEmbedded(texture, *image, site);
    }

    /// The file that an image in memory was read from, where that still holds the same picture.
    bool giveFile(osg::Texture2D& texture, const osg::Image& image, const TextureSite& site)
    {
        const std::string file = osgDB::findDataFile(image.getFileName());
        if (file.empty() || image.isCompressed())
            return false;
        try
        {
            const ImageInfo info = readImageInfo(file);
            if (info.width != image.s() || info.height != image.t())
                return false;
            const std::string& name = image.getFileName();
            give(texture, imageOf(file, info, texture, site, name), {name, file});
            return true;
        }
        catch (const ImageError&)
        {
            return false; // It stays what it is.
        }
    }

    void giveEmbedded(osg::Texture2D& texture, const osg::Image& image, const TextureSite& site)
    {
        std::string reason = EmbeddedImages::obstacle(image);
        const std::string file = reason.empty() ? _pager->getEmbedded().keep(image) : std::string();
        if (file.empty())
        {
            left.push_back(
                {image.getFileName(), reason.empty() ? "it can't be kept on disk" : reason});
            return;
        }
        ImageInfo info;
        info.width = image.s();
        info.height = image.t();
        info.channels = int(osg::Image::computeNumComponents(image.getPixelFormat()));
        info.translucent = image.isImageTranslucent();
        PagedOrigin origin;
        origin.name = image.getFileName();
        origin.file = file;
        origin.format = image.getPixelFormat();
        origin.internalFormat = image.getInternalTextureFormat();
        origin.hint = image.getWriteHint();
        give(texture, imageOf(file, info, texture, site, origin.name), origin);
    }

    void give(osg::Texture2D& texture, const PagedImage& image, const PagedOrigin& origin)
    {
        texture.setImage(makeKeptStandIn(origin.name, image.translucent));
        texture.setSubloadCallback(new PagedSubload(_pager, _pager->add(image), origin));
    }

    const std::shared_ptr<Pager> _pager;
    const FileImages* const _images;
};

} // namespace

std::vector<LeftTexture> pageTextures(osg::Node& node, const std::shared_ptr<Pager>& pager,
                                      const FileImages* images)
{
    TextureCollector collector;
    node.accept(collector);
    Paging paging(pager, images);
    for (const MetTexture& met : collector.met)
        paging.page(met);
    if (images)
        images->restoreHeld();
    return paging.left;
}

} // namespace osgPagedTexture
