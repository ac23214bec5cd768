// SPDX-License-Identifier: MIT
// Real projects of ShaderDesigner, alone and merged.
#include "osgMultiRender/MergePicture.h"

#include <osgMultiRender/Import.h>
#include <support/FilesBelow.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace osgMultiRender;

namespace
{

constexpr char Folder[] = "/usr/share/meshlab/shaders"; // Debian's package meshlab
constexpr double Step = 1.0 / 255.0;

// It asks for an int as a condition, which only some compilers take.
constexpr char NotGlsl[] = "slicingplane";

class MergeProjectsGLTest : public PlainGLTest
{
protected:
    void SetUp() override
    {
        PlainGLTest::SetUp();
        if (!hasContext())
        {
            return;
        }
        for (const std::filesystem::path& file : support::filesBelow(Folder, {".gdp"}))
            _projects.push_back(importRendering(file.string()));
        if (_projects.empty())
        {
            GTEST_SKIP() << "the package meshlab is not installed";
        }
        std::sort(_projects.begin(), _projects.end(),
                  [](const Rendering& a, const Rendering& b) { return a.name < b.name; });
    }

    /// Merged equals blended; returns the number of pixels that are drawn in one of both only.
    std::size_t check(MergeStudio& studio, const std::vector<const Rendering*>& renderings,
                      bool ownLighting = false)
    {
        std::vector<MergeEntry> entries;
        std::vector<MergePicture> alone;
        std::string names;
        bool derivatives = false;
        for (const Rendering* one : renderings)
        {
            entries.push_back({one, 1.0});
            alone.push_back(ownLighting ? studio.drawUnderOwnLighting(*one)
                                        : studio.drawAlone(*one));
            EXPECT_TRUE(alone.back().ok) << one->name << "\n" << alone.back().log;
            names += one->name + " ";
        }
        MergeOptions options;
        options.weights = MergeStudio::weights(renderings.size());
        options.ownLighting = ownLighting;
        options.limits.varyingVectors = 32;
        options.limits.fragmentUniformComponents = 4096;
        const Merged merged = mergeRenderings(entries, options);
        for (const MergeMessage& message : merged.messages)
        {
            EXPECT_NE(message.severity, MergeSeverity::Error) << message.text;
        }
        for (const MergedRendering& one : merged.renderings)
        {
            derivatives = derivatives || one.usesDerivatives;
        }
        const MergePicture picture = studio.drawMerged(merged, entries);
        EXPECT_TRUE(picture.ok) << names << "\n" << picture.log;
        if (!picture.ok)
        {
            return 0;
        }
        EXPECT_EQ(picture.log.find("uninitialized"), std::string::npos) << picture.log;
        const MergeDifference difference = MergeStudio::compare(picture, alone);
        EXPECT_LE(difference.worst, Step) << names;
        EXPECT_GT(difference.covered, 500u) << names;
        return difference.beside;
    }

    std::vector<Rendering> _projects;
};

TEST_F(MergeProjectsGLTest, allAreImportedAndDrawnAlone)
{
    MergeStudio studio;
    EXPECT_GE(_projects.size(), 18u);
    for (const Rendering& project : _projects)
    {
        EXPECT_TRUE(project.ok()) << project.name;
        const MergePicture picture = studio.drawAlone(project);
        EXPECT_EQ(picture.ok, project.name != NotGlsl) << project.name << "\n" << picture.log;
    }
}

TEST_F(MergeProjectsGLTest, allPairsAreMergedAndEqualTheirBlend)
{
    MergeStudio studio;
    for (const Rendering& a : _projects)
    {
        for (const Rendering& b : _projects)
        {
            if (a.name < b.name && a.name != NotGlsl && b.name != NotGlsl)
            {
                EXPECT_EQ(check(studio, {&a, &b}), 0u) << a.name << " and " << b.name;
            }
        }
    }
}

TEST_F(MergeProjectsGLTest, setsOfUpToAllEqualTheirBlend)
{
    MergeStudio studio;
    std::vector<const Rendering*> set;
    for (const Rendering& project : _projects)
    {
        if (project.name != NotGlsl)
        {
            set.push_back(&project);
            if (set.size() > 2 && (set.size() <= 8 || set.size() >= 17))
            {
                EXPECT_EQ(check(studio, set), 0u) << set.size();
            }
        }
    }
}

TEST_F(MergeProjectsGLTest, allAreLitByTheirOwnLightsWhereThatIsAskedFor)
{
    MergeStudio studio;
    const Rendering* before = nullptr;
    std::size_t different = 0;
    for (const Rendering& project : _projects)
    {
        if (project.name == NotGlsl)
        {
            continue;
        }
        const MergePicture own = studio.drawUnderOwnLighting(project);
        different += MergeStudio::compare(own, {studio.drawAlone(project)}).worst > 0.1 ? 1 : 0;
        EXPECT_EQ(check(studio, {before ? before : &project, &project}, true), 0u);
        before = &project;
    }
    EXPECT_GE(different, 5u) << "the studio's light is as good as the projects' own";
}

} // namespace
