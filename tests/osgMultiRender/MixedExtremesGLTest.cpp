// SPDX-License-Identifier: MIT
// Mixes that no one would make on purpose.
#include "osgMultiRender/MixedPictures.h"

#include <osgMultiRender/MixFile.h>
#include <support/TemporaryFolder.h>

#include <atomic>
#include <thread>

using namespace osgMultiRender;

namespace
{

class MixedExtremesGLTest : public MixedPictures
{
protected:
    static Rendering makePlain(const std::string& name, const std::string& statement)
    {
        Rendering rendering;
        rendering.name = name;
        rendering.shaders.push_back(
            {GlslStage::Fragment, "void main()\n{\n    " + statement + "\n}\n", name});
        return rendering;
    }

    /// Of a pixel of the model.
    osg::Vec4 colorOf(const osg::Image& picture)
    {
        return picture.getColor(unsigned(Size / 2), unsigned(Size / 3));
    }

    osg::Vec4 color() { return colorOf(*draw()); }
};

const osg::Vec4 Green(0, 1, 0, 1), Red(1, 0, 0, 1);

} // namespace

TEST_F(MixedExtremesGLTest, aRenderingThatAlwaysDiscardsLeavesTheOthers)
{
    _scene->addRendering(makePlain("nothing", "discard;"));
    _scene->addRendering(makePlain("green", "gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);"));
    support::NotifyCapture capture;
    EXPECT_EQ(color(), Green);
    MixRules rules;
    rules.excess = MixRules::Excess::Normalise; // half of the weight has gone
    _scene->setRules(rules);
    EXPECT_NEAR(color().g(), 0.5, 1e-3);
    rules.excess = MixRules::Excess::Clamp;
    _scene->setRules(rules);
    _scene->removeRendering(1);
    const osg::Vec4 behind = support::HeadlessSettings().clearColor;
    osg::Vec4 seen;
    for (int i = 0; i < 20000 && (seen = color()) != behind; ++i) // merged meanwhile
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(seen, behind) << "all discard, so nothing is drawn";
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(MixedExtremesGLTest, renderingsComeAndGoWhileTheyAreDrawn)
{
    _scene->addRendering(makePlain("green", "gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);"));
    MixRules rules;
    rules.excess = MixRules::Excess::Normalise;
    _scene->setRules(rules);
    ASSERT_EQ(color(), Green);
    std::atomic<bool> ends{false};
    support::NotifyCapture capture;
    std::thread other(
        [&]
        {
            const Rendering red = makePlain("red", "gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0);");
            while (!ends)
            {
                const unsigned int number = _scene->addRendering(red);
                std::this_thread::sleep_for(std::chrono::milliseconds(3));
                _scene->removeRendering(number);
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
            }
        });
    for (int i = 0; i < 150; ++i)
    {
        const osg::Vec4 seen = color();
        const bool isMix = (seen - (Green + Red) * 0.5f).length() < 1e-3f;
        EXPECT_TRUE(seen == Green || isMix) << seen.r() << " " << seen.g() << " " << seen.b();
    }
    ends = true;
    other.join();
    EXPECT_EQ(color(), Green);
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(MixedExtremesGLTest, rangesInWrongOrderNegativeOrNotNumbersAreDrawnAsTheReferenceSays)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    add("phong", {2.0, 1.0, 3.0, 2.5});    // each is at least the one before
    add("toon", {-4.0, -3.0, -1.0, -0.5}); // before all
    add("gooch", {-2.0, -1.0, 1.0, 2.0});
    add("wood", {0.0, nan, 1.0, 2.0}); // never
    setKeys({{-1.6, -1.0, 0.5}, {-1.6, -1.0, 0.5}}, KeyMode::PolylineLoop);
    expectTruth("mixedWrongRanges");
}

TEST_F(MixedExtremesGLTest, coincidentPointsAndALoopOfOneAreThatPoint)
{
    add("phong", {0.0, 0.0, 1.0, 3.0});
    add("gooch", {1.0, 3.0, Infinity, Infinity});
    const osg::Vec3d point(-1.6, -1.0, 0.5);
    setKeys({point});
    const osg::ref_ptr<osg::Image> single = osg::clone(draw().get(), osg::CopyOp::DEEP_COPY_ALL);
    for (const KeyMode mode : {KeyMode::Points, KeyMode::Polyline, KeyMode::PolylineLoop})
        for (const auto& points : {std::vector<osg::Vec3d>{point}, {point, point}})
        {
            setKeys(points, mode);
            EXPECT_LE(support::difference(*draw(), *single, 1.0).worst, 1e-5) << int(mode);
        }
}

TEST_F(MixedExtremesGLTest, aHundredImportsOfOneFileShowWhatOneDoes)
{
    const support::TemporaryFolder folder;
    const std::string file = folder.write(
        "own.frag", "uniform vec3 tint; // = 0.25 0.5 0.75\nvec3 shade(vec3 c) { return c * c; }\n"
                    "void main() { gl_FragColor = vec4(shade(tint), 1.0); }\n");
    _scene->addRendering(importRendering(file));
    const osg::Vec4 one = color();
    for (int i = 1; i < 100; ++i)
        EXPECT_EQ(_scene->addRendering(importRendering(file)), unsigned(i));
    MixRules rules;
    rules.excess = MixRules::Excess::Normalise;
    _scene->setRules(rules);
    support::NotifyCapture capture;
    osg::Vec4 all;
    for (int i = 0; i < 20000 && _scene->getSource().find("own_99") == std::string::npos; ++i)
    {
        all = color();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    all = color();
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
    EXPECT_LT((all - one).length(), 1e-4f);
    _scene->setUniform(99, "tint", {1.0, 0.5, 0.75});
    EXPECT_NEAR(color().r(), (99 * 0.0625 + 1.0) / 100.0, 1e-4) << "each has values of its own";
}
