// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace
{

class OsgMergeTest : public testing::Test
{
protected:
    support::ProcessResult run(std::vector<std::string> words) const
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_OSGMERGE};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        return process.run();
    }

    static bool holds(const std::string& text, const std::string& part)
    {
        return text.find(part) != std::string::npos;
    }

    support::TemporaryFolder _folder;
    const std::string _red = _folder.write(
        "red.frag",
        "uniform vec3 tint; // = 1, 0, 0\nfloat twice = 2.0;\nvec3 f(vec3 x) { return x; }\n"
        "uniform sampler2D map; // = \"wood.png\"\n"
        "void main() { gl_FragColor = vec4(f(tint) * twice, 1.0) * texture2D(map, "
        "gl_TexCoord[0].st); }\n");
    const std::string _cut = _folder.write(
        "cut.frag",
        "void main() { if (gl_FragCoord.x > 9.0) discard; gl_FragColor = vec4(1.0); }\n");
};

TEST_F(OsgMergeTest, printsTheMergedProgram)
{
    const auto result = run({_red, _cut});
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_TRUE(holds(result.output, "// vertex stage\n#version 330 compatibility"));
    EXPECT_TRUE(holds(result.output, "vec4 red_0_main()"));
    EXPECT_TRUE(holds(result.output, "vec4 cut_1_main()"));
}

TEST_F(OsgMergeTest, mergesBuiltInRenderingsByName)
{
    const auto result = run({"phong", _red});
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_TRUE(holds(result.output, "vec4 phong_0_main()"));
    EXPECT_TRUE(holds(result.output, "vec4 red_1_main()"));
}

TEST_F(OsgMergeTest, givesProjectsTheirOwnLightsOnDemand)
{
    _folder.write("lit.frag", "void main() { gl_FragColor = gl_FrontMaterial.diffuse; }");
    const std::string project = _folder.write(
        "lit.gdp", "<GLSLang><FPCount numero=\"1\"><Filenames><Filename0 "
                   "FragmentProgram=\"lit.frag\"/></Filenames></FPCount><BuiltInStates>"
                   "<FrontMaterial DifR=\"0.75\"/></BuiltInStates></GLSLang>");
    EXPECT_TRUE(holds(run({project}).output, "= gl_FrontMaterial.diffuse"));
    const auto result = run({"--own-lighting", project});
    EXPECT_TRUE(holds(result.output, "const gl_MaterialParameters frontMaterial_0 ="));
    EXPECT_TRUE(holds(result.output, "vec4(0.750000000"));
    EXPECT_TRUE(holds(result.output, "= frontMaterial_0.diffuse"));
}

TEST_F(OsgMergeTest, writesTwoFiles)
{
    const auto result = run({_red, "-o", _folder.file("out")});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.output, "");
    EXPECT_TRUE(std::filesystem::exists(_folder.file("out.vert")));
    EXPECT_TRUE(std::filesystem::exists(_folder.file("out.frag")));
}

TEST_F(OsgMergeTest, listsWhatEachProgramDeclares)
{
    const auto result = run({"--list", _red});
    EXPECT_EQ(result.output, "red\n  qualified variables\n    uniform sampler2D map\n"
                             "    uniform vec3 tint\n  functions\n    main\n    f\n  globals\n"
                             "    float twice\n  texture units\n    0\n");
}

TEST_F(OsgMergeTest, mapsNamesAndUnitsAndTellsStatistics)
{
    const auto result = run({"--map", "--stats", _cut, _red});
    EXPECT_TRUE(holds(result.output, "uniform red.tint -> vec3 tint_1\n"));
    EXPECT_TRUE(holds(result.output, "uniform red.map -> sampler2D map_1 unit 0\n"));
    EXPECT_TRUE(holds(result.output, "wood.png\n"));
    EXPECT_TRUE(holds(result.output, "merged in "));
    EXPECT_TRUE(holds(result.output, "samplers: 1 fragment"));
}

TEST_F(OsgMergeTest, leavesOutWhatIsBrokenAndSaysSo)
{
    const auto result = run({_red, _folder.write("bad.frag", "\nvoid main() {\n")});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(holds(result.errors, "bad.frag:2: the brace is not closed"));
    EXPECT_TRUE(holds(result.output, "red_0_main"));
    EXPECT_EQ(run({_folder.file("none.gdp")}).exitCode, 2);
}

TEST_F(OsgMergeTest, complainsOfWrongOptions)
{
    EXPECT_EQ(run({"--help"}).exitCode, 0);
    EXPECT_EQ(run({}).errors, "osgmerge: PROGRAM is required; see --help\n");
    EXPECT_EQ(run({"--colour"}).errors, "osgmerge: unknown option '--colour'; see --help\n");
    EXPECT_EQ(run({"-o"}).errors, "osgmerge: -o: 1 required FILE missing; see --help\n");
    EXPECT_EQ(run({"--limit", "magic=3"}).errors,
              "osgmerge: --limit: 'magic' is none of varyings, samplers, units, uniforms, "
              "attributes; see --help\n");
}

TEST_F(OsgMergeTest, keepsToLimits)
{
    const auto result = run({"--limit", "samplers=0", "--stats", _cut, _red});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(
        holds(result.errors, "red: left out: with 'red' the program has 1 fragment samplers of 0"));
}

} // namespace
