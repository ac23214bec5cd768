// SPDX-License-Identifier: MIT
// Where a program can't hold all renderings.
#include "osgMultiRender/MixedPictures.h"

#include <osgMultiRender/MixShares.h>

#include <chrono>
#include <thread>

using namespace osgMultiRender;

namespace
{

class MixedLimitsGLTest : public MixedPictures
{
protected:
    /// Its samplers read the model's textures, each a unit of its own.
    static Rendering reads(const std::string& name, int samplers, const std::string& color)
    {
        std::string text, sum;
        for (int i = 0; i < samplers; ++i)
        {
            text += "uniform sampler2D map" + std::to_string(i) + ";\n";
            sum += " + 0.0 * texture2D(map" + std::to_string(i) + ", vec2(0.5))";
        }
        Rendering rendering;
        rendering.name = name;
        rendering.shaders.push_back(
            {GlslStage::Fragment,
             text + "void main()\n{\n    gl_FragColor = " + color + sum + ";\n}\n",
             name + ".frag"});
        return rendering;
    }

    /// Two of the three fit. The sample model is some 4 units wide, the key point at its left.
    void addThree(double firstEnds, double secondEnds)
    {
        MergeLimits limits;
        limits.fragmentSamplers = 6;
        _scene->setLimits(&limits);
        _scene->addRendering(reads("red", 3, "vec4(1.0, 0.0, 0.0, 1.0)"));
        _scene->addRendering(reads("green", 3, "vec4(0.0, 1.0, 0.0, 1.0)"));
        _scene->addRendering(reads("blue", 3, "vec4(0.0, 0.0, 1.0, 1.0)"));
        setEnds(firstEnds, secondEnds);
        setKeys({{-2.0, 0.0, 0.0}});
    }

    void setEnds(double first, double second)
    {
        _scene->setRange(0, {0.0, 0.0, first, first});
        _scene->setRange(1, {first, first, second, second});
        _scene->setRange(2, {second, second, Infinity, Infinity});
    }

    std::string planOf(const std::string& subject) const
    {
        for (const Plan& plan : _scene->getPlans())
            for (const PlanEntry& entry : plan.entries)
                if (entry.subject == subject && entry.decision == PlanEntry::Decision::Dropped)
                    return entry.reason;
        return "";
    }

    std::string leftOut() const
    {
        return planOf("rendering 0 'red'") + "|" + planOf("rendering 1 'green'") + "|" +
               planOf("rendering 2 'blue'");
    }
};

const std::string Reason = ": left out: with 'blue' the program has 9 fragment samplers of 6";

} // namespace

TEST_F(MixedLimitsGLTest, thePlanNamesTheLimitAndTheRenderingThatPassesIt)
{
    addThree(1.5, 4.0);
    support::NotifyCapture capture;
    draw();
    EXPECT_NE(leftOut().find(Reason), std::string::npos) << leftOut();
    const support::NotifyCapture::Lines warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(Reason + "; it has the least weight"), std::string::npos);
    draw(3);
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines()) << "said once";
}

TEST_F(MixedLimitsGLTest, theLeastWeightedIsLeftOutWhateverTheOrder)
{
    const struct
    {
        double first, second;
        const char* subject;
        const char* name;
    } all[] = {{0.2, 2.5, "rendering 0 'red'", "red"},
               {2.5, 2.6, "rendering 1 'green'", "green"},
               {1.5, 6.0, "rendering 2 'blue'", "blue"}};
    for (const auto& one : all)
    {
        _scene = new MixedScene;
        addThree(one.first, one.second);
        support::NotifyCapture capture;
        draw();
        capture.takeWarnings();
        EXPECT_EQ(planOf(one.subject), one.name + Reason) << leftOut();
    }
}

TEST_F(MixedLimitsGLTest, withoutALowerLimitAllAreShown)
{
    addThree(0.2, 2.5);
    _scene->setLimits(nullptr);
    support::NotifyCapture capture;
    draw();
    EXPECT_EQ(leftOut(), "||");
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
}

TEST_F(MixedLimitsGLTest, whatDoesNotCountForTheLimitStays)
{
    addThree(1.5, 4.0);
    const unsigned int plain = _scene->addRendering(reads("plain", 0, "vec4(0.5)"));
    _scene->setRange(plain, {Infinity, Infinity, Infinity, Infinity}); // no weight at all
    support::NotifyCapture capture;
    draw();
    capture.takeWarnings();
    EXPECT_EQ(planOf("rendering 3 'plain'"), "");
    EXPECT_NE(leftOut(), "||");
}

TEST_F(MixedLimitsGLTest, renderingsChangePlacesWhenAnotherOneHasTheLeastWeightAndNothingMoves)
{
    addThree(0.2, 2.5);
    _scene->setSettleFrames(3);
    _scene->setPruning(false);
    support::NotifyCapture capture;
    draw();
    ASSERT_NE(planOf("rendering 0 'red'"), "");
    const double linked = count("mix.programs.linked");
    for (int i = 0; i < 20; ++i)
    {
        setEnds(2.4 + 0.01 * i, 2.7);
        draw();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(count("mix.programs.linked"), linked) << "movement compiles nothing";
    for (int i = 0; i < 20000 && planOf("rendering 1 'green'").empty(); ++i)
    {
        draw();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(leftOut(), "|green" + Reason + "|");
    const double after = count("mix.programs.started");
    draw(40);
    EXPECT_EQ(count("mix.programs.started"), after) << "and then no more";
    capture.takeWarnings();
}

TEST(MixSharesTest, sharesAreMeanWeightsBySize)
{
    const KeyPoints points({{0, 0, 0}});
    const MixWeights weights({{0, 0, 1, 1}, {1, 1, 100, 100}});
    MixPart near, far;
    near.box = MixBox::from({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    near.size = 3.0;
    far.box = MixBox::from({9, 0, 0}, {10, 1, 1});
    far.size = 1.0;
    EXPECT_EQ(sharesOf(points, weights, {near, far}), (std::vector<double>{0.75, 0.25}));
    // The ball of radius 1 is pi / 6 of the cube around it.
    MixPart cube;
    cube.box = MixBox::from({-1, -1, -1}, {1, 1, 1});
    EXPECT_NEAR(sharesOf(points, weights, {cube})[0], 3.14159265 / 6.0, 0.02); // 12 places an axis
    MixPart unbounded = near;
    unbounded.box.center.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(sharesOf(points, weights, {far, unbounded}), (std::vector<double>{0.0, 1.0}));
    EXPECT_EQ(sharesOf(points, weights, {unbounded}), (std::vector<double>{1.0, 1.0}));
}
