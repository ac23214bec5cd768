// SPDX-License-Identifier: MIT
// The shaders of OpenSceneGraph's own examples, alone and merged.
#include "osgMultiRender/CppShaders.h"
#include "osgMultiRender/MergeCases.h"
#include "osgMultiRender/MergeChecks.h"
#include "osgMultiRender/MergePicture.h"

#include <support/ChildProcess.h>
#include <support/FilesBelow.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

using namespace osgMultiRender;
using mergeChecks::errorsOf;

namespace
{

/// Debian's package openscenegraph-examples.
constexpr char Folder[] = "/usr/share/openscenegraph/examples";
constexpr double Step = 1.0 / 255.0;

std::string readFile(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class MergeExamplesGLTest : public PlainGLTest
{
protected:
    void SetUp() override
    {
        PlainGLTest::SetUp();
        if (!hasContext())
            return;
        const auto files = support::filesBelow(Folder, {".cpp", ".h"});
        if (files.empty())
            GTEST_SKIP() << "the package openscenegraph-examples is not installed";
        for (const std::filesystem::path& file : files)
            addPrograms(file.stem().string(), shadersOfCpp(readFile(file)));
    }

    /// Each fragment shader with the vertex shader before it, as the examples have them, and what
    /// lies between; a vertex shader without one with the fixed function's.
    void addPrograms(const std::string& name, const std::vector<CppShader>& shaders)
    {
        std::vector<RenderingShader> pending;
        bool isComplete = true;
        const auto finish = [&]
        {
            Rendering program;
            program.name = name + std::to_string(_programs.size());
            program.shaders = pending;
            _programs.push_back(program);
            isComplete = true;
        };
        const auto finishOpen = [&]
        {
            if (isComplete)
                return;
            pending.push_back(
                {GlslStage::Fragment, "void main() { gl_FragColor = vec4(0.5); }", name});
            finish();
        };
        for (const CppShader& shader : shaders)
        {
            ++_shaders;
            if (shader.stage == GlslStage::Vertex)
            {
                finishOpen();
                pending.clear();
            }
            else if (isComplete) // another fragment shader for the same vertex shader
                pending.resize(std::min<std::size_t>(pending.size(), 1));
            pending.push_back({shader.stage, shader.text, name});
            isComplete = false;
            if (shader.stage == GlslStage::Fragment)
                finish();
        }
        finishOpen();
    }

    Merged mergeWithPartner(const Rendering& program)
    {
        MergeOptions options;
        options.weights = MergeStudio::weights(2);
        return mergeRenderings({{&mergePartner(), 1.0}, {&program, 1.0}}, options);
    }

    std::vector<Rendering> _programs;
    int _shaders = 0;
};

bool hasOtherStage(const Rendering& program)
{
    return std::any_of(program.shaders.begin(), program.shaders.end(),
                       [](const RenderingShader& shader) {
                           return shader.stage != GlslStage::Vertex &&
                                  shader.stage != GlslStage::Fragment;
                       });
}

/// gl_Color, which is any colour where the vertex shader sets none.
bool readsWhatNoneWrites(const Rendering& program)
{
    return program.name.compare(0, 9, "osgpoints") == 0;
}

} // namespace

TEST_F(MergeExamplesGLTest, whatLinksAloneIsMergedAndEqualsItsBlend)
{
    MergeStudio studio;
    const MergePicture partner = studio.drawAlone(mergePartner());
    int linked = 0, compared = 0;
    for (const Rendering& program : _programs)
    {
        const MergePicture alone = studio.drawAlone(program);
        if (!alone.ok || hasOtherStage(program))
            continue; // of another GLSL than this driver's, or of several objects
        ++linked;
        const Merged merged = mergeWithPartner(program);
        ASSERT_TRUE(merged.renderings[1].included) << program.name << ": " << errorsOf(merged);
        const MergePicture picture =
            studio.drawMerged(merged, {{&mergePartner(), 1.0}, {&program, 1.0}});
        EXPECT_TRUE(picture.ok) << program.name << "\n" << merged.explain(picture.log);
        if (!picture.ok || merged.renderings[1].movesVertices || readsWhatNoneWrites(program))
            continue; // the partner's places are shown
        ++compared;
        const MergeDifference difference = MergeStudio::compare(picture, {partner, alone});
        EXPECT_LE(difference.worst, Step) << program.name;
        EXPECT_EQ(difference.beside, 0u) << program.name;
    }
    std::cout << _shaders << " shaders, " << _programs.size() << " programs, " << linked
              << " link alone, " << compared << " have the partner's positions\n";
    // Debian 12 and Mesa 22.3: 82, 25 and 13. Others are of GLSL that Mesa does not take, or have
    // functions in other objects.
    EXPECT_GE(_shaders, 80);
    EXPECT_GE(linked, 20);
    EXPECT_GE(compared, 10);
}

TEST_F(MergeExamplesGLTest, otherStagesAreRefusedAndAllElseIsNamedOrMerged)
{
    int refused = 0;
    for (const Rendering& program : _programs)
    {
        const Merged merged = mergeWithPartner(program);
        ASSERT_TRUE(merged.ok) << program.name;
        if (hasOtherStage(program))
        {
            ++refused;
            EXPECT_NE(errorsOf(merged).find("only vertex and fragment stages can be merged, not "
                                            "geometry or tessellation"),
                      std::string::npos)
                << program.name;
        }
        else
            EXPECT_EQ(merged.renderings[1].included, errorsOf(merged).empty()) << program.name;
    }
    EXPECT_GE(refused, 4);
}

TEST_F(MergeExamplesGLTest, mergedTextsAreValidForAnotherCompilerWhereTheirOwnAre)
{
    support::ChildProcess version;
    version.arguments = {"glslangValidator", "--version"};
    if (version.run().exitCode != 0)
        GTEST_SKIP() << "glslangValidator is not installed";
    const support::TemporaryFolder folder;
    const auto validate = [&](const std::string& vertex, const std::string& fragment)
    {
        support::ChildProcess process;
        process.arguments = {"glslangValidator", "-l", folder.write("m.vert", vertex),
                             folder.write("m.frag", fragment)};
        return process.run();
    };
    int valid = 0;
    for (const Rendering& program : _programs)
    {
        if (program.shaders.size() != 2 || hasOtherStage(program) ||
            validate(program.shaders[0].text, program.shaders[1].text).exitCode != 0)
            continue;
        ++valid;
        const Merged merged = mergeWithPartner(program);
        const support::ProcessResult result = validate(merged.vertex, merged.fragment);
        EXPECT_EQ(result.exitCode, 0) << program.name << "\n" << merged.explain(result.output);
    }
    std::cout << valid << " programs that are valid alone\n";
    EXPECT_GE(valid, 5); // 7 here; it wants all names to be of the version
}
