// SPDX-License-Identifier: MIT
#include <osgMultiRender/ProgramWrap.h>

#include <support/HeadlessViewer.h>

#include <osg/Program>

TEST(ProgramWrapGLTest, aProgramThatWasNeverAppliedHasNoErrors)
{
    support::HeadlessViewer viewer({16, 16});
    OSGKITS_NEED_GL(viewer);
    osg::GraphicsContext& context = *viewer.getViewer().getCamera()->getGraphicsContext();
    context.makeCurrent();
    osg::ref_ptr<osg::Program> program = new osg::Program;
    EXPECT_EQ(osgMultiRender::errorsOf(*program, *context.getState()), "");
    program->addShader(new osg::Shader(osg::Shader::VERTEX, "#version 330\nvoid main() {}\n"));
    EXPECT_EQ(osgMultiRender::errorsOf(*program, *context.getState()), "");
}
