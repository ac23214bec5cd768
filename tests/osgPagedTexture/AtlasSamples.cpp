// SPDX-License-Identifier: MIT
#include "AtlasSamples.h"

#include "ExactMask.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/UsedParts.h>

#include <osg/NodeVisitor>
#include <osg/Texture2D>

#include <algorithm>
#include <filesystem>

using namespace osgPagedTexture;

AtlasLayout layoutOf(const ModelPhotos& model, const std::string& folder, bool tight)
{
    std::vector<AtlasPhoto> photos;
    for (const Photo& photo : model.photos)
    {
        AtlasPhoto place = describePhoto(
            folder, std::filesystem::relative(photo.file, std::filesystem::canonical(folder))
                        .generic_string());
        if (!tight)
        {
            photos.push_back(place);
            continue;
        }
        for (const PixelRect& part : findUsedParts(ExactMask(photo).getMask()))
        {
            place.used = {part};
            photos.push_back(place);
        }
    }
    return packAtlas(photos, AtlasSettings());
}

osg::ref_ptr<osg::Image> paintAtlas(const AtlasLayout& layout, const std::string& folder)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(layout.width), int(layout.height), 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(255));
    for (const AtlasPhoto& photo : layout.photos)
    {
        const Pixels pixels = readImageFile(folder + "/" + photo.path).pixels;
        const PixelRect box = photo.getBox(), covered = layout.getCovered(photo);
        for (std::int64_t y = covered.y; y < covered.y + covered.height; ++y)
        {
            for (std::int64_t x = covered.x; x < covered.x + covered.width; ++x)
            {
                const std::int64_t column = std::clamp(x - photo.x, box.x, box.x + box.width - 1);
                const std::int64_t row = std::clamp(y - photo.y, box.y, box.y + box.height - 1);
                std::copy_n(pixels.row(pixels.height - 1 - int(row)) + 3 * column, 3,
                            image->data(int(x), int(layout.height - 1 - y)));
            }
        }
    }
    return image;
}

osg::ref_ptr<osg::Geometry> texturedSquare(const std::string& photograph,
                                           osg::Texture::WrapMode wrap,
                                           const osg::Vec2 (&corners)[4])
{
    osg::ref_ptr<osg::Geometry> square = new osg::Geometry;
    const osg::Vec3 places[] = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
    square->setVertexArray(new osg::Vec3Array(places, places + 4));
    square->setTexCoordArray(0, new osg::Vec2Array(corners, corners + 4),
                             osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array;
    color->push_back({1, 1, 1, 1});
    square->setColorArray(color, osg::Array::BIND_OVERALL);
    square->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
    const Pixels pixels = readImageFile(photograph).pixels;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(pixels.width, pixels.height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    std::copy(pixels.bytes.begin(), pixels.bytes.end(), image->data());
    image->setFileName(photograph);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, wrap);
    texture->setWrap(osg::Texture::WRAP_T, wrap);
    square->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    square->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return square;
}

void lookUpNearest(osg::Node& node)
{
    class Visitor : public osg::NodeVisitor
    {
    public:
        Visitor() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
        void apply(osg::Node& each) override
        {
            osg::StateSet* stateSet = each.getStateSet();
            osg::StateAttribute* attribute =
                stateSet ? stateSet->getTextureAttribute(0, osg::StateAttribute::TEXTURE) : nullptr;
            if (osg::Texture* texture = attribute ? attribute->asTexture() : nullptr)
            {
                texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
                texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
                texture->setResizeNonPowerOfTwoHint(false);
            }
            traverse(each);
        }
    } visitor;
    node.accept(visitor);
}
