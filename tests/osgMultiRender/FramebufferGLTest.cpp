// SPDX-License-Identifier: MIT
#include <osgMultiRender/Framebuffer.h>
#include <support/HeadlessViewer.h>

#include <osg/Drawable>
#include <osg/Geode>

#include <gtest/gtest.h>

namespace
{

/// Visits another place while it is drawn, and notes what it finds before and after.
class Visitor : public osg::Drawable
{
public:
    Visitor() { setSupportsDisplayList(false); }
    osg::BoundingBox computeBoundingBox() const override { return {-1, -1, -1, 1, 1, 1}; }
    void drawImplementation(osg::RenderInfo& info) const override
    {
        osg::State& state = *info.getState();
        before = state.getCurrentViewport();
        glGetIntegerv(GL_VIEWPORT, pixelsBefore);
        {
            const osgMultiRender::FramebufferVisit visit(state);
            const osg::ref_ptr<osg::Viewport> other = new osg::Viewport(1, 2, 3, 4);
            state.applyAttribute(other);
        }
        after = state.getCurrentViewport();
        glGetIntegerv(GL_VIEWPORT, pixelsAfter);
    }
    mutable const osg::Viewport* before = nullptr;
    mutable const osg::Viewport* after = nullptr;
    mutable GLint pixelsBefore[4] = {}, pixelsAfter[4] = {};
};

TEST(FramebufferGLTest, afterAVisitTheStateKnowsTheViewportOfBefore)
{
    support::HeadlessViewer viewer;
    OSGKITS_NEED_GL(viewer);
    const osg::ref_ptr<Visitor> visitor = new Visitor;
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(visitor);
    viewer.render(geode, support::CameraSpec::overview(*geode, 4.0 / 3.0), 320, 240);
    ASSERT_TRUE(visitor->before);
    EXPECT_EQ(visitor->after, visitor->before);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(visitor->pixelsAfter[i], visitor->pixelsBefore[i]);
}

} // namespace
