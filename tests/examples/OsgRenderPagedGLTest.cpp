// SPDX-License-Identifier: MIT
#include "RenderProcess.h"

#include "../osgPagedTexture/PagedScenes.h"

#include <nlohmann/json.hpp>

#include <osg/Group>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

// What osgrender tells of paged textures.
class OsgRenderPagedGLTest : public RenderProcess
{
protected:
    void SetUp() override
    {
        osg::ref_ptr<osg::Image> wall = new osg::Image;
        wall->allocateImage(128, 128, 1, GL_RGB, GL_UNSIGNED_BYTE);
        for (unsigned int i = 0; i < wall->getTotalSizeInBytes(); ++i)
            wall->data()[i] = static_cast<unsigned char>(i * 7);
        ASSERT_TRUE(osgDB::writeImageFile(*wall, _folder.file("wall.png")));
        _folder.write("wall.iv", R"(#Inventor V2.1 ascii
Separator { LightModel { model BASE_COLOR } Texture2 { filename "wall.png" }
  Cube { width 2 height 2 depth 2 } }
)");
    }

    /// What a start tells of `model` with textures kept in a folder; its picture goes to `picture`.
    nlohmann::json start(const std::string& model, const std::string& picture) const
    {
        expectRenders({model + ".(cache=" + _folder.file("cache") + ",wait=on).pagedtexture",
                       "--stats", "s.json", "-o", picture});
        return nlohmann::json::parse(read("s.json")).at("plans").at(0).at("counts");
    }
};

TEST_F(OsgRenderPagedGLTest, statisticsHaveTexturesMemoryAndUploads)
{
    const support::ProcessResult result =
        run({"wall.iv.(cache=off,compression=none,wait=on).pagedtexture", "--stats", "s.json",
             "--timing", "1", "--list-plan"});
    EXPECT_EQ(result.errors, "");
    const nlohmann::json plan = nlohmann::json::parse(read("s.json")).at("plans").at(0);
    EXPECT_EQ(plan.at("kit"), "osgPagedTexture::PagedScene");
    const nlohmann::json counts = plan.at("counts");
    for (const char* const one :
         {"textures", "textures.inView", "textures.resident", "textures.whole"})
        EXPECT_EQ(counts.at(one), 1) << one;
    // 128 x 128 texels of 4 bytes and all of their levels.
    EXPECT_EQ(counts.at("gpu.bytes"), 87380);
    // Each of them was uploaded; the preview too, unless the whole was loaded before it could be.
    EXPECT_GE(counts.at("upload.bytes"), 87380);
    EXPECT_GE(counts.at("files.decoded"), 1);
    EXPECT_EQ(counts.at("texels.missing"), 0);
    EXPECT_GT(counts.at("upload.ms.max").get<double>(), 0.0);
    EXPECT_GE(counts.at("upload.ms.max"), counts.at("upload.ms.p50"));
    EXPECT_NE(result.output.find("wall.png' 128x128"), std::string::npos) << result.output;
}

TEST_F(OsgRenderPagedGLTest, aSecondStartDecodesNothingAndShowsTheSame)
{
    // A photograph, a picture with alpha, and one in the model itself.
    osg::ref_ptr<osg::Image> photo = osgDB::readRefImageFile(_folder.file("wall.png"));
    ASSERT_TRUE(osgDB::writeImageFile(*photo, _folder.file("photo.jpg")));
    const osg::ref_ptr<osg::Group> model = new osg::Group;
    model->addChild(paged::makeSquare({-2.0f, 4.0f, 0.0f}, paged::makeTexture("photo.jpg")));
    paged::writePicture(_folder, "glass.png", 256, 64, 4);
    model->addChild(paged::makeSquare({0.0f, 4.0f, 0.0f}, paged::makeTexture("glass.png")));
    photo = paged::makePicture(64, 64, 3, 9);
    model->addChild(paged::makeSquare({2.0f, 4.0f, 0.0f}, new osg::Texture2D(photo)));
    ASSERT_TRUE(osgDB::writeNodeFile(*model, _folder.file("model.osgb")));
    const nlohmann::json first = start("model.osgb", "first.png");
    EXPECT_EQ(first.at("textures.resident"), 3);
    EXPECT_GE(first.at("files.decoded"), 3) << "previews, too";
    EXPECT_EQ(first.at("cache.bytesRead"), 0);
    const nlohmann::json second = start("model.osgb", "second.png");
    EXPECT_EQ(second.at("textures.resident"), 3);
    EXPECT_EQ(second.at("files.decoded"), 0);
    EXPECT_GE(second.at("cache.hits"), 3);
    // Three whole chains: 64 x 64, 128 x 128 texels of half a byte each, 256 x 64 of a whole one.
    EXPECT_GE(second.at("cache.bytesRead"), (64 * 64 + 128 * 128) / 2 + 256 * 64);
    EXPECT_GE(second.at("upload.bytes"), (64 * 64 + 128 * 128) / 2 + 256 * 64);
    EXPECT_EQ(read("second.png"), read("first.png"));
}
