// SPDX-License-Identifier: MIT
// What a model looks like without labels is the oracle: labels that can't be seen leave its picture
// as it is, though each surface goes through the targets of the first pass or evaluates its label.
#include "FeatureScenes.h"
#include "LabelPictures.h"

#include <support/InventorModels.h>
#include <support/NotifyCapture.h>

#include <osg/Program>
#include <osg/Shader>
#include <osgUtil/Optimizer>

#include <cstdlib>

using namespace labelScene;

namespace
{

// One scene of five in the short run, all in the long.
const bool Full = std::getenv("OSGKITS_LONG") != nullptr;
constexpr int SmallWidth = 160, SmallHeight = 120;

/// With the viewer's headlight, which models without lights need.
support::HeadlessViewer& litViewer()
{
    static support::HeadlessViewer theViewer({SmallWidth, SmallHeight});
    return theViewer;
}

void expectOwnLook(osg::Node* model, const support::CameraSpec& camera, const std::string& name,
                   bool beyond = false)
{
    osg::ref_ptr<osg::Group> object = new osg::Group;
    object->setName("Tag 42");
    object->addChild(model);
    const auto scene = labelled(object, Invisible);
    support::HeadlessViewer& viewer = litViewer();
    viewer.getViewer().getCamera()->getGraphicsContext()->makeCurrent();
    viewer.setFailOnGLErrors(false);
    // The labelled one first: OSG frees the images of textures when it has drawn them.
    const Picture actual = viewer.render(scene, camera, SmallWidth, SmallHeight, 2);
    const std::size_t errors = viewer.getGLErrors().size();
    EXPECT_EQ(countOf(*scene, "variants.failed"), 0.0) << name;
    if (!beyond)
    {
        EXPECT_GT(countOf(*scene, "labels.drawables"), 0.0) << name << ": " << decisionOf(*scene);
        EXPECT_EQ(countOf(*scene, "leaves.fixedFunction"), 0.0) << name;
    }
    const Picture expected = viewer.render(object, camera, SmallWidth, SmallHeight, 2);
    // OSG itself raises some, for instance for lights above 7; none may come on top.
    EXPECT_LE(errors, viewer.getGLErrors().size()) << name;
    keep(actual, "labelLook." + name);
    // As areAlike(), but crossing lines hide each other by depths that the targets hold as floats,
    // where the window has 24 bits.
    EXPECT_TRUE(
        (support::CompareImage{2.0 / 255.0, 0.002, 1.0}(actual, expected, "labelLook." + name)));
}

/// Each eighth of Debian's models, or all.
std::vector<std::string> models()
{
    const std::vector<std::string> all = support::inventorModels();
    std::vector<std::string> some;
    for (std::size_t i = 0; i < all.size(); i += Full ? 1 : 8)
        some.push_back(all[i]);
    return some;
}

class FeatureFamily : public testing::TestWithParam<std::string>
{
};

class InventorModel : public testing::TestWithParam<std::string>
{
};

} // namespace

TEST_P(FeatureFamily, keepsItsLookUnderLabels)
{
    OSGKITS_NEED_GL(litViewer());
    const support::CameraSpec camera = {featureView(),
                                        featureProjection(double(SmallWidth) / SmallHeight)};
    std::size_t number = 0;
    for (const FeatureScene& scene : featureScenes())
    {
        if (scene.family != GetParam() || (!Full && number++ % 5 != 0))
            continue;
        SCOPED_TRACE(scene.name);
        support::NotifyCapture notify;
        // Points have no label.
        const bool beyond = scene.beyond || scene.name.rfind("points", 0) == 0;
        expectOwnLook(scene.create(), camera, scene.family + "." + scene.name, beyond);
    }
}

TEST_P(InventorModel, keepsItsLookUnderLabels)
{
    OSGKITS_NEED_GL(litViewer());
    const osg::ref_ptr<osg::Node> model = support::readInventorModel(GetParam());
    ASSERT_TRUE(model.valid()) << GetParam() << " cannot be read";
    support::NotifyCapture notify;
    expectOwnLook(model, support::CameraSpec::overview(*model, double(SmallWidth) / SmallHeight),
                  support::inventorCaseName(GetParam()));
}

