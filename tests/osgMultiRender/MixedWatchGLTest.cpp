// SPDX-License-Identifier: MIT
// Files that are edited while frames run.
#include "osgMultiRender/MixedPictures.h"

#include <osgMultiRender/MixFile.h>
#include <support/TemporaryFolder.h>

#include <osgDB/WriteFile>

#include <chrono>
#include <thread>

using namespace osgMultiRender;

namespace
{

class MixedWatchGLTest : public MixedPictures
{
protected:
    static std::string shader(const std::string& color)
    {
        return "void main()\n{\n    gl_FragColor = vec4(" + color + ", 1.0);\n}\n";
    }

    /// Of a pixel of the model.
    osg::Vec3 color()
    {
        const osg::ref_ptr<osg::Image> picture = draw();
        const osg::Vec4 pixel = picture->getColor(Size / 2, Size / 3);
        return {pixel.r(), pixel.g(), pixel.b()};
    }

    /// Draws until the colour is there, at most 20 s; all before has to be `before`.
    void waitFor(const osg::Vec3& before, const osg::Vec3& after)
    {
        osg::Vec3 now = before;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (now == before && std::chrono::steady_clock::now() < end)
        {
            now = color();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        EXPECT_EQ(now, after);
    }

    /// Draws until there are warnings, at most 20 s, and sees the colour all the time.
    support::NotifyCapture::Lines warningsWhile(support::NotifyCapture& capture,
                                                const osg::Vec3& expected)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        support::NotifyCapture::Lines warnings;
        while (warnings.empty() && std::chrono::steady_clock::now() < end)
        {
            EXPECT_EQ(color(), expected);
            warnings = capture.takeWarnings();
        }
        return warnings;
    }

    /// Draws for so long, and sees the colour all the time.
    void expectFor(std::chrono::milliseconds time, const osg::Vec3& expected)
    {
        const auto end = std::chrono::steady_clock::now() + time;
        while (std::chrono::steady_clock::now() < end)
            ASSERT_EQ(color(), expected);
    }

    const osg::Vec3 _red{1, 0, 0}, _green{0, 1, 0}, _blue{0, 0, 1};
    const support::TemporaryFolder _folder;
};

} // namespace

TEST_F(MixedWatchGLTest, anEditedShaderIsSeenLiveAndABrokenOneLeavesWhatWasThere)
{
    const std::string file = _folder.write("own.frag", shader("1.0, 0.0, 0.0"));
    _scene->addRendering(importRendering(file));
    _scene->setWatching(true);
    EXPECT_EQ(color(), _red);
    _folder.write("own.frag", shader("0.0, 1.0, 0.0"));
    waitFor(_red, _green);
    support::NotifyCapture capture;
    _folder.write("own.frag", shader("0.0, missing, 0.0"));
    const support::NotifyCapture::Lines warnings = warningsWhile(capture, _green);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("own.frag:3"), std::string::npos) << warnings[0];
    _folder.write("own.frag", shader("0.0, 0.0, 1.0"));
    waitFor(_green, _blue);
    _scene->setWatching(false);
    _folder.write("own.frag", shader("1.0, 0.0, 0.0"));
    expectFor(std::chrono::milliseconds(1500), _blue);
}

TEST_F(MixedWatchGLTest, anEditedMixTakesThePlaceOfTheOneBefore)
{
    _folder.write("red.frag", shader("1.0, 0.0, 0.0"));
    _folder.write("green.frag", shader("0.0, 1.0, 0.0"));
    const std::string mix =
        _folder.write("a.mix", R"({"renderings": [{"file": "red.frag"}], "watch": "on"})");
    std::string error;
    ASSERT_TRUE(readMixFile(*_scene, mix, error)) << error;
    EXPECT_TRUE(_scene->isWatching());
    EXPECT_EQ(color(), _red);
    support::NotifyCapture capture;
    _folder.write("a.mix", "{\n\"renderings\": [{]}");
    const support::NotifyCapture::Lines warnings = warningsWhile(capture, _red);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("a.mix: line 2"), std::string::npos) << warnings[0];
    _folder.write("a.mix", R"({"renderings": [{"file": "green.frag"}], "points": [[1, 2, 3]]})");
    waitFor(_red, _green);
    EXPECT_EQ(_scene->getRenderings().size(), 1u);
    EXPECT_EQ(_scene->getKeyPoints().size(), 1u);
}

TEST_F(MixedWatchGLTest, aMixWithABrokenRenderingLeavesWhatThatOneHasShown)
{
    const std::string red = _folder.write("own.frag", shader("1.0, 0.0, 0.0"));
    const std::string mix = _folder.write("a.mix", R"({"renderings": [{"file": "own.frag"}]})");
    std::string error;
    ASSERT_TRUE(readMixFile(*_scene, mix, error)) << error;
    EXPECT_EQ(color(), _red);
    support::NotifyCapture capture;
    _folder.write("own.frag", shader("0.0, missing, 0.0"));
    _folder.write("a.mix", R"({"renderings": [{"file": "own.frag"}], "points": [[1, 2, 3]]})");
    _scene->readFilesAgain();
    EXPECT_EQ(color(), _red);
    EXPECT_EQ(_scene->getKeyPoints().size(), 1u) << "what is right in it counts";
    const support::NotifyCapture::Lines warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("own.frag:3"), std::string::npos) << warnings[0];
    _scene->readFilesAgain(); // still broken: not forgotten either
    EXPECT_EQ(color(), _red);
    EXPECT_EQ(capture.takeWarnings().size(), 1u);
    _folder.write("own.frag", shader("0.0, 0.0, 1.0"));
    _scene->readFilesAgain();
    waitFor(_red, _blue);
}

TEST_F(MixedWatchGLTest, aTextureThatIsPaintedOverIsSeenLive)
{
    const std::string file = _folder.file("map.png");
    const auto paint = [&](const osg::Vec3& color)
    {
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(2, 2, 1, GL_RGB, GL_UNSIGNED_BYTE);
        for (unsigned int i = 0; i < 4; ++i)
            image->setColor(osg::Vec4(color, 1.0f), i % 2, i / 2);
        ASSERT_TRUE(osgDB::writeImageFile(*image, file));
    };
    paint(_red);
    // A project names its textures beside it.
    _folder.write("own.vert", "void main() { gl_Position = ftransform(); }\n");
    _folder.write("own.frag", "uniform sampler2D map;\nvoid main() { gl_FragColor = "
                              "texture2D(map, vec2(0.5)); }\n");
    const std::string project = _folder.write(
        "own.gdp",
        R"(<GLSLang><VPCount numero="1"><Filenames><Filename0 VertexProgram="own.vert"/></Filenames>
</VPCount><FPCount numero="1"><Filenames><Filename0 FragmentProgram="own.frag"/></Filenames></FPCount>
<TexturedUsed NumberUsedTU="1"><TextureUnit0 Filename="map.png" MinFilter="9728" MagFilter="9728"
 WrapS="10497" WrapT="10497" WrapR="10497" Target="3553"/></TexturedUsed>
<UniformVariables><Uniform0 Type="1" Name="map" ArraySize="1" Min="0" Max="1"><Values Value0="0"/>
</Uniform0></UniformVariables></GLSLang>)");
    const Rendering rendering = importRendering(project);
    ASSERT_TRUE(rendering.ok()) << (rendering.messages.empty() ? "" : rendering.messages[0].text);
    ASSERT_EQ(rendering.textures.size(), 1u);
    _scene->addRendering(rendering);
    _scene->setWatching(true);
    EXPECT_EQ(color(), _red);
    paint(_green);
    waitFor(_red, _green);
}
