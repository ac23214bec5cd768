// SPDX-License-Identifier: MIT
#include <osgMultiRender/Import.h>
#include <osgMultiRender/ImportProgram.h>
#include <osgMultiRender/Merger.h>

#include <support/TemporaryFolder.h>

#include <osg/Group>

#include <gtest/gtest.h>

#include <filesystem>

using namespace osgMultiRender;

namespace
{

constexpr char Fragment[] = "uniform vec3 C;\nvoid main() { gl_FragColor = vec4(C, 1.0); }\n";
constexpr char Vertex[] = "void main() { gl_Position = ftransform(); }\n";

std::string project(const std::string& inner, const std::string& fragment = "a.frag")
{
    return "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<GLSLang><VPCount numero=\"1\"><Filenames>"
           "<Filename0 VertexProgram=\"a.vert\"/></Filenames></VPCount><FPCount numero=\"1\">"
           "<Filenames><Filename0 FragmentProgram=\"" +
           fragment + "\"/></Filenames></FPCount>" + inner + "</GLSLang>";
}

class ImportTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(_folder.getPath() / "shaders");
        _folder.write("shaders/a.vert", Vertex);
        _folder.write("shaders/a.frag", Fragment);
    }

    Rendering import(const std::string& name, const std::string& text)
    {
        return importRendering(_folder.write("shaders/" + name, text));
    }

    /// The one error of a project, without its path.
    std::string errorOf(const std::string& text)
    {
        const Rendering rendering = import("p.gdp", text);
        EXPECT_FALSE(rendering.ok());
        std::string errors;
        int count = 0;
        for (const RenderingMessage& message : rendering.messages)
        {
            EXPECT_EQ(message.text.find('\n'), std::string::npos);
            count += message.error ? 1 : 0;
            errors += message.error ? message.text : "";
        }
        EXPECT_EQ(count, 1) << errors;
        const std::size_t at = errors.find("p.gdp: ");
        return at == std::string::npos ? errors : errors.substr(at + 7);
    }

    support::TemporaryFolder _folder;
};

