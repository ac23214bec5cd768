// SPDX-License-Identifier: MIT
#include "EmbedProcess.h"

#include <support/CompareImage.h>

class EmbedMixedGLTest : public EmbedProcess
{
protected:
    EmbedMixedGLTest() : EmbedProcess(OSGKITS_EMBED_MIXED, 320, 200) {}
};

TEST_F(EmbedMixedGLTest, showsItsStreetMixedAndTakesSettings)
{
    const auto mixed = view({}), more = view({"-s", "renderings='gooch:0,0'"});
    ASSERT_TRUE(mixed && more);
    EXPECT_GT(support::difference(*mixed, *more, 0.1).getShareOver(), 0.01);
}

TEST_F(EmbedMixedGLTest, wrongSwitchesAreNamed)
{
    expectNamesWrongSwitches("mode=spiral", "'spiral' is none of points, polyline, loop");
}

TEST_F(EmbedMixedGLTest, helpSaysItsSwitches)
{
    expectHelpNamesSettings();
}
