// SPDX-License-Identifier: MIT
#include "StockPrograms.h"

#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedScene.h>
#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <gtest/gtest.h>

// What stock OSG programs do with the plugin.

using osgPagedTexture::PagedScene;

namespace
{

constexpr char Thing[] = R"(#Inventor V2.1 ascii
Separator { LightModel { model BASE_COLOR } Texture2 { filename "wall.png" }
  Cube { width 2 height 2 depth 2 } }
)";

class PagedTexturePlugin : public StockPrograms
{
protected:
    void SetUp() override
    {
        StockPrograms::SetUp();
        osg::ref_ptr<osg::Image> wall = new osg::Image;
        wall->allocateImage(128, 128, 1, GL_RGB, GL_UNSIGNED_BYTE);
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                for (int c = 0; c < 3; ++c)
                    wall->data(unsigned(x), unsigned(y))[c] =
                        static_cast<unsigned char>(c == 0                ? 2 * x
                                                   : (x / 8 + y / 8) % 2 ? 220
                                                                         : 40);
        ASSERT_TRUE(osgDB::writeImageFile(*wall, _folder.file("wall.png")));
        _model = _folder.write("thing.iv", Thing);
    }

    std::string _model;
};

/// Mip levels are averaged in linear light here and as they are in the driver.
const support::CompareImage Alike{24.0 / 255.0, 0.02, 80.0 / 255.0};

} // namespace

TEST_F(PagedTexturePlugin, osgviewerPagesAModelBySuffix)
{
    const std::string paged = _model + ".(cache=off,compression=none,wait=on).pagedtexture";
    const Picture plain = view(_model);
    EXPECT_TRUE(Alike(view(paged), plain, "pagedtexture.suffix"));
    // Threads as osgviewer chooses them, and without its optimizer.
    EXPECT_TRUE(Alike(view(paged, {}, {}), plain, "pagedtexture.threads"));
    EXPECT_TRUE(Alike(view(paged, {{"OSG_OPTIMIZER", "OFF"}}), plain, "pagedtexture.optimizer"));
}

TEST_F(PagedTexturePlugin, withoutTextureCompressionPicturesAreTheSame)
{
    const std::string paged = _model + ".(cache=off,wait=on).pagedtexture";
    const Environment none = {{"MESA_EXTENSION_OVERRIDE", "-GL_EXT_texture_compression_s3tc"}};
    EXPECT_TRUE(Alike(view(paged, none), view(_model), "pagedtexture.s3tc"));
}

TEST_F(PagedTexturePlugin, itWorksBelowAndAboveOtherKits)
{
    const std::string settings = ".(cache=off,compression=none,wait=on).pagedtexture";
    EXPECT_TRUE(Alike(view(_model + settings + ".labels"), view(_model + ".labels"),
                      "pagedtexture.labels"));
    EXPECT_TRUE(Alike(view(_model + ".labels" + settings), view(_model + ".labels"),
                      "labels.pagedtexture"));
}

TEST_F(PagedTexturePlugin, settingsSurviveEachFormatAndTexturesArePagedAgain)
{
    for (const char* const format : {"osgt", "osgb", "osgx", "osg"})
    {
        const std::string file =
            convert(_model + ".(cache=off,gpu=32,compression=none,wait=on).pagedtexture",
                    _folder.file(std::string("saved.") + format));
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
        const auto* scene = dynamic_cast<const PagedScene*>(node.get());
        ASSERT_TRUE(scene) << format;
        EXPECT_EQ(scene->getSettings().gpuMegabytes, 32.0) << format;
        EXPECT_TRUE(Alike(view(file), view(_model), std::string("pagedtexture.") + format));
    }
}

TEST_F(PagedTexturePlugin, wrongSettingsAreNamed)
{
    support::NotifyCapture notes;
    EXPECT_FALSE(osgDB::readRefNodeFile(_model + ".(gpu=many).pagedtexture"));
    const support::NotifyCapture::Lines warnings = notes.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("'gpu=many': 'many' is not a number"), std::string::npos)
        << warnings[0];
}

TEST_F(PagedTexturePlugin, osgconvListsAllSettings)
{
    const support::ProcessResult result = run({"osgconv", "--format", "pagedtexture"});
    for (const osgPagedTexture::PagedOption& option : osgPagedTexture::pagedOptions())
        EXPECT_NE(result.output.find("pagedtexture." + option.name + "=" + option.values),
                  std::string::npos)
            << option.name;
}

TEST_F(PagedTexturePlugin, osgviewersHelpHasTheKeys)
{
    const support::ProcessResult result = run({"osgviewer", "-e", "pagedtexture", "--help-keys"});
    EXPECT_NE((result.output + result.errors).find("Paged textures: graph"), std::string::npos);
}
