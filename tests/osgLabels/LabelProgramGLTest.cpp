// SPDX-License-Identifier: MIT
// Programs of the model's own that do not go together with labels.
#include "LabelPictures.h"

#include <support/NotifyCapture.h>

#include <osg/Program>

#include <algorithm>

using namespace labelScene;

namespace
{

class LabelProgram : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }
};

/// Links alone; with labels, whose uniform of that name is no vector, it does not.
const char clashing[] = R"(#version 330 compatibility
uniform vec4 osgLabels_index;
void main() { gl_FragColor = vec4(0.2, 0.6, 0.3, 1.0) + 0.0 * osgLabels_index; }
)";

const char vertex[] = R"(#version 330 compatibility
void main() { gl_Position = ftransform(); }
)";

osg::ref_ptr<osg::Geode> board(const std::string& name, float left)
{
    return named(name,
                 rectangle({left, 0, -0.5f}, {1.1f, 0, 0}, {0, 0, 1.0f}, {0.9f, 0.8f, 0.7f, 1}));
}

} // namespace

TEST_F(LabelProgram, oneThatDoesNotLinkWithLabelsKeepsItsLookWithoutThem)
{
    const auto own = board("CLASH", -1.2f);
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setName("paint");
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, clashing));
    own->getOrCreateStateSet()->setAttributeAndModes(program);
    osg::ref_ptr<osg::Group> model = new osg::Group;
    model->addChild(own);
    model->addChild(board("OTHER", 0.1f));
    const Picture look = render(*model);
    const auto scene = labelled(model, Plain);
    Picture first, second;
    {
        support::NotifyCapture capture;
        first = render(*scene, fromFront(), Width, Height, 1);
        second = render(*scene, fromFront(), Width, Height, 1);
        const auto lines = capture.takeWarnings();
        EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                                [](const std::string& line)
                                { return line.find("program 'paint' does not") != line.npos; }),
                  1)
            << "said once";
    }
    ASSERT_TRUE(first && second && look);
    keep(first, "labelProgram.clash");
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width / 2; ++x)
            ASSERT_EQ(first->getColor(x, y), look->getColor(x, y)) << x << " " << y;
    EXPECT_GT(changedShare(*first, *look), 0.01) << "the other one has its label";
    EXPECT_TRUE(areEqual(second, first, "labelProgram.again"));
    const auto plan = scene->getPlans().front();
    EXPECT_TRUE(std::any_of(plan.entries.begin(), plan.entries.end(),
                            [](const osgMultiRender::PlanEntry& entry)
                            { return entry.subject == "output of program 'paint'"; }))
        << toString(plan);
}
