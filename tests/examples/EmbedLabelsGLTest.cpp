// SPDX-License-Identifier: MIT
#include "EmbedProcess.h"

class EmbedLabelsGLTest : public EmbedProcess
{
protected:
    EmbedLabelsGLTest() : EmbedProcess(OSGKITS_EMBED_LABELS, 480, 240) {}

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
};

TEST_F(EmbedLabelsGLTest, labelsItsPlantAndTakesSettings)
{
    const auto labelled = view({}, 1), plain = view({"-s", "match=nothing"}, 1);
    const auto red = view({"-s", "ink=#ff0000"}, 1);
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
    expectNamesWrongSwitches("size=huge", "'huge' is not a number from 0.05 to 0.9");
}

TEST_F(EmbedLabelsGLTest, helpSaysItsSwitches)
{
    expectHelpNamesSettings();
}
