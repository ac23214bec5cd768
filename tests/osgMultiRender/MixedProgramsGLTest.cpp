// SPDX-License-Identifier: MIT
// When a MixedScene's programs are made, what they share, and what fails only together.
#include "osgMultiRender/MixedPictures.h"

#include <support/TemporaryFolder.h>

#include <osg/MatrixTransform>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <chrono>
#include <mutex>
#include <thread>

using namespace osgMultiRender;

namespace
{

class MixedProgramsGLTest : public MixedPictures
{
protected:
    static Rendering plain(const std::string& name, const std::string& color,
                           const std::string& declarations = "")
    {
        Rendering rendering;
        rendering.name = name;
        rendering.shaders.push_back(
            {GlslStage::Fragment,
             declarations + "void main()\n{\n    gl_FragColor = " + color + ";\n}\n",
             name + ".frag"});
        return rendering;
    }

    /// As many uniform blocks in the fragment stage: GL promises 12, Mesa has 15.
    static Rendering blocks(const std::string& name, int count)
    {
        std::string declarations = "#version 330 compatibility\n", sum = "vec4(0.5)";
        for (int i = 0; i < count; ++i)
        {
            const std::string number = std::to_string(i);
            declarations += "uniform Block" + number + " { vec4 " + name + number + "; };\n";
            sum += " + " + name + number;
        }
        return plain(name, sum, declarations);
    }

    void addThree()
    {
        add("phong", {0.0, 0.0, 1.0, 1.2});
        add("toon", {1.0, 1.2, 2.0, 3.0});
        add("gooch", {2.0, 3.0, Infinity, Infinity});
        setKeys({{-1.6, -1.0, 0.5}});
    }

    void drawUntil(const std::string& what, double least)
    {
        for (int i = 0; i < 20000 && count(what) < least; ++i)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            draw();
        }
        ASSERT_GE(count(what), least);
    }

    std::string planOf(const std::string& text) const
    {
        const std::vector<Plan> plans = _scene->getPlans();
        for (const PlanEntry& entry : plans.back().entries)
            if (entry.subject.find(text) != std::string::npos)
                return entry.reason;
        return "";
    }
};

/// Counts the reading of image files, and by which threads.
struct Reads : osgDB::ReadFileCallback
{
    osgDB::ReaderWriter::ReadResult readImage(const std::string& file,
                                              const osgDB::Options* options) override
    {
        {
            std::lock_guard<std::mutex> lock(mutex);
            threads.push_back(std::this_thread::get_id());
        }
        return osgDB::ReadFileCallback::readImage(file, options);
    }

    std::mutex mutex;
    std::vector<std::thread::id> threads;
};

} // namespace

