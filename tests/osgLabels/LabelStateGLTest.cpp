// SPDX-License-Identifier: MIT
// What others have set in OpenGL neither spoils labels nor is spoiled by them.
#include "LabelPictures.h"

#include <osgLabels/BufferTexture.h>
#include <osgLabels/LabelBuffers.h>

#include <support/NotifyCapture.h>

#include <osg/GLExtensions>

#include <numeric>

using namespace labelScene;
using osgLabels::BufferTexture;

namespace
{

constexpr GLenum sampleMask = 0x8E51, unpackBuffer = 0x88EC, unpackBufferBinding = 0x88EF;

class LabelState : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(viewer()); }

    support::NotifyCapture _notify;
};

/// Calls OpenGL where it is drawn.
class Call : public osg::Drawable
{
public:
    explicit Call(std::function<void(osg::State&)> f, int bin) : _f(std::move(f))
    {
        setUseDisplayList(false);
        setCullingActive(false);
        getOrCreateStateSet()->setRenderBinDetails(bin, "RenderBin");
    }
    void drawImplementation(osg::RenderInfo& renderInfo) const override
    {
        _f(*renderInfo.getState());
    }

private:
    const std::function<void(osg::State&)> _f;
};

osg::ref_ptr<osg::Geode> board(const std::string& name)
{
    return named(name, rectangle({-1, 0, -0.5f}, {2, 0, 0}, {0, 0, 1.0f}, {0.9f, 0.8f, 0.7f, 1}));
}

/// Leaves all that uploads depend on in a state that no upload wants.
void spoilUnpackState()
{
    glPixelStorei(GL_UNPACK_SWAP_BYTES, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 1500);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
}

void mendUnpackState()
{
    for (GLenum name :
         {GL_UNPACK_SWAP_BYTES, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
        glPixelStorei(name, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

} // namespace

TEST_F(LabelState, pagesAreUploadedWhateverTheUnpackStateIs)
{
    osg::GraphicsContext& context = *viewer().getViewer().getCamera()->getGraphicsContext();
    context.makeCurrent();
    osg::State& state = *context.getState();
    const auto* gl = state.get<osg::GLExtensions>();
    std::vector<std::uint32_t> words(3000); // a piece of three rows
    std::iota(words.begin(), words.end(), 0x01020304u);
    osg::ref_ptr<BufferTexture> texture = new BufferTexture(state.getContextID(), 1, true);
    GLuint buffer = 0;
    gl->glGenBuffers(1, &buffer);
    gl->glBindBuffer(unpackBuffer, buffer);
    gl->glBufferData(unpackBuffer, 64, nullptr, GL_STATIC_DRAW);
    spoilUnpackState();
    texture->resize(state, words.size() * 4);
    texture->write(state, 0, words.data(), words.size() * 4);
    GLint rowLength = 0, bound = 0;
    glGetIntegerv(GL_UNPACK_ROW_LENGTH, &rowLength);
    glGetIntegerv(unpackBufferBinding, &bound);
    EXPECT_EQ(rowLength, 1500) << "the state of others stays";
    EXPECT_EQ(GLuint(bound), buffer);
    mendUnpackState();
    gl->glBindBuffer(unpackBuffer, 0);
    gl->glDeleteBuffers(1, &buffer);
    std::vector<std::uint32_t> read(std::size_t(BufferTexture::PageSize) * 3);
    state.setActiveTextureUnit(0);
    texture->apply(state);
    glGetTexImage(texture->getTextureTarget(), 0, GL_RED_INTEGER_EXT, GL_UNSIGNED_INT, read.data());
    read.resize(words.size());
    EXPECT_EQ(read, words);
    EXPECT_NO_GL_ERRORS();
    state.haveAppliedTextureAttribute(0, texture);
    texture->releaseGLObjects(&state);
}

TEST_F(LabelState, whatAFrameDrawsWithOutlivesARelease)
{
    osg::GraphicsContext& context = *viewer().getViewer().getCamera()->getGraphicsContext();
    context.makeCurrent();
    const auto table = std::make_shared<osgLabels::LabelTable>();
    table->setCodes(1, {1, 2, 3});
    osgLabels::LabelBuffers buffers(table);
    const auto stateSet = buffers.update(*context.getState());
    buffers.releaseGLObjects(nullptr); // as another thread may do between
    EXPECT_EQ(stateSet->referenceCount(), 1);
    EXPECT_TRUE(stateSet->getUniform("osgLabels_layout"));
    EXPECT_TRUE(buffers.update(*context.getState())->getUniform("osgLabels_layout"));
    buffers.releaseGLObjects(context.getState());
    EXPECT_NO_GL_ERRORS();
}

TEST_F(LabelState, glyphsAreUploadedWhateverTheUnpackStateIs)
{
    const Picture expected = render(*labelled(board("SPOIL")));
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(new Call([](osg::State&) { spoilUnpackState(); }, -100));
    root->addChild(labelled(board("SPOIL")));
    root->addChild(new Call([](osg::State&) { mendUnpackState(); }, 100));
    EXPECT_TRUE(areEqual(render(*root), expected, "labelState.unpack"));
}

TEST_F(LabelState, theSampleMaskIsAsItWas)
{
    support::HeadlessSettings settings{Width, Height};
    settings.samples = 4;
    support::HeadlessViewer smooth(settings);
    OSGKITS_NEED_GL(smooth);
    bool isOn = false;
    GLint mask = 0;
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(new Call(
        [](osg::State& state)
        {
            glEnable(sampleMask);
            state.get<osg::GLExtensions>()->glSampleMaski(0, 0x5);
        },
        -100));
    const auto scene = labelled(board("MASK"));
    root->addChild(scene);
    root->addChild(new Call(
        [&](osg::State& state)
        {
            void(GL_APIENTRY * get)(GLenum, GLuint, GLint*) = nullptr;
            osg::setGLExtensionFuncPtr(get, "glGetIntegeri_v");
            isOn = glIsEnabled(sampleMask);
            get(0x8E52, 0, &mask);
            state.get<osg::GLExtensions>()->glSampleMaski(0, ~0u);
            glDisable(sampleMask);
        },
        100));
    ASSERT_TRUE(smooth.render(root, fromFront(), Width, Height, 2));
    EXPECT_EQ(countOf(*scene, "labels.drawables"), 1.0);
    EXPECT_TRUE(isOn);
    EXPECT_EQ(mask, 0x5);
}

TEST_F(LabelState, whatHasWipedTheViewBetweenTwoBinsIsNotDrawnOver)
{
    // As a camera in the scene does. What the first bin had drawn into the labels' targets still
    // lies there when the second one comes.
    const auto wiped = [](bool hasFirst)
    {
        const osg::ref_ptr<osg::Group> objects = unlit(), all = new osg::Group;
        if (hasFirst)
            objects->addChild(board("First"));
        const auto second = named(
            "Second", rectangle({-0.3f, -0.5f, -0.2f}, {0.6f, 0, 0}, {0, 0, 0.4f}, {1, 1, 0, 1}));
        second->getOrCreateStateSet()->setRenderBinDetails(10, "RenderBin");
        objects->addChild(second);
        all->addChild(labelled(objects));
        all->addChild(new Call(
            [](osg::State&)
            {
                glDepthMask(GL_TRUE);
                glClearColor(0.0f, 0.5f, 0.0f, 1.0f);
                glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
            },
            5));
        return render(*all);
    };
    EXPECT_TRUE(areEqual(wiped(true), wiped(false), "labelState.wiped"));
}
