// SPDX-License-Identifier: MIT
// OpenGL's fixed function as the oracle: what LitScene draws with lighting=vertex is the picture
// that plain OSG draws.
#include "FeatureScenes.h"

#include <osgShadowVolume/LitScene.h>

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <cstdlib>

using osgShadowVolume::LitScene;

namespace
{

// Small pictures in the short run, osgviewer-like ones in the long.
const bool Full = std::getenv("OSGKITS_LONG") != nullptr;
const int Width = Full ? 640 : 160, Height = Full ? 480 : 120;

support::HeadlessViewer& theViewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    return viewer;
}

/// Few pixels may differ by any amount: an edge, a texel or an alpha test that falls the other way
/// by the last bit of a coordinate.
constexpr support::CompareImage Oracle = {2.0 / 255.0, 0.001, 1.0};

double count(const osgMultiRender::Plan& plan, const std::string& name)
{
    const auto found = plan.counts.find(name);
    return found == plan.counts.end() ? 0.0 : found->second;
}

/// OSG draws with the fixed function, silently, where a program cannot be linked: then the
/// comparison would hold for nothing.
void expectPrograms(const LitScene& lit, const std::string& name, bool beyond)
{
    const std::vector<osgMultiRender::Plan> plans = lit.getPlans();
    ASSERT_EQ(plans.size(), 1u) << name;
    const osgMultiRender::Plan& plan = plans.front();
    EXPECT_GT(count(plan, "variants") + count(plan, "leaves.fixedFunction"), 0.0) << name;
    EXPECT_EQ(count(plan, "variants.failed"), 0.0) << name << "\n" << toString(plan);
    if (beyond)
        return;
    EXPECT_GT(count(plan, "leaves.program"), 0.0) << name << "\n" << toString(plan);
    EXPECT_EQ(count(plan, "leaves.fixedFunction"), 0.0) << name << "\n" << toString(plan);
}

void expectFixedFunctionPicture(osg::Node* node, const support::CameraSpec& camera,
                                const std::string& name, bool beyond = false)
{
    osg::ref_ptr<LitScene> lit = new LitScene;
    lit->setLighting(LitScene::Lighting::VERTEX);
    lit->addChild(node);
    // the lit one first: OSG frees the images of textures when it has drawn them
    theViewer().setFailOnGLErrors(false);
    const auto actual = theViewer().render(lit, camera, Width, Height, 2);
    const std::vector<std::string> errors = theViewer().getGLErrors();
    expectPrograms(*lit, name, beyond);
    const auto expected = theViewer().render(node, camera, Width, Height, 2);
    // OSG itself raises some, for instance for lights above 7; none may come on top
    EXPECT_LE(errors.size(), theViewer().getGLErrors().size()) << name;
    EXPECT_TRUE(Oracle(actual, expected, "fixedFunction." + name));
}

class FeatureFamily : public testing::TestWithParam<std::string>
{
};

class InventorModel : public testing::TestWithParam<std::string>
{
};

} // namespace

TEST_P(FeatureFamily, hasThePictureOfTheFixedFunction)
{
    OSGKITS_NEED_GL(theViewer());
    const support::CameraSpec camera = {featureView(), featureProjection(double(Width) / Height)};
    for (const FeatureScene& scene : featureScenes())
    {
        if (scene.family != GetParam())
            continue;
        SCOPED_TRACE(scene.name);
        support::NotifyCapture notify;
        expectFixedFunctionPicture(scene.create(), camera, scene.family + "." + scene.name,
                                   scene.beyond);
    }
}

TEST_P(InventorModel, hasThePictureOfTheFixedFunction)
{
    OSGKITS_NEED_GL(theViewer());
    const osg::ref_ptr<osg::Node> model = support::readInventorModel(GetParam());
    ASSERT_TRUE(model.valid()) << GetParam() << " cannot be read";
    support::NotifyCapture notify;
    const auto camera = support::CameraSpec::overview(*model, double(Width) / Height);
    expectFixedFunctionPicture(model, camera, support::inventorCaseName(GetParam()));
}

TEST(InventorModels, areInstalled)
{
    EXPECT_GE(support::inventorModels().size(), 90u) << "install Debian's inventor-data";
}

INSTANTIATE_TEST_SUITE_P(Scenes, FeatureFamily, testing::ValuesIn(featureFamilies()),
                         [](const auto& family) { return family.param; });
INSTANTIATE_TEST_SUITE_P(Models, InventorModel, testing::ValuesIn(support::inventorModels()),
                         [](const auto& model) { return support::inventorCaseName(model.param); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(InventorModel);
