// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/TemporaryFolder.h>

#include <osgDB/ReadFile>

class EmbedShadowsGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        static support::HeadlessViewer viewer({16, 16});
        OSGKITS_NEED_GL(viewer);
    }

    /// The example without a display.
    support::ProcessResult run(const std::vector<std::string>& words,
                               const std::string& capture = {}) const
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_EMBED_SHADOWS,
                             "-e",
                             "egl",
                             "--SingleThreaded",
                             "--window",
                             "0",
                             "0",
                             "160",
                             "120"};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        process.environment = {{"OSG_RUN_FRAME_COUNT", "2"}, {"OSG_HEADLESS_CAPTURE", capture}};
        process.unset = {"DISPLAY"};
        return process.run();
    }

    osg::ref_ptr<osg::Image> view(const std::vector<std::string>& words) const
    {
        const std::string file = _folder.file("view.png");
        const support::ProcessResult result = run(words, file);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        return osgDB::readRefImageFile(file);
    }

    support::TemporaryFolder _folder;
};

TEST_F(EmbedShadowsGLTest, drawsItsSceneAndTakesSettings)
{
    const auto lit = view({}), flat = view({"-s", "lighting=off", "-s", "shadows=off"});
    ASSERT_TRUE(lit && flat);
    EXPECT_GT(support::difference(*lit, *flat, 16.0 / 255.0).getShareOver(), 0.1);
}

TEST_F(EmbedShadowsGLTest, wrongSwitchesAreNamed)
{
    const support::ProcessResult setting = run({"-s", "shadows=sharp"});
    EXPECT_EQ(setting.exitCode, 2);
    EXPECT_NE(setting.errors.find("'sharp' is none of volumes, map, off"), std::string::npos)
        << setting.errors;
    const support::ProcessResult option = run({"--nonsense"});
    EXPECT_EQ(option.exitCode, 2);
    EXPECT_NE(option.errors.find("--nonsense"), std::string::npos) << option.errors;
    EXPECT_EQ(run({"nowhere.iv"}).exitCode, 1);
}

TEST_F(EmbedShadowsGLTest, helpSaysItsSwitches)
{
    const support::ProcessResult result = run({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.output.find("-s <name=value>"), std::string::npos) << result.output;
}
