// SPDX-License-Identifier: MIT
#include "EmbedProcess.h"

#include <support/CompareImage.h>

class EmbedShadowsGLTest : public EmbedProcess
{
protected:
    EmbedShadowsGLTest() : EmbedProcess(OSGKITS_EMBED_SHADOWS, 160, 120) {}
};

TEST_F(EmbedShadowsGLTest, drawsItsSceneAndTakesSettings)
{
    const auto lit = view({}), flat = view({"-s", "lighting=off", "-s", "shadows=off"});
    ASSERT_TRUE(lit && flat);
    EXPECT_GT(support::difference(*lit, *flat, 16.0 / 255.0).getShareOver(), 0.1);
}

TEST_F(EmbedShadowsGLTest, wrongSwitchesAreNamed)
{
    expectNamesWrongSwitches("shadows=sharp", "'sharp' is none of volumes, map, off");
}

TEST_F(EmbedShadowsGLTest, helpSaysItsSwitches)
{
    expectHelpNamesSettings();
}
