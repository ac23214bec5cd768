// SPDX-License-Identifier: MIT
#include "../osgPagedTexture/CapturedWall.h"
#include "EmbedProcess.h"

class EmbedVirtualTextureGLTest : public EmbedProcess
{
protected:
    EmbedVirtualTextureGLTest() : EmbedProcess(OSGKITS_EMBED_VIRTUALTEXTURE, 320, 240) {}

    void SetUp() override
    {
        EmbedProcess::SetUp();
        CapturedWall(4, 3, 200, 160).write(_photographs.getPath().string());
        support::ChildProcess build;
        build.arguments = {OSGKITS_OSGTILESTORE, "build", _photographs.getPath().string(),
                           "--store", _store};
        const support::ProcessResult result = build.run();
        ASSERT_EQ(result.exitCode, 0) << result.errors;
    }

    support::TemporaryFolder _photographs, _stores;
    const std::string _store = _stores.file("wall.tiles");
};

TEST_F(EmbedVirtualTextureGLTest, showsAStoreOnAWall)
{
    const auto empty = view({}), shown = view({"--wall", _store, "-s", "wait=on"});
    ASSERT_TRUE(empty && shown);
    int differ = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x)
            differ += shown->getColor(unsigned(x), unsigned(y)) !=
                      empty->getColor(unsigned(x), unsigned(y));
    // The viewer's home position shows a wall about a third of the picture's height.
    EXPECT_GT(differ, 320 * 240 / 20);
}

TEST_F(EmbedVirtualTextureGLTest, saysWhetherAllIsThere)
{
    const support::ProcessResult result = run({"--wall", _store, "-s", "wait=on"});
    EXPECT_NE(result.output.find("pages"), std::string::npos) << result.output;
}

TEST_F(EmbedVirtualTextureGLTest, aStoreThatIsNotThereIsNamed)
{
    const support::ProcessResult result = run({"--wall", "nowhere.tiles"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("nowhere.tiles"), std::string::npos) << result.errors;
}

TEST_F(EmbedVirtualTextureGLTest, wrongSwitchesAreNamed)
{
    expectNamesWrongSwitches("gpu=huge", "'huge' is not a number");
}

TEST_F(EmbedVirtualTextureGLTest, helpSaysItsSwitches)
{
    expectHelpNamesSettings();
}
