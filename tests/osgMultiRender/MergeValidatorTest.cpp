// SPDX-License-Identifier: MIT
// Merged sources are GLSL for a second compiler too, the reference one.
#include "osgMultiRender/MergeCases.h"

#include <osgMultiRender/Merger.h>
#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

using namespace osgMultiRender;

namespace
{

class MergeValidatorTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        support::ChildProcess process;
        process.arguments = {"glslangValidator", "--version"};
        if (process.run().exitCode != 0)
        {
            GTEST_SKIP() << "glslangValidator is not installed";
        }
    }

    support::ProcessResult validate(const Merged& merged)
    {
        support::ChildProcess process;
        process.arguments = {"glslangValidator", "-l", _folder.write("m.vert", merged.vertex),
                             _folder.write("m.frag", merged.fragment)};
        return process.run();
    }

    support::TemporaryFolder _folder;
};

TEST_F(MergeValidatorTest, allCasesWithTheirPartnerAreValid)
{
    for (const Rendering& one : mergeCases())
    {
        const Merged merged = mergeRenderings({{&one, 1.0}, {&mergePartner(), 1.0}});
        const support::ProcessResult result = validate(merged);
        EXPECT_EQ(result.exitCode, 0) << one.name << "\n" << merged.explain(result.output);
    }
}

TEST_F(MergeValidatorTest, allOptionsGiveValidTexts)
{
    const Rendering depth = mergeCase(
        "depth", "void main() { if (gl_FragCoord.x > 9.0) discard; gl_FragDepth = 0.5; gl_FragColor = vec4(1.0); }");
    for (int i = 0; i < 24; ++i)
    {
        MergeOptions options;
        options.outside = static_cast<MergeOutside>(i % 3);
        options.normalize = (i / 3) % 2 != 0;
        options.skipZeroWeights = (i / 6) % 2 != 0;
        options.share = (i / 12) % 2 != 0;
        const Merged merged = mergeRenderings({{&depth, 1.0}, {&mergePartner(), 1.0}}, options);
        const support::ProcessResult result = validate(merged);
        EXPECT_EQ(result.exitCode, 0) << i << "\n" << merged.explain(result.output);
    }
}

} // namespace
