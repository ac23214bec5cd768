// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/TemporaryFolder.h>

#include <osgDB/ReadFile>

class EmbedMapLabelsGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        static support::HeadlessViewer viewer({16, 16});
        OSGKITS_NEED_GL(viewer);
    }

    /// The example's picture without a display, where it ends well.
    osg::ref_ptr<osg::Image> view(const std::vector<std::string>& words,
                                  support::ProcessResult& result) const
    {
        const std::string file = _folder.file("view.png");
        result = run(words, file);
        return result.exitCode == 0 ? osgDB::readRefImageFile(file) : nullptr;
    }

    support::ProcessResult run(const std::vector<std::string>& words,
                               const std::string& capture = {}) const
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_EMBED_MAPLABELS,
                             "-e",
                             "egl",
                             "--SingleThreaded",
                             "--window",
                             "0",
                             "0",
                             "480",
                             "240"};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        process.environment = {{"OSG_RUN_FRAME_COUNT", "2"}, {"OSG_HEADLESS_CAPTURE", capture}};
        process.unset = {"DISPLAY"};
        return process.run();
    }

    support::TemporaryFolder _folder;
};

TEST_F(EmbedMapLabelsGLTest, labelsItsTownAndTakesSettings)
{
    support::ProcessResult result;
    const auto labelled = view({}, result);
    EXPECT_EQ(result.errors, "");
    const auto red = view({"-s", "ink=#ff0000"}, result),
               large = view({"-s", "mapsize=30"}, result);
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
