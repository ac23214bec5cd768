// SPDX-License-Identifier: MIT
#include "VirtualScenes.h"

#include <osgPagedTexture/MakeMipChain.h>
#include <osgPagedTexture/VirtualOptions.h>

#include <osg/Geometry>
#include <osgDB/Registry>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>

namespace virtuals
{

using namespace osgPagedTexture;

namespace
{

/// Half of it, rounded up: of an odd side the last texels count twice.
Pixels halved(const Pixels& from)
{
    Pixels even(from.width + from.width % 2, from.height + from.height % 2, from.channels);
    for (int y = 0; y < even.height; ++y)
        for (int x = 0; x < even.width; ++x)
            // Rows are from the bottom here, and from the top in stores.
            std::memcpy(even.row(even.height - 1 - y) + x * from.channels,
                        from.row(from.height - 1 - std::min(y, from.height - 1)) +
                            std::min(x, from.width - 1) * from.channels,
                        std::size_t(from.channels));
    return halve(even, TexelUse::Color);
}

/// A tile with its border; what lies outside repeats the edge.
Pixels cut(const Pixels& level, const PixelRect& rect)
{
    Pixels tile(int(rect.width), int(rect.height), level.channels);
    for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x)
        {
            const auto fromX = int(std::clamp<std::int64_t>(rect.x + x, 0, level.width - 1));
            const auto fromY = int(std::clamp<std::int64_t>(rect.y + y, 0, level.height - 1));
            std::memcpy(tile.row(tile.height - 1 - y) + x * level.channels,
                        level.row(level.height - 1 - fromY) + fromX * level.channels,
                        std::size_t(level.channels));
        }
    return tile;
}

} // namespace

Levels makeLevels(const Pixels& picture)
{
    Levels levels = {picture};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved(levels.back()));
    return levels;
}

Levels makeLevels(int width, int height, unsigned int seed, int channels)
{
    const osg::ref_ptr<osg::Image> image = paged::makePicture(width, height, channels, seed);
    Pixels pixels(width, height, channels);
    std::memcpy(pixels.bytes.data(), image->data(), pixels.bytes.size());
    return makeLevels(pixels);
}

Levels makePlain(int width, int height, TileColor color)
{
    Pixels pixels(width, height, 3);
    for (std::size_t i = 0; i < pixels.bytes.size(); ++i)
        pixels.bytes[i] = color[i % 3];
    return makeLevels(pixels);
}

std::string encodePng(const Pixels& pixels)
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setImage(pixels.width, pixels.height, 1, GL_RGB, pixels.channels == 4 ? GL_RGBA : GL_RGB,
                    GL_UNSIGNED_BYTE, const_cast<std::uint8_t*>(pixels.bytes.data()),
                    osg::Image::NO_DELETE);
    std::ostringstream bytes;
    osgDB::Registry::instance()->getReaderWriterForExtension("png")->writeImage(*image, bytes);
    return bytes.str();
}

void writeTiles(TileWriter& writer, const TileGrid& grid, const Levels& levels,
                const std::function<bool(const TileKey&)>& which)
{
    for (int level = 0; level < grid.getLevels(); ++level)
        for (std::int64_t y = 0; y < grid.getRows(level); ++y)
            for (std::int64_t x = 0; x < grid.getColumns(level); ++x)
            {
                const TileKey key{level, x, y};
                if (!which || which(key))
                    writer.put(key, TileData::encoded(encodePng(
                                        cut(levels[std::size_t(level)], grid.getPixels(key)))));
            }
    writer.commit();
}

void buildStore(const std::string& path, const Levels& levels, int tileSide, int border)
{
    TileStoreSettings settings;
    settings.format = levels[0].channels == 4 ? "png" : "jpg"; // Says whether there is alpha.
    settings.grid = TileGrid(levels[0].width, levels[0].height, tileSide, border);
    TilePackWriter writer(path, settings, {});
    writeTiles(writer, settings.grid, levels);
}

osg::ref_ptr<osg::Texture2D> makePlainTexture(const Levels& levels)
{
    std::size_t size = 0;
    osg::Image::MipmapDataType offsets;
    for (const Pixels& level : levels)
    {
        if (size > 0)
            offsets.push_back(unsigned(size));
        size += level.bytes.size();
    }
    auto* data = new unsigned char[size];
    std::size_t at = 0;
    for (const Pixels& level : levels)
    {
        std::memcpy(data + at, level.bytes.data(), level.bytes.size());
        at += level.bytes.size();
    }
    const GLenum format = levels[0].channels == 4 ? GL_RGBA : GL_RGB;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->setImage(levels[0].width, levels[0].height, 1, GLint(format), format, GL_UNSIGNED_BYTE,
                    data, osg::Image::USE_NEW_DELETE);
    image->setMipmapLevels(offsets);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setUseHardwareMipMapGeneration(false);
    return texture;
}

osg::ref_ptr<VirtualTexture> makeVirtualTexture(const std::string& store)
{
    return new VirtualTexture(store);
}

osg::ref_ptr<VirtualScene> makeScene(osg::Node* model, const std::string& text, bool waits)
{
    VirtualSettings settings;
    settings.compression = Compression::None;
    settings.wait = waits;
    settings.fadeSeconds = 0.0;
    for (const std::string& error : parseVirtualOptions(settings, text))
        ADD_FAILURE() << error;
    osg::ref_ptr<VirtualScene> scene = new VirtualScene;
    scene->setSettings(settings);
    scene->addChild(model);
    scene->install();
    return scene;
}

osg::ref_ptr<osg::Geode> makeFloor(osg::Texture2D* texture, float side, float repeat)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(
        osg::Vec3(-0.5f * side, -0.5f * side, 0.0f), osg::Vec3(side, 0.0f, 0.0f),
        osg::Vec3(0.0f, side, 0.0f), repeat, repeat));
    geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return geode;
}

osg::ref_ptr<osg::Image> settle(support::HeadlessViewer& viewer, VirtualScene& scene,
                                osg::Node* root, const support::CameraSpec& camera, int width,
                                int height)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    for (int calm = 0; calm < 2; calm = scene.isAtRest() ? calm + 1 : 0)
    {
        viewer.render(root, camera, width, height);
        if (std::chrono::steady_clock::now() > end)
        {
            ADD_FAILURE() << "not at rest after a minute";
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return viewer.render(root, camera, width, height);
}

double countOf(const VirtualScene& scene, const std::string& name)
{
    const std::vector<osgMultiRender::Plan> plans = scene.getPlans();
    EXPECT_FALSE(plans.empty());
    if (plans.empty())
        return -1.0;
    const auto found = plans[0].counts.find(name);
    EXPECT_NE(found, plans[0].counts.end()) << name;
    return found == plans[0].counts.end() ? -1.0 : found->second;
}

void filterExactly()
{
    setenv("GALLIVM_PERF", "no_quad_lod", 1);
}

} // namespace virtuals
