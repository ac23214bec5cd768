// SPDX-License-Identifier: MIT
// What a merged program shows where weights and options are out of the ordinary.
#include "osgMultiRender/MergeCases.h"
#include "osgMultiRender/MergePicture.h"

#include <osgMultiRender/Import.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace osgMultiRender;

namespace
{

const std::size_t Middle = 32 * MergePicture::Size + 32;

std::string always(const std::string& first, const std::string& second)
{
    return "float osgmr_weight(int rendering) { return rendering == 0 ? " + first + " : " + second +
           "; }\n";
}

Rendering colored(const char* name, const std::string& color, const std::string& before = "")
{
    return mergeCase(name, "varying vec2 uv;\nvoid main() { " + before + " gl_FragColor = vec4(" +
                               color + ", 0.0, 1.0); }");
}

class MergeOptionsGLTest : public PlainGLTest
{
protected:
    /// The colour in the middle of the picture.
    std::vector<float> draw(const std::vector<Rendering>& renderings)
    {
        std::vector<MergeEntry> entries;
        for (const Rendering& one : renderings)
        {
            entries.push_back({&one, 1.0});
        }
        MergeStudio studio;
        const MergePicture picture = studio.drawMerged(mergeRenderings(entries, _options), entries);
        EXPECT_TRUE(picture.ok) << picture.log;
        if (!picture.ok)
        {
            return std::vector<float>(4);
        }
        const auto at = picture.colors.begin() + std::ptrdiff_t(Middle * 4);
        return std::vector<float>(at, at + 4);
    }

    static void expectColor(const std::vector<float>& color, float r, float g, float a)
    {
        EXPECT_NEAR(color[0], r, 1e-4);
        EXPECT_NEAR(color[1], g, 1e-4);
        EXPECT_NEAR(color[3], a, 1e-4);
    }

