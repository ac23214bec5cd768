// SPDX-License-Identifier: MIT
// Each hard case, merged with a partner before and behind it, equals the blend of both alone.
#include "osgMultiRender/MergeCases.h"
#include "osgMultiRender/MergePicture.h"

#include <gtest/gtest.h>

using namespace osgMultiRender;

namespace
{

constexpr double Step = 1.0 / 255.0;
// Depths are 32-bit floats, of which means by weight are taken.
constexpr double DepthStep = 1e-5;

std::string messagesOf(const Merged& merged)
{
    std::string text;
    for (const MergeMessage& message : merged.messages)
    {
        text += message.text + "\n";
    }
    return text;
}

class MergeCasesGLTest : public PlainGLTest, public ::testing::WithParamInterface<std::size_t>
{
protected:
    void check(const std::vector<MergeEntry>& entries)
    {
        MergeStudio studio;
        std::vector<MergePicture> alone;
        for (const MergeEntry& entry : entries)
        {
            alone.push_back(studio.drawAlone(*entry.rendering));
            ASSERT_TRUE(alone.back().ok) << entry.rendering->name << "\n" << alone.back().log;
        }
        MergeOptions options;
        options.weights = MergeStudio::weights(entries.size());
        for (std::size_t base = 0; base < entries.size(); ++base)
        {
            // A case that moves vertices otherwise is the base: all show its positions.
            options.base = base;
            const Merged merged = mergeRenderings(entries, options);
            ASSERT_TRUE(merged.ok) << messagesOf(merged);
            ASSERT_TRUE(merged.renderings[0].included && merged.renderings[1].included)
                << messagesOf(merged);
            const MergePicture picture = studio.drawMerged(merged, entries);
            ASSERT_TRUE(picture.ok) << picture.log << merged.vertex << merged.fragment;
            if (merged.renderings[1 - base].movesVertices)
            {
                continue;
            }
            const MergeDifference difference = MergeStudio::compare(picture, alone);
            EXPECT_LE(difference.worst, Step) << merged.vertex << merged.fragment;
            EXPECT_LE(difference.worstDepth, DepthStep);
            EXPECT_EQ(difference.beside, 0u);
            EXPECT_EQ(difference.covered > 500u, drawsAnything(alone));
            _compared = true;
        }
    }

    static bool drawsAnything(const std::vector<MergePicture>& pictures)
    {
        for (const MergePicture& picture : pictures)
        {
            for (std::size_t pixel = 0; pixel < picture.depths.size(); ++pixel)
            {
                if (picture.covered(pixel))
                {
                    return true;
                }
            }
        }
        return false;
    }

    bool _compared = false;
};

TEST_P(MergeCasesGLTest, equalsTheBlendOfBoth)
{
    check({{&mergeCases()[GetParam()], 1.0}, {&mergePartner(), 1.0}});
    check({{&mergePartner(), 1.0}, {&mergeCases()[GetParam()], 1.0}});
}

TEST_P(MergeCasesGLTest, equalsTheBlendWithItself)
{
    check({{&mergeCases()[GetParam()], 1.0}, {&mergeCases()[GetParam()], 1.0}});
    EXPECT_TRUE(_compared || HasFailure());
}

std::string nameOf(const ::testing::TestParamInfo<std::size_t>& info)
{
    return mergeCases()[info.param].name;
}

INSTANTIATE_TEST_SUITE_P(Cases, MergeCasesGLTest,
                         ::testing::Range(std::size_t(0), mergeCases().size()), nameOf);

} // namespace