TEST_F(MixedProgramsGLTest, texturesAreReadOnceForAllProgramsAndNeverWhereItIsDrawn)
{
    const support::TemporaryFolder folder;
    const std::string file = folder.file("leaf.png");
    ASSERT_TRUE(osgDB::writeImageFile(*makeSampleImage(16), file));
    Rendering rendering = plain("leaf", "texture2D(leaf, vec2(0.5))", "uniform sampler2D leaf;\n");
    RenderingTexture texture;
    texture.fileName = file;
    rendering.textures.push_back(texture);
    const osg::ref_ptr<Reads> reads = new Reads;
    osgDB::Registry::instance()->setReadFileCallback(reads);
    _scene->addRendering(rendering, {0.0, 0.0, 1.0, 1.2});
    _scene->addRendering(plain("red", "vec4(1.0, 0.0, 0.0, 1.0)"), {1.0, 1.2, 2.0, 3.0});
    _scene->addRendering(plain("blue", "vec4(0.0, 0.0, 1.0, 1.0)"), {2.0, 3.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    _scene->setSettleFrames(1);
    draw(4);
    // Where the key points are tells which pruned sets are wanted.
    for (int i = 0; i < 4; ++i)
    {
        setKeys({{-1.6 + i, -1.0, 0.5}});
        draw(6);
    }
    ASSERT_NO_FATAL_FAILURE(drawUntil("mix.programs.linked", 3.0));
    osgDB::Registry::instance()->setReadFileCallback(nullptr);
    EXPECT_EQ(reads->threads.size(), 1u);
    for (const std::thread::id thread : reads->threads)
        EXPECT_NE(thread, std::this_thread::get_id());
}

TEST_F(MixedProgramsGLTest, noMergeIsThrownAwayWhenARenderingIsExchanged)
{
    addThree();
    _scene->setSettleFrames(0);
    draw(6);
    for (int i = 0; i < 3; ++i)
    {
        _scene->setRendering(1, importNamed(i % 2 ? "toon" : "hatching"));
        draw(6);
        ASSERT_NO_FATAL_FAILURE(drawUntil("mix.programs.merged", count("mix.programs.started")));
    }
    EXPECT_EQ(count("mix.programs.started"), count("mix.programs.merged"));
}

TEST_F(MixedProgramsGLTest, aMovingNodeOfKeyPointsCompilesNothing)
{
    addThree();
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> vehicle = new osg::MatrixTransform;
    root->addChild(_scene);
    root->addChild(vehicle);
    _scene->addChild(_model);
    _scene->setKeyNode(vehicle);
    _scene->setSettleFrames(2);
    for (int i = 0; i < 60; ++i)
    {
        vehicle->setMatrix(osg::Matrixd::translate(0.05 * i, 0.0, 0.0));
        _viewer.renderFloat(root, _camera, Size, Size);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(count("mix.programs.linked"), 1.0);
    for (int i = 0; i < 20000 && count("mix.programs.linked") < 2.0; ++i)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        _viewer.renderFloat(root, _camera, Size, Size);
    }
    EXPECT_GE(count("mix.programs.linked"), 2.0) << "when it rests they are made";
}

TEST_F(MixedProgramsGLTest, quietFramesAreCountedOnceForSeveralViews)
{
    addThree();
    osg::ref_ptr<osg::Group> root = new osg::Group;
    _scene->addChild(_model);
    root->addChild(_scene);
    for (int i = 0; i < 3; ++i)
    {
        osg::ref_ptr<osg::Camera> view = new osg::Camera;
        view->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        view->setViewMatrix(_camera.view);
        view->setProjectionMatrix(_camera.projection);
        view->setRenderOrder(osg::Camera::POST_RENDER);
        view->addChild(_scene);
        root->addChild(view);
    }
    _scene->setSettleFrames(12);
    for (int i = 0; i < 10; ++i)
        _viewer.renderFloat(root, _camera, Size, Size);
    EXPECT_EQ(count("mix.programs.linked"), 1.0);
}

TEST_F(MixedProgramsGLTest, theNewestOneGoesOfAPairThatFailsOnlyTogether)
{
    _scene->addRendering(plain("red", "vec4(1.0, 0.0, 0.0, 1.0)"), {0.0, 0.0, 1.0, 3.0});
    const unsigned int first = _scene->addRendering(blocks("first", 10), {1.0, 3.0, 3.0, 4.0});
    _scene->addRendering(plain("blue", "vec4(0.0, 0.0, 1.0, 1.0)"), {3.0, 4.0, Infinity, Infinity});
    setKeys({{-1.6, -1.0, 0.5}});
    support::NotifyCapture capture;
    draw(3);
    ASSERT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
    _scene->setRendering(0, blocks("second", 10));
    draw(3);
    for (int i = 0; i < 20000 && planOf("rendering 0").empty(); ++i)
        draw();
    EXPECT_EQ(planOf("rendering 0 'red'"), "as it was before a change that can't be used");
    EXPECT_EQ(planOf("rendering 1"), "") << "it is older and stays";
    EXPECT_EQ(planOf("rendering 2"), "");
    const support::NotifyCapture::Lines warnings = capture.takeWarnings();
    ASSERT_EQ(warnings.size(), 3u) << "said once: " << testing::PrintToString(warnings);
    EXPECT_NE(warnings[2].find("rendering 'second' is left out"), std::string::npos);
    // Without the other one it is tried again.
    EXPECT_TRUE(_scene->removeRendering(first));
    for (int i = 0; i < 20000 && !planOf("rendering 0").empty(); ++i)
        draw();
    draw(40);
    EXPECT_EQ(planOf("rendering 0"), "");
    EXPECT_NE(_scene->getSource().find("second"), std::string::npos);
}
