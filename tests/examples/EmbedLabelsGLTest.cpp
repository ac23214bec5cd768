// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/TemporaryFolder.h>

#include <osgDB/ReadFile>

class EmbedLabelsGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        static support::HeadlessViewer viewer({16, 16});
        OSGKITS_NEED_GL(viewer);
    }

    /// The example without a display.
    support::ProcessResult run(const std::vector<std::string>& words,
                               const std::string& capture = {}, int frames = 1) const
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_EMBED_LABELS,
                             "-e",
                             "egl",
                             "--SingleThreaded",
                             "--window",
                             "0",
                             "0",
                             "480",
                             "240"};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        process.environment = {{"OSG_RUN_FRAME_COUNT", std::to_string(frames)},
                               {"OSG_HEADLESS_CAPTURE", capture}};
        process.unset = {"DISPLAY"};
        return process.run();
    }

    osg::ref_ptr<osg::Image> view(const std::vector<std::string>& words, int frames = 1) const
    {
        const std::string file = _folder.file("view.png");
        const support::ProcessResult result = run(words, file, frames);
        EXPECT_EQ(result.exitCode, 0) << result.errors;
        EXPECT_EQ(result.errors, "");
        return osgDB::readRefImageFile(file);
    }

    /// Share of pixels that differ in the columns from `first` to `last`, as shares of the width.
    static double difference(const osg::Image& a, const osg::Image& b, double first, double last)
    {
        int count = 0;
        const int begin = int(first * a.s()), end = int(last * a.s());
        for (int y = 0; y < a.t(); ++y)
            for (int x = begin; x < end; ++x)
                count +=
                    (a.getColor(unsigned(x), unsigned(y)) - b.getColor(unsigned(x), unsigned(y)))
                        .length() > 0.1f;
        return double(count) / (a.t() * (end - begin));
    }

    support::TemporaryFolder _folder;
};

TEST_F(EmbedLabelsGLTest, labelsItsPlantAndTakesSettings)
{
    const auto labelled = view({}), plain = view({"-s", "match=nothing"});
    const auto red = view({"-s", "ink=#ff0000"});
    ASSERT_TRUE(labelled && plain && red);
    EXPECT_GT(difference(*labelled, *plain, 0.0, 1.0), 0.005);
    EXPECT_GT(difference(*labelled, *red, 0.0, 1.0), 0.005);
}

TEST_F(EmbedLabelsGLTest, theFirstObjectsTextChanges)
{
    // Objects have identifiers when the first frame is drawn. The tank is left of the others.
    const auto before = view({}, 1), after = view({}, 3);
    ASSERT_TRUE(before && after);
    EXPECT_GT(difference(*before, *after, 0.0, 0.4), 0.002);
    EXPECT_EQ(difference(*before, *after, 0.5, 1.0), 0.0);
}

TEST_F(EmbedLabelsGLTest, wrongSwitchesAreNamed)
{
    const support::ProcessResult setting = run({"-s", "size=huge"});
    EXPECT_EQ(setting.exitCode, 2);
    EXPECT_NE(setting.errors.find("'huge' is not a number from 0.05 to 0.9"), std::string::npos)
        << setting.errors;
    const support::ProcessResult option = run({"--nonsense"});
    EXPECT_EQ(option.exitCode, 2);
    EXPECT_NE(option.errors.find("--nonsense"), std::string::npos) << option.errors;
    EXPECT_EQ(run({"nowhere.iv"}).exitCode, 1);
}

TEST_F(EmbedLabelsGLTest, helpSaysItsSwitches)
{
    const support::ProcessResult result = run({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.output.find("-s <name=value>"), std::string::npos) << result.output;
}
