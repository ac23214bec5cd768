// SPDX-License-Identifier: MIT
#include "EmbedProcess.h"

class EmbedPagedTextureGLTest : public EmbedProcess
{
protected:
    EmbedPagedTextureGLTest() : EmbedProcess(OSGKITS_EMBED_PAGEDTEXTURE, 320, 240) {}

    /// Colours that are not grey, as the pictures of its walls are.
    static double colored(const osg::Image& picture)
    {
        int count = 0;
        for (int y = 0; y < picture.t(); ++y)
            for (int x = 0; x < picture.s(); ++x)
            {
                const osg::Vec4 c = picture.getColor(unsigned(x), unsigned(y));
                count += std::abs(c.r() - c.g()) > 0.3f;
            }
        return double(count) / (picture.s() * picture.t());
    }
};

TEST_F(EmbedPagedTextureGLTest, pagesTheTexturesOfASceneThatIsThere)
{
    const auto empty = view({"-s", "freeze=on"}),
               shown = view({"-s", "wait=on", "-s", "cache=off"});
    ASSERT_TRUE(empty && shown);
    EXPECT_GT(colored(*shown), colored(*empty) + 0.02);
}

TEST_F(EmbedPagedTextureGLTest, saysWhatIsWhere)
{
    const support::ProcessResult result = run({"-s", "wait=on", "-s", "cache=off"});
    EXPECT_NE(result.output.find("of 12 textures in view"), std::string::npos) << result.output;
}

TEST_F(EmbedPagedTextureGLTest, wrongSwitchesAreNamed)
{
    expectNamesWrongSwitches("gpu=huge", "'huge' is not a number from 0 to 1048576");
}

TEST_F(EmbedPagedTextureGLTest, helpSaysItsSwitches)
{
    expectHelpNamesSettings();
}
