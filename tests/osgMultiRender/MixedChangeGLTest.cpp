// SPDX-License-Identifier: MIT
// What changes while a MixedScene is shown: nothing is compiled for what moves, nothing is ever
// blank.
#include "osgMultiRender/MixedPictures.h"

#include <chrono>
#include <cmath>
#include <set>
#include <thread>

using namespace osgMultiRender;

namespace
{

class MixedChangeGLTest : public MixedPictures
{
protected:
    static Rendering plain(const std::string& name, const std::string& color)
    {
        Rendering rendering;
        rendering.name = name;
        rendering.shaders.push_back({GlslStage::Fragment,
                                     "void main()\n{\n    gl_FragColor = " + color + ";\n}\n",
                                     name + ".frag"});
        return rendering;
    }

    /// Colours of all pixels with a surface, in steps of 8 bits.
    std::set<std::uint32_t> colors(const osg::Image& picture) const
    {
        std::set<std::uint32_t> result;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
            {
                const auto* c = reinterpret_cast<const float*>(picture.data(x, y));
                std::uint32_t color = 0;
                for (int i = 0; i < 3; ++i)
                    color = color << 8 | std::uint32_t(std::lround(255.0f * c[i]));
                result.insert(color);
            }
        result.erase(0x333366); // of the empty window
        return result;
    }

    /// Draws until nothing is made any more.
    void drawUntil(double linked)
    {
        for (int i = 0; i < 20000 && count("mix.programs.linked") < linked; ++i)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            draw();
        }
        ASSERT_EQ(count("mix.programs.linked"), linked);
    }
};

using Lines = support::NotifyCapture::Lines;

} // namespace