TEST(LabelLook, anOptimizedModelKeepsItsLookAndItsNames)
{
    OSGKITS_NEED_GL(litViewer());
    ASSERT_FALSE(support::inventorModels().empty());
    const osg::ref_ptr<osg::Node> model =
        support::readInventorModel(support::inventorModels().front());
    ASSERT_TRUE(model);
    support::NotifyCapture notify;
    const auto camera = support::CameraSpec::overview(*model, double(SmallWidth) / SmallHeight);
    osg::ref_ptr<osg::Group> object = new osg::Group;
    object->setName("Tag 42");
    object->addChild(model);
    const Picture expected = litViewer().render(object, camera, SmallWidth, SmallHeight, 2);
    const auto scene = labelled(object, Invisible);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(scene);
    osgUtil::Optimizer().optimize(root);
    const Picture actual = litViewer().render(root, camera, SmallWidth, SmallHeight, 2);
    EXPECT_TRUE(areAlike(actual, expected, "labelLook.optimized"));
    EXPECT_GT(countOf(*scene, "labels.drawables"), 0.0) << decisionOf(*scene);
}

TEST(LabelLook, ownProgramsKeepTheirLook)
{
    OSGKITS_NEED_GL(litViewer());
    support::NotifyCapture notify;
    const char* const vertex =
        "varying vec3 where;\n"
        "void main() { where = gl_Vertex.xyz; gl_Position = ftransform(); }\n";
    const char* const fragments[] = {
        "varying vec3 where;\n"
        "void main() { gl_FragColor = vec4(fract(where * 3.0), 1.0); }\n",
        // Leaves early, and writes depth.
        "varying vec3 where;\n"
        "void main()\n"
        "{\n"
        "    gl_FragDepth = gl_FragCoord.z;\n"
        "    if (where.x < 0.0) { gl_FragColor = vec4(1.0, 0.5, 0.0, 1.0); return; }\n"
        "    if (fract(where.z * 4.0) < 0.5) discard;\n"
        "    gl_FragColor = vec4(0.0, 0.5, 1.0, 1.0);\n"
        "}\n",
        "#version 330 compatibility\n"
        "in vec3 where;\n"
        "out vec4 painted;\n"
        "void main() { painted = vec4(abs(where), 1.0); }\n"};
    for (int i = 0; i < 3; ++i)
    {
        const auto geode =
            named("Tag 42", rectangle({-1, 0, -0.8f}, {2, 0.5f, 0}, {0, 0, 1.6f}, {1, 1, 1, 1}));
        osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(
            new osg::Shader(osg::Shader::VERTEX, i == 2 ? "#version 330 compatibility\n"
                                                          "out vec3 where;\n"
                                                          "void main() { where = gl_Vertex.xyz; "
                                                          "gl_Position = ftransform(); }\n"
                                                        : vertex));
        program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragments[i]));
        geode->getOrCreateStateSet()->setAttribute(program);
        expectOwnLook(geode, fromFront(), "ownProgram" + std::to_string(i));
    }
}

TEST(LabelLook, vertexAttributesOfModelsDoNotChangeItsLabel)
{
    // Tangents often lie in attribute 6, which says which object a drawable is.
    OSGKITS_NEED_GL(litViewer());
    support::NotifyCapture notify;
    const auto build = [](bool hasTangents)
    {
        const auto quad = rectangle({-1, 0, -0.4f}, {2, 0, 0}, {0, 0, 0.8f}, {1, 1, 1, 1});
        osg::ref_ptr<osg::Vec3Array> tangents = new osg::Vec3Array;
        tangents->assign(quad->getVertexArray()->getNumElements(), osg::Vec3(1, 0, 0));
        if (hasTangents)
            quad->setVertexAttribArray(6, tangents, osg::Array::BIND_PER_VERTEX);
        const auto geode = named("Tag 42", quad);
        geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        return labelled(geode, Plain);
    };
    const auto with = build(true), without = build(false);
    const Picture actual = litViewer().render(with, fromFront(), SmallWidth, SmallHeight, 2);
    const Picture expected = litViewer().render(without, fromFront(), SmallWidth, SmallHeight, 2);
    EXPECT_TRUE(areEqual(actual, expected, "labelLook.attribute6"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, FeatureFamily, testing::ValuesIn(featureFamilies()),
                         [](const auto& family) { return family.param; });
INSTANTIATE_TEST_SUITE_P(Models, InventorModel, testing::ValuesIn(models()),
                         [](const auto& model) { return support::inventorCaseName(model.param); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(InventorModel);
