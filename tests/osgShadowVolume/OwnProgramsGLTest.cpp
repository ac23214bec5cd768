// SPDX-License-Identifier: MIT
#include "LitPictures.h"

#include <support/NotifyCapture.h>

#include <osg/Program>

using lit::ball;
using lit::Lighting;

namespace
{

class OwnPrograms : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(lit::viewer()); }
    support::NotifyCapture _notify;
};

} // namespace

TEST_F(OwnPrograms, programsWithErrorsShowTheFixedFunctionLookAndNameTheLine)
{
    osg::ref_ptr<osg::Shader> fragment = new osg::Shader(
        osg::Shader::FRAGMENT, "void main()\n{\n    gl_FragColor = vec4(nonsense);\n}\n");
    fragment->setName("broken.frag");
    fragment->setFileName("broken.frag");
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("broken");
    program->addShader(fragment);
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::VERTEX);
    osg::ref_ptr<osg::Geode> geode = ball({0, 0, 0});
    kit->addChild(geode);
    const osg::ref_ptr<osg::Image> expected = lit::picture(*kit);
    geode->getOrCreateStateSet()->setAttributeAndModes(program);
    const osg::ref_ptr<osg::Image> first = lit::picture(*kit, 1);
    bool named = false;
    for (const std::string& line : _notify.takeWarnings())
        named = named || line.find("broken.frag:3:") != std::string::npos;
    EXPECT_TRUE(named) << "no line names file and line of the error";
    EXPECT_EQ(kit->getPlans().back().counts["variants.failed"], 1.0) << "in the first frame";
    EXPECT_TRUE(support::CompareImage()(lit::picture(*kit, 2), expected, "extreme.brokenProgram"));
    EXPECT_EQ(kit->getPlans().back().counts["variants.failed"], 1.0) << "in a later frame";
    EXPECT_NE(lit::entryOf(kit->getPlans().back(), "program 'broken'"), "");
    for (const std::string& line : _notify.takeWarnings())
        ADD_FAILURE() << "said again: " << line;
}

TEST_F(OwnPrograms, aProtectedProgramDrawsAsItselfAndSpoilsNoOther)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT,
                        "void main()\n{\n    gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);\n}\n"));
    const auto build = [program](osg::Group& kit)
    {
        osg::ref_ptr<osg::Geode> own = ball({-1, 0, 0}), plain = ball({1, 0, 0});
        own->getOrCreateStateSet()->setAttributeAndModes(
            program, osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
        kit.addChild(own);
        kit.addChild(plain);
        return osg::ref_ptr<osg::Node>(&kit);
    };
    osg::ref_ptr<osgShadowVolume::LitScene> kit = lit::litScene(Lighting::VERTEX);
    osg::ref_ptr<osg::Group> stock = new osg::Group;
    build(*kit);
    build(*stock);
    EXPECT_TRUE(support::CompareImage()(lit::picture(*kit, 3), lit::picture(*stock, 3),
                                        "extreme.protectedProgram"));
    const osgMultiRender::Plan plan = kit->getPlans().back();
    EXPECT_EQ(plan.counts.at("variants.failed"), 0.0);
    EXPECT_EQ(plan.counts.at("leaves.fixedFunction"), 1.0);
    EXPECT_NE(lit::entryOf(plan, "fixed function"), "");
}