TEST_F(MixedChangeGLTest, nothingIsCompiledWhileEverythingMoves)
{
    add("phong", {0.0, 0.0, 1.0, 3.0});
    add("toon", {1.0, 3.0, 3.0, 4.0});
    add("gooch", {3.0, 4.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    draw();
    const double linked = count("mix.programs.linked"), compiled = count("programs.compiled");
    EXPECT_EQ(linked, 1.0);
    for (int i = 0; i < 1000; ++i)
    {
        const double t = 0.01 * i;
        std::vector<osg::Vec3d> points;
        for (int k = 0; k <= i % 40; ++k)
            points.emplace_back(3.0 * std::sin(t + k), 2.0 * std::cos(2 * t + k), 0.1 * k - 1.0);
        _scene->setKeyPoints(points, KeyMode(i % 3));
        _scene->setRange(0, {0.0, 0.0, 1.0 + std::sin(t), 3.0});
        MixRules rules;
        rules.base = i % 4 - 1;
        rules.excess = MixRules::Excess(i / 4 % 2);
        _scene->setRules(rules);
        _scene->setUniform(0, "gloss", {1.0 + i % 100});
        _viewer.renderFloat(_scene, _camera, 32, 32);
    }
    EXPECT_EQ(count("mix.programs.linked"), linked);
    EXPECT_EQ(count("mix.programs.merged"), 1.0);
    EXPECT_EQ(count("programs.compiled"), compiled);
}

TEST_F(MixedChangeGLTest, programsOfFewerRenderingsAreMadeWhenNothingMoves)
{
    add("phong", {0.0, 0.0, 1.0, 1.2});
    add("toon", {1.0, 1.2, 2.0, 3.0});
    add("gooch", {2.0, 3.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    _scene->setSettleFrames(5);
    const osg::ref_ptr<osg::Image> before = osg::clone(draw(4).get(), osg::CopyOp::DEEP_COPY_ALL);
    EXPECT_EQ(count("mix.programs.linked"), 1.0);
    ASSERT_NO_FATAL_FAILURE(drawUntil(2.0));
    const osg::ref_ptr<osg::Image> after = draw(30);
    EXPECT_LE(support::difference(*after, *before, 1.0 / 255.0).worst, 1.0 / 255.0);
}

TEST_F(MixedChangeGLTest, aRenderingThatDoesNotCompileIsLeftOutByItsOwnFileAndLine)
{
    add("phong", {0.0, 0.0, 1.0, 3.0});
    add("toon", {1.0, 3.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    Rendering broken = plain("broken", "vec4(undeclared)");
    _scene->addRendering(broken, {0.0, 0.0, Infinity, Infinity});
    Rendering missing = importRendering("missing.frag");
    _scene->addRendering(missing);
    support::NotifyCapture capture;
    const osg::ref_ptr<osg::Image> picture = draw(3);
    const Lines warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 2u) << testing::PrintToString(warnings);
    EXPECT_NE(warnings[0].find("rendering 'broken' is left out: broken.frag:3:"), std::string::npos)
        << warnings[0];
    EXPECT_NE(warnings[1].find("missing.frag"), std::string::npos) << warnings[1];
    MixTruth truth(_viewer, _model, _camera, Size);
    truth.add(makeRenderingState(*findBuiltInRendering("phong")));
    truth.add(makeRenderingState(*findBuiltInRendering("toon")));
    EXPECT_EQ(truth.compare(*picture, _points, MixWeights(_ranges)).over, 0);
}

TEST_F(MixedChangeGLTest, whereAllFailTheModelKeepsItsLook)
{
    _scene->addRendering(plain("broken", "vec4(undeclared)"));
    _scene->addChild(_model);
    support::NotifyCapture capture;
    const osg::ref_ptr<osg::Image> picture = osg::clone(draw().get(), osg::CopyOp::DEEP_COPY_ALL);
    EXPECT_EQ(capture.takeWarnings().size(), 1u);
    const osg::ref_ptr<osg::Image> own = _viewer.renderFloat(_model, _camera, Size, Size);
    EXPECT_TRUE(support::CompareImage()(own, picture, "mixedNone"));
}

TEST_F(MixedChangeGLTest, theLastProgramStaysUntilTheNextOneIsLinked)
{
    const unsigned int red = _scene->addRendering(plain("red", "vec4(1.0, 0.0, 0.0, 1.0)"));
    setKeys({{0.0, 0.0, 0.0}});
    EXPECT_EQ(colors(*draw()), std::set<std::uint32_t>{0xff0000});
    const double leaves = count("leaves.program");
    EXPECT_GT(leaves, 0.0);
    _scene->setRendering(red, plain("green", "vec4(0.0, 1.0, 0.0, 1.0)"));
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 20000 && !seen.count(0x00ff00); ++i)
    {
        const std::set<std::uint32_t> now = colors(*draw());
        ASSERT_EQ(now.size(), 1u) << "a picture of two programs";
        seen.insert(now.begin(), now.end());
    }
    for (const std::uint32_t color : seen)
        EXPECT_TRUE(color == 0xff0000 || color == 0x00ff00) << std::hex << color;
    EXPECT_TRUE(seen.count(0x00ff00));
    // One that is broken does not take its place.
    support::NotifyCapture capture;
    _scene->setRendering(red, plain("blue", "vec4(0.0, 0.0, missing, 1.0)"));
    const unsigned int white = _scene->addRendering(plain("white", "vec4(1.0)"));
    draw(20);
    EXPECT_EQ(colors(*draw(20)), std::set<std::uint32_t>{0xffffff});
    EXPECT_EQ(capture.takeWarnings().size(), 1u);
    EXPECT_TRUE(_scene->removeRendering(red));
    EXPECT_EQ(colors(*draw(20)), std::set<std::uint32_t>{0xffffff});
    EXPECT_TRUE(_scene->removeRendering(white));
    EXPECT_FALSE(_scene->removeRendering(white));
    draw(2);
    EXPECT_EQ(count("leaves.fixedFunction") + count("leaves.program"), leaves);
}

TEST_F(MixedChangeGLTest, uniformsAreFoundByTheirOwnNames)
{
    Rendering rendering = plain("tinted", "vec4(tint[1], scale)");
    rendering.shaders[0].text = "uniform vec3 tint[2];\nuniform float scale; // = 0.5 [0, 1]\n"
                                "void main() { gl_FragColor = vec4(tint[1] * scale, 1.0); }\n";
    const unsigned int number = _scene->addRendering(rendering);
    setKeys({{0.0, 0.0, 0.0}});
    EXPECT_TRUE(_scene->setUniform(number, "tint", {0, 0, 0, 1, 0.4, 0.2}));
    EXPECT_TRUE(_scene->setUniform(number, "scale", {1.0}));
    EXPECT_EQ(colors(*draw()), std::set<std::uint32_t>{0xff6633});
    EXPECT_TRUE(_scene->setUniform(number, "scale", {0.5}));
    EXPECT_EQ(colors(*draw()).size(), 1u);
    EXPECT_EQ(count("mix.programs.linked"), 1.0);
    EXPECT_FALSE(_scene->setUniform(7, "scale", {0.5}));
    EXPECT_NE(_scene->getSource().find("tint"), std::string::npos);
}

TEST_F(MixedChangeGLTest, projectsReadTheirOwnMaterialsWhereThatIsAskedFor)
{
    Rendering rendering = plain("own", "gl_FrontMaterial.diffuse");
    rendering.state.given = rendering.state.hasMaterials = true;
    rendering.state.front.diffuse = {1.0f, 0.4f, 0.2f, 1.0f};
    _scene->addRendering(rendering);
    _scene->addRendering(plain("other", "gl_FrontMaterial.diffuse * 0.0"), {100.0, 100.0});
    setKeys({{0.0, 0.0, 0.0}});
    EXPECT_FALSE(colors(*draw()).count(0xff6633));
    _scene->setOwnLighting(true);
    drawUntil(2.0);
    EXPECT_EQ(colors(*draw()), std::set<std::uint32_t>{0xff6633});
}

TEST_F(MixedChangeGLTest, keptProgramsAreLimited)
{
    for (const char* const name : {"phong", "toon", "gooch", "wood", "xray"})
        add(name, {0.0, 0.0, 0.0, 0.0});
    setKeys({{0.0, 0.0, 0.0}});
    _scene->setSettleFrames(0);
    _scene->setMaxPrograms(3);
    for (int i = 0; i < 10; ++i)
    {
        for (unsigned int k = 0; k < 5; ++k)
            _scene->setRange(k, k == unsigned(i % 5) ? MixRange{0, 0, 50, 60}
                                                     : MixRange{90, 91, 92, 93});
        draw(4);
    }
    EXPECT_LE(count("mix.programs"), 3.0);
    EXPECT_GT(count("mix.programs.evicted"), 2.0);
}

TEST_F(MixedChangeGLTest, drawThreadsSeeOneMixAFrame)
{
    support::HeadlessSettings settings = makeSettings();
    settings.threading = osgViewer::ViewerBase::DrawThreadPerContext;
    support::HeadlessViewer threaded(settings);
    OSGKITS_NEED_GL(threaded);
    const unsigned int number = _scene->addRendering(plain("red", "vec4(1.0, 0.0, 0.0, 1.0)"));
    _scene->addRendering(plain("blue", "vec4(0.0, 0.0, 1.0, 1.0)"), {50.0, 60.0});
    _scene->addChild(_model);
    _scene->setSettleFrames(0);
    for (int i = 0; i < 60; ++i)
    {
        _scene->setKeyPoints({{0.1 * i, 0.0, 0.0}, {0.0, 0.1 * i, 0.0}}, KeyMode(i % 3));
        if (i % 10 == 5)
            _scene->setRendering(number,
                                 plain("red", "vec4(1.0, 0.0, 0.0, " + std::to_string(i) + ".0)"));
        const osg::ref_ptr<osg::Image> picture =
            threaded.renderFloat(_scene, _camera, Size, Size, 2);
        ASSERT_TRUE(picture);
        ASSERT_EQ(colors(*picture), std::set<std::uint32_t>{0xff0000}) << "frame " << i;
    }
}