TEST_F(ImportTest, projectsOfShaderDesignerAreReadWhole)
{
    _folder.write("wood.png", "not looked at");
    const Rendering r = import("p.gdp", project(R"(
<TexturedUsed NumberUsedTU="1"><TextureUnit3 Filename="..\wood.png" MinFilter="9729" MagFilter="9728" Target="3553" WrapS="33071" WrapT="10497"/></TexturedUsed>
<UniformVariables NumberOfVariables="2"><Uniform0 Type="7" Name="C" ArraySize="1" Min="-1" Max="2"><Values Value0="0.5" Value1="0.25" Value2="1"/></Uniform0>
<Uniform1 Type="5" Name="list" ArraySize="3"><Values Value0="1" Value1="2" Value2="3"/></Uniform1></UniformVariables>
<VertexProcessor CullFace="True" TwoSidedValue="1" PolygonModeFront="6913"/>
<FragmentProcessor Shade="7424" AlphaTest="True" AlphaFunc="516" AlphaClamp="0.5" Blending="True" BlendFuncSRC="770" DepthTest="False" ClearColorR="0.5"/>
<BuiltInStates><ModelAmbient AmbientR="0.1"/><FrontMaterial DifR="0.75" Shininess="32"/>
<Light1 Enabled="True" PosX="1" PosW="1" SpotCutoff="45" SpotLinear="0.5"/></BuiltInStates>)"));
    ASSERT_TRUE(r.ok()) << r.messages[0].text;
    EXPECT_TRUE(r.messages.empty());
    EXPECT_EQ(r.name, "p");
    ASSERT_EQ(r.shaders.size(), 2u);
    EXPECT_EQ(r.shaders[1].text, Fragment);
    ASSERT_EQ(r.textures.size(), 1u);
    EXPECT_EQ(r.textures[0].unit, 3u);
    EXPECT_EQ(r.textures[0].fileName, _folder.file("wood.png"));
    EXPECT_EQ(r.textures[0].minFilter, 9729u);
    EXPECT_EQ(r.textures[0].wrap[0], 33071u);
    ASSERT_TRUE(r.findUniform("C"));
    EXPECT_EQ(r.findUniform("C")->type, "vec3");
    EXPECT_EQ(r.findUniform("C")->values, (std::vector<double>{0.5, 0.25, 1.0}));
    EXPECT_EQ(r.findUniform("C")->minimum, -1.0);
    EXPECT_EQ(r.findUniform("list")->arraySize, 3);
    EXPECT_TRUE(r.state.given && r.state.cullFace && r.state.twoSided && r.state.alphaTest);
    EXPECT_EQ(r.state.shadeModel, 7424u);
    EXPECT_FALSE(r.state.depthTest);
    EXPECT_FLOAT_EQ(r.state.clearColor[0], 0.5f);
    EXPECT_FLOAT_EQ(r.state.modelAmbient[0], 0.1f);
    EXPECT_FLOAT_EQ(r.state.front.diffuse[0], 0.75f);
    EXPECT_FLOAT_EQ(r.state.front.shininess, 32.0f);
    ASSERT_EQ(r.state.lights.size(), 1u);
    EXPECT_EQ(r.state.lights[0].number, 1u);
    EXPECT_FLOAT_EQ(r.state.lights[0].spotCutoff, 45.0f);
    EXPECT_FLOAT_EQ(r.state.lights[0].attenuation[1], 0.5f);
}

TEST_F(ImportTest, countsNeedNotAgreeWithWhatIsThere)
{
    const Rendering r = import(
        "p.gdp", project("<UniformVariables NumberOfVariables=\"9\"><Uniform4 Type=\"5\" "
                         "Name=\"x\"/><Uniform4 Type=\"5\" Name=\"y\"/></UniformVariables>"));
    EXPECT_TRUE(r.ok());
    ASSERT_EQ(r.uniforms.size(), 1u);
    ASSERT_EQ(r.messages.size(), 1u);
    EXPECT_NE(r.messages[0].text.find("UniformVariables counts 9, but 1 are there"),
              std::string::npos);
}

TEST_F(ImportTest, brokenProjectsGiveOneClearError)
{
    EXPECT_EQ(errorOf("").substr(0, 16), "it is no XML: No");
    EXPECT_EQ(errorOf("<GLSLang><VPCount").substr(0, 13), "it is no XML:");
    const std::string whole = project("");
    for (std::size_t size = 1; size < whole.size(); size += 7)
    {
        errorOf(whole.substr(0, size));
    }
    EXPECT_EQ(errorOf("<html/>"), "it is no project of ShaderDesigner: the root is not 'GLSLang'");
    EXPECT_EQ(errorOf("<GLSLang/>"), "it names no shaders");
    EXPECT_EQ(errorOf(project("", "b.frag")), "FragmentProgram 'b.frag': the file is not there");
    EXPECT_EQ(errorOf(project("", "")), "FragmentProgram '': the file's name is missing");
}

TEST_F(ImportTest, filesOutsideOfTheProjectsFoldersAreRefused)
{
    for (const char* name :
         {"/etc/passwd", "../../a.frag", "..\\..\\a.frag", "C:\\a.frag", "x/../../../a.frag"})
    {
        EXPECT_EQ(errorOf(project("", name)),
                  std::string("it names '") + name + "', outside of its folder");
    }
}

TEST_F(ImportTest, absurdNumbersAreBounded)
{
    const Rendering r = import(
        "p.gdp",
        project(
            "<TexturedUsed NumberUsedTU=\"99999999999\"><TextureUnit999999999999 "
            "Filename=\"a\"/><TextureUnit7 MinFilter=\"-5\" "
            "Target=\"1e300\"/></TexturedUsed><UniformVariables NumberOfVariables=\"-1\"><Uniform0 "
            "Type=\"1e9\" Name=\"x\" ArraySize=\"4000000000\" Min=\"nan\" Max=\"inf\"><Values "
            "Value0=\"1e999\"/></Uniform0></UniformVariables>"));
    EXPECT_TRUE(r.ok());
    ASSERT_EQ(r.textures.size(), 1u);
    EXPECT_EQ(r.textures[0].target, 0x0DE1u);
    EXPECT_EQ(r.uniforms[0].arraySize, 1);
    EXPECT_EQ(r.uniforms[0].type, "");
    EXPECT_EQ(r.uniforms[0].maximum, 1.0);
}

TEST_F(ImportTest, entityBombsStaySmall)
{
    std::string bomb = "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"aaaaaaaaaa\">";
    for (char c = 'b'; c < 'k'; ++c)
    {
        bomb += std::string("<!ENTITY ") + c + " \"";
        for (int i = 0; i < 10; ++i)
        {
            bomb += std::string("&") + char(c - 1) + ";";
        }
        bomb += "\">";
    }
    bomb += "]><GLSLang><FPCount numero=\"1\"><Filenames><Filename0 "
            "FragmentProgram=\"&j;\"/></Filenames></FPCount></GLSLang>";
    EXPECT_EQ(errorOf(bomb), "FragmentProgram '&j;': the file is not there");
}

TEST_F(ImportTest, pairsOfGlslFilesFindEachOther)
{
    for (const char* name : {"shaders/a.vert", "shaders/a.frag"})
    {
        const Rendering r = importRendering(_folder.file(name));
        EXPECT_TRUE(r.ok());
        EXPECT_EQ(r.name, "a");
        EXPECT_EQ(r.shaders.size(), 2u);
    }
}

TEST_F(ImportTest, commentsAndSideFilesGiveUniformsTheirValues)
{
    _folder.write("shaders/c.uniforms", "# values\nside = 0.5, 0.25\r\nC = 9\n\nnonsense\n");
    const Rendering r =
        import("c.frag",
               "uniform vec3 C; // = 1, 0.5, .25 min -1 max 3\nuniform vec2 side; /* = 7 7 "
               "*/\nuniform float k = 2.5;\nuniform float none; // nothing = 1\nuniform sampler2D "
               "wood; // = \"wood.png\"\nuniform sampler2D model; // = 4\nvoid main() {}\n");
    EXPECT_EQ(r.findUniform("C")->values, std::vector<double>{9.0});
    EXPECT_EQ(r.findUniform("C")->minimum, -1.0);
    EXPECT_EQ(r.findUniform("C")->maximum, 3.0);
    EXPECT_EQ(r.findUniform("side")->values, (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(r.findUniform("k")->values, std::vector<double>{2.5});
    EXPECT_TRUE(r.findUniform("none")->values.empty());
    ASSERT_EQ(r.textures.size(), 1u);
    EXPECT_EQ(r.textures[0].fileName, _folder.file("shaders/wood.png"));
    EXPECT_EQ(r.findUniform("model")->values, std::vector<double>{4.0});
    ASSERT_EQ(r.messages.size(), 1u);
    EXPECT_NE(r.messages[0].text.find("c.uniforms:5: not 'name = values'"), std::string::npos);
}

TEST_F(ImportTest, imageShadersAreRecognized)
{
    const Rendering r =
        import("toy.frag", "void mainImage(out vec4 c, in vec2 at)\n{\n    c = vec4(at / "
                           "iResolution.xy, iTime, 1.0) + undeclared(;\n}\n");
    ASSERT_TRUE(r.ok());
    const Merged merged = mergeRenderings({{&r, 1.0}});
    ASSERT_TRUE(merged.messages.size() > 0);
    // The author's own line.
    EXPECT_NE(merged.messages[0].text.find("toy.frag:3: "), std::string::npos)
        << merged.messages[0].text;
}

TEST_F(ImportTest, otherFilesAreNamed)
{
    EXPECT_NE(import("a.txt", "x").messages[0].text.find("a.txt: not a file that can be imported"),
              std::string::npos);
    EXPECT_NE(importRendering(_folder.file("none.gdp"))
                  .messages[0]
                  .text.find("none.gdp: the file is not there"),
              std::string::npos);
}

TEST_F(ImportTest, programsOfModelsAreImportedOnce)
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("look");
    program->addShader(new osg::Shader(osg::Shader::VERTEX, Vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       std::string("#pragma import_defines(FINE)\n") + Fragment));
    program->addBindAttribLocation("tangent", 6);
    for (int i = 0; i < 3; ++i)
    {
        osg::ref_ptr<osg::Group> child = new osg::Group;
        child->getOrCreateStateSet()->setAttribute(program);
        child->getOrCreateStateSet()->addUniform(
            new osg::Uniform("C", osg::Vec3(0.5f, 0.25f, 1.0f)));
        child->getOrCreateStateSet()->setDefine("FINE", "2");
        child->getOrCreateStateSet()->setDefine("OTHER", "3");
        root->addChild(child);
    }
    const std::vector<Rendering> all = importPrograms(*root);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].name, "look");
    EXPECT_EQ(all[0].attributeBindings.at("tangent"), 6u);
    EXPECT_EQ(all[0].findUniform("C")->values, (std::vector<double>{0.5, 0.25, 1.0}));
    EXPECT_EQ(all[0].findUniform("C")->type, "vec3");
    EXPECT_EQ(all[0].defines, (std::map<std::string, std::string>{{"FINE", "2"}}));
    EXPECT_TRUE(mergeRenderings({{&all[0], 1.0}}).ok);
}

} // namespace