    MergeOptions _options;
    const Rendering _red = colored("red", "0.75, 0.0");
    const Rendering _green = colored("green", "0.0, 0.5");
    const Rendering _hole = colored("hole", "1.0, 1.0", "discard;");
};

TEST_F(MergeOptionsGLTest, weightsAreSummedAndClamped)
{
    _options.weights = always("0.5", "0.25");
    expectColor(draw({_red, _green}), 0.375f, 0.125f, 0.75f);
    _options.weights = always("2.0", "1.0");
    expectColor(draw({_red, _green}), 1.0f, 0.5f, 1.0f);
}

TEST_F(MergeOptionsGLTest, sumsAboveOneAreDividedWhereAskedFor)
{
    _options.normalize = true;
    _options.weights = always("2.0", "2.0");
    expectColor(draw({_red, _green}), 0.375f, 0.25f, 1.0f);
    _options.weights = always("0.5", "0.25");
    expectColor(draw({_red, _green}), 0.375f, 0.125f, 0.75f);
}

TEST_F(MergeOptionsGLTest, withoutWeightTheOptionDecidesWhatIsSeen)
{
    _options.weights = always("0.0", "0.0");
    expectColor(draw({_red, _green}), 0.0f, 0.0f, MergePicture::Empty);
    _options.outside = MergeOutside::Transparent;
    expectColor(draw({_red, _green}), 0.0f, 0.0f, 0.0f);
    _options.outside = MergeOutside::Base;
    expectColor(draw({_red, _green}), 0.75f, 0.0f, 1.0f);
    _options.base = 1;
    expectColor(draw({_red, _green}), 0.0f, 0.5f, 1.0f);
    expectColor(draw({_red, _hole}), 0.0f, 0.0f, MergePicture::Empty);
}

TEST_F(MergeOptionsGLTest, negativeAndUndefinedWeightsAreNone)
{
    _options.weights = "uniform float osgmr_none;\n" + always("-1.0", "0.5");
    expectColor(draw({_red, _green}), 0.0f, 0.25f, 0.5f);
    // The uniform is 0 where nothing sets it.
    _options.weights = "uniform float osgmr_none;\n" + always("osgmr_none / osgmr_none", "0.5");
    expectColor(draw({_red, _green}), 0.0f, 0.25f, 0.5f);
}

TEST_F(MergeOptionsGLTest, aDiscardTakesItsWeightOutInEveryMode)
{
    _options.weights = always("0.5", "0.5");
    for (MergeOutside outside :
         {MergeOutside::Background, MergeOutside::Transparent, MergeOutside::Base})
    {
        _options.outside = outside;
        expectColor(draw({_red, _hole}), 0.375f, 0.0f, 0.5f);
        expectColor(draw({_hole, _red}), 0.375f, 0.0f, 0.5f);
        expectColor(draw({_hole, _hole}), 0.0f, 0.0f, MergePicture::Empty);
    }
}

TEST_F(MergeOptionsGLTest, renderingsWithoutWeightAreNotEvaluated)
{
    // What is not a number would not leave a sum that it is in.
    const Rendering nan = colored("nan", "sqrt(-1.0 - uv.x), 0.0");
    _options.weights = always("0.0", "1.0");
    expectColor(draw({nan, _green}), 0.0f, 0.5f, 1.0f);
    _options.skipZeroWeights = false;
    expectColor(draw({nan, _green}), 0.0f, 0.5f, 1.0f);
}

TEST_F(MergeOptionsGLTest, twoSidedColorsFollowTheRenderingsState)
{
    Rendering sides = mergeCase(
        "sides", "void main() { gl_FragColor = gl_Color; }",
        "void main() { gl_FrontColor = vec4(1.0, 0.0, 0.0, 1.0); gl_BackColor = vec4(0.0, 1.0, "
        "0.0, 1.0); gl_Position = ftransform() * vec4(-1.0, 1.0, 1.0, 1.0); }");
    std::vector<float> color = draw({sides});
    sides.state.twoSided = true;
    std::vector<float> other = draw({sides});
    // The mirrored sheet is seen from one side only: with the state the back's colour shows.
    EXPECT_NEAR(color[0], 1.0f, 1e-4);
    EXPECT_NEAR(std::abs(other[0] - other[1]), 1.0f, 1e-4);
    sides.shaders[0].text = "void main() { gl_FrontColor = vec4(1.0, 0.0, 0.0, 1.0); gl_BackColor "
                            "= vec4(0.0, 1.0, 0.0, 1.0); gl_Position = ftransform(); }";
    EXPECT_NEAR(draw({sides})[0] + other[0], 1.0f, 1e-4);
}

TEST_F(MergeOptionsGLTest, uniformBlocksKeepTheirMembersAndGetBindingsOfTheirOwn)
{
    const std::string text =
        "#version 430 compatibility\nlayout(std140, binding = 2) uniform Colors { vec4 tint; };\n"
        "layout(std140) uniform Named { vec4 tint; } named;\nout vec4 c;\n"
        "void main() { c = tint + named.tint; }";
    const Rendering a = mergeCase("a", text), b = mergeCase("b", text);
    const Merged merged = mergeRenderings({{&a, 1.0}, {&b, 1.0}});
    PlainProgram program;
    EXPECT_TRUE(program.add(GL_VERTEX_SHADER, merged.vertex)) << merged.explain(program.log());
    EXPECT_TRUE(program.add(GL_FRAGMENT_SHADER, merged.fragment)) << merged.explain(program.log());
    EXPECT_TRUE(program.link()) << merged.explain(program.log());
    std::set<int> bindings;
    for (std::size_t i = 0; i < 2; ++i)
    {
        for (const char* name : {"Colors", "Named"})
        {
            const MergedUniform* block = merged.findUniform(i, name);
            ASSERT_TRUE(block);
            EXPECT_EQ(block->type, "block");
            EXPECT_NE(glGetUniformBlockIndex(program.id(), block->merged.c_str()),
                      GL_INVALID_INDEX);
            EXPECT_TRUE(bindings.insert(block->binding).second);
        }
    }
    EXPECT_EQ(merged.findUniform(0, "Colors")->ownBinding, 2);
    EXPECT_EQ(merged.findUniform(0, "Colors")->binding, 2);
}

TEST_F(MergeOptionsGLTest, imageShadersAreDrawnAndMerged)
{
    const Rendering image = importShadertoy(
        "float wave(vec2 at) { return 0.5 + 0.5 * sin(at.x * 9.0 + iTime); }\n"
        "void mainImage(out vec4 color, in vec2 at)\n{\n    vec2 uv = at / iResolution.xy;\n"
        "    color = vec4(uv * 0.5, wave(uv), 1.0) * texture(iChannel0, uv);\n}\n",
        "image.frag");
    MergeStudio studio;
    const std::vector<MergeEntry> entries = {{&image, 1.0}, {&_red, 1.0}};
    const std::vector<MergePicture> alone = {studio.drawAlone(image), studio.drawAlone(_red)};
    ASSERT_TRUE(alone[0].ok) << alone[0].log;
    _options.weights = MergeStudio::weights(2);
    const MergePicture picture = studio.drawMerged(mergeRenderings(entries, _options), entries);
    ASSERT_TRUE(picture.ok) << picture.log;
    EXPECT_LE(MergeStudio::compare(picture, alone).worst, 1.0 / 255.0);
}

TEST_F(MergeOptionsGLTest, errorsNameTheImportsOwnFileAndLine)
{
    const Rendering bad =
        mergeCase("bad", "#define X 1.0\n/* two\nlines */\nvoid main()\n{\n    gl_FragColor = "
                         "vec4(X,\n        undeclaredName,\n        0.0, 1.0);\n}\n");
    const Merged merged = mergeRenderings({{&mergePartner(), 1.0}, {&bad, 1.0}});
    PlainProgram program;
    EXPECT_FALSE(program.add(GL_FRAGMENT_SHADER, merged.fragment));
    EXPECT_NE(merged.explain(program.log()).find("bad.frag:7: error: `undeclaredName' undeclared"),
              std::string::npos)
        << merged.explain(program.log());
}

} // namespace
