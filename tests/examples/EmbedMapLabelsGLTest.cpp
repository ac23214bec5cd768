// SPDX-License-Identifier: MIT
#include "EmbedProcess.h"

#include <support/CompareImage.h>

class EmbedMapLabelsGLTest : public EmbedProcess
{
protected:
    EmbedMapLabelsGLTest() : EmbedProcess(OSGKITS_EMBED_MAPLABELS, 480, 240) {}
};

TEST_F(EmbedMapLabelsGLTest, labelsItsTownAndTakesSettings)
{
    const auto labelled = view({}), red = view({"-s", "ink=#ff0000"}),
               large = view({"-s", "mapsize=30"});
    ASSERT_TRUE(labelled && red && large);
    EXPECT_GT(support::difference(*labelled, *red, 0.1).getShareOver(), 0.002);
    EXPECT_GT(support::difference(*labelled, *large, 0.1).getShareOver(), 0.01);
}

TEST_F(EmbedMapLabelsGLTest, wrongSettingsAreNamed)
{
    for (const char* const wrong : {"mapsize=huge", "mapclass=tree", "nonsense", ""})
    {
        const support::ProcessResult result = run({"-s", wrong});
        EXPECT_EQ(result.exitCode, 2) << wrong;
        EXPECT_NE(result.errors.find("embed_maplabels: setting"), std::string::npos)
            << result.errors;
    }
}

TEST_F(EmbedMapLabelsGLTest, helpSaysItsSwitches)
{
    expectHelpNamesSettings();
}
