// SPDX-License-Identifier: MIT
#include "RenderProcess.h"

#include <nlohmann/json.hpp>

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
