// SPDX-License-Identifier: MIT
#include "StockPrograms.h"

#include <osgPagedTexture/TilePack.h>
#include <osgPagedTexture/VirtualOptions.h>
#include <osgPagedTexture/VirtualScene.h>
#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

// What stock OSG programs do with the plugin.

using namespace osgPagedTexture;

namespace
{

constexpr char Thing[] = R"(#Inventor V2.1 ascii
Separator { Texture2 { filename "wall.png" } Cube { width 2 height 2 depth 2 }
  Separator { Translation { translation 1 -1.6 0.3 } Sphere { radius 0.4 } } }
)";

class VirtualTexturePlugin : public StockPrograms
{
protected:
    static constexpr int Size = 256;

    void SetUp() override
    {
        StockPrograms::SetUp();
        osg::ref_ptr<osg::Image> wall = new osg::Image;
        wall->allocateImage(Size, Size, 1, GL_RGB, GL_UNSIGNED_BYTE);
        for (unsigned int y = 0; y < Size; ++y)
            for (unsigned int x = 0; x < Size; ++x)
                for (unsigned int c = 0; c < 3; ++c)
                    wall->data(x, y)[c] =
                        static_cast<unsigned char>(c == 0                  ? x
                                                   : (x / 16 + y / 16) % 2 ? 200
                                                                           : 40 + y / 4);
        ASSERT_TRUE(osgDB::writeImageFile(*wall, _folder.file("wall.png")));
        _model = _folder.write("thing.iv", Thing);
        build(*wall);
    }

    /// A store of the same picture beside it; levels are means.
    void build(const osg::Image& image)
    {
        TileStoreSettings settings;
        settings.grid = TileGrid(Size, Size, 64, 2);
        TilePackWriter writer(_folder.file("wall.tiles"), settings, {});
        for (int level = 0; level < settings.grid.getLevels(); ++level)
            for (std::int64_t y = 0; y < settings.grid.getRows(level); ++y)
                for (std::int64_t x = 0; x < settings.grid.getColumns(level); ++x)
                {
                    const TileKey key{level, x, y};
                    writer.put(key,
                               TileData::encoded(tile(image, settings.grid.getPixels(key), level)));
                }
        writer.commit();
    }

    static std::string tile(const osg::Image& image, const PixelRect& rect, int level)
    {
        osg::ref_ptr<osg::Image> part = new osg::Image;
        part->allocateImage(int(rect.width), int(rect.height), 1, GL_RGB, GL_UNSIGNED_BYTE);
        const int side = 1 << level, most = (Size >> level) - 1;
        for (int y = 0; y < part->t(); ++y)
            for (int x = 0; x < part->s(); ++x)
                for (unsigned int c = 0; c < 3; ++c)
                {
                    const int left = std::clamp(int(rect.x) + x, 0, most) * side;
                    const int top = std::clamp(int(rect.y) + y, 0, most) * side;
                    int sum = 0;
                    for (int i = 0; i < side * side; ++i)
                        sum += image.data(unsigned(left + i % side),
                                          unsigned(Size - 1 - top - i / side))[c];
                    part->data(unsigned(x), unsigned(part->t() - 1 - y))[c] =
                        static_cast<unsigned char>(sum / (side * side));
                }
        std::ostringstream bytes;
        osgDB::Registry::instance()->getReaderWriterForExtension("png")->writeImage(*part, bytes);
        return bytes.str();
    }

    std::string _model;
    const std::string _suffix = ".(store=wall.tiles,compression=none,wait=on).virtualtexture";
};

/// The driver of the window takes one level for four pixels, and squares of 16 texels have hard
/// edges: pixels at these differ.
const support::CompareImage Alike{8.0 / 255.0, 0.02, 48.0 / 255.0};

} // namespace

TEST_F(VirtualTexturePlugin, osgviewerShowsAModelWithItsStoreBySuffix)
{
    const Picture plain = view(_model);
    EXPECT_TRUE(Alike(view(_model + _suffix), plain, "virtualtexture.suffix"));
    // Threads as osgviewer chooses them, and without its optimizer.
    EXPECT_TRUE(Alike(view(_model + _suffix, {}, {}), plain, "virtualtexture.threads"));
    EXPECT_TRUE(Alike(view(_model + _suffix, {{"OSG_OPTIMIZER", "OFF"}}), plain,
                      "virtualtexture.optimizer"));
}

TEST_F(VirtualTexturePlugin, withoutTextureCompressionPicturesAreTheSame)
{
    const std::string model = _model + ".(store=wall.tiles,wait=on).virtualtexture";
    const Environment none = {
        {"MESA_EXTENSION_OVERRIDE",
         "-GL_EXT_texture_compression_s3tc -GL_ARB_texture_compression_bptc"}};
    EXPECT_TRUE(Alike(view(model, none), view(_model), "virtualtexture.s3tc"));
}

TEST_F(VirtualTexturePlugin, shadowsAndLabelsWorkOnTopAndBelow)
{
    const support::CompareImage alike = Alike;
    for (const char* const kit : {".(shadows=volumes).shadowvolume", ".labels"})
    {
        const Picture plain = view(_model + kit);
        EXPECT_TRUE(alike(view(_model + _suffix + kit), plain, "virtualtexture.below"));
        EXPECT_TRUE(alike(view(_model + kit + _suffix), plain, "virtualtexture.above"));
    }
}

TEST_F(VirtualTexturePlugin, settingsAndTexturesSurviveEachFormat)
{
    const Picture plain = view(_model);
    for (const char* const format : {"osgt", "osgb", "osgx", "osg"})
    {
        const std::string file =
            convert(_model + ".(store=wall.tiles,gpu=32,compression=none,wait=on).virtualtexture",
                    _folder.file(std::string("saved.") + format));
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        const auto* scene = dynamic_cast<const VirtualScene*>(node.get());
        ASSERT_TRUE(scene) << format;
        EXPECT_EQ(scene->getSettings().gpuMegabytes, 32.0) << format;
        EXPECT_EQ(scene->getSettings().store, "wall.tiles") << format;
        EXPECT_TRUE(Alike(view(file), plain, std::string("virtualtexture.") + format));
    }
}

TEST_F(VirtualTexturePlugin, wrongSettingsAndMissingStoresAreNamed)
{
    support::NotifyCapture notes;
    EXPECT_FALSE(osgDB::readRefNodeFile(_model + ".(gpu=many).virtualtexture"));
    const support::NotifyCapture::Lines warnings = notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'gpu=many': 'many' is not a number"), std::string::npos)
        << warnings[0];
}

TEST_F(VirtualTexturePlugin, osgconvListsAllSettings)
{
    const support::ProcessResult result = run({"osgconv", "--format", "virtualtexture"});
    for (const VirtualOption& option : virtualOptions())
        EXPECT_NE(result.output.find("virtualtexture." + option.name + "=" + option.values),
                  std::string::npos)
            << option.name;
}

TEST_F(VirtualTexturePlugin, osgviewersHelpHasTheKeys)
{
    const support::ProcessResult result = run({"osgviewer", "-e", "virtualtexture", "--help-keys"});
    EXPECT_NE((result.output + result.errors).find("Virtual textures: stores"), std::string::npos);
}
