// SPDX-License-Identifier: MIT
#include "PagedScenes.h"

#include <support/NotifyCapture.h>

#include <osg/LOD>
#include <osg/MatrixTransform>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

using osgPagedTexture::PagedScene;

namespace
{

class PrefetchGLTest : public testing::Test
{
protected:
    /// A square of its own picture to the right of the eye that looks along y.
    osg::ref_ptr<osg::Node> makeHouse(const std::string& name, float x)
    {
        paged::writePicture(_folder, name, 256, 256);
        return paged::makeSquare({x, 10.0f, 0.0f}, paged::makeTexture(_folder.file(name)));
    }

    osg::ref_ptr<PagedScene> page(osg::Node& model, const std::string& prefetch)
    {
        // What is not culled at all looks nowhere ahead: something is always in view.
        const osg::ref_ptr<osg::MatrixTransform> horizon =
            new osg::MatrixTransform(osg::Matrixd::scale(100.0, 100.0, 100.0));
        horizon->addChild(paged::makeSquare({0.0f, 4.0f, 0.0f}, nullptr));
        const osg::ref_ptr<osg::Group> all = new osg::Group;
        all->addChild(horizon);
        all->addChild(&model);
        const std::string file = _folder.file("model.osgt");
        EXPECT_TRUE(osgDB::writeNodeFile(*all, file));
        // A budget that is none would have all of it loaded when it comes into view.
        const osg::ref_ptr<PagedScene> scene = paged::read(file, "gpu=0.3,prefetch=" + prefetch);
        EXPECT_GT(paged::countOf(*scene, "textures"), 0.0);
        return scene;
    }

    /// Draws for half a second of real time, in steps of 20 ms; `eye` is that of the seconds since.
    void draw(PagedScene& scene, const std::function<support::CameraSpec(double)>& eye)
    {
        const auto start = std::chrono::steady_clock::now();
        for (double time = 0.0; time < 0.5;)
        {
            _viewer.render(&scene, eye(time), 320, 240);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

/// Turns to the right by 90 degrees a second.
support::CameraSpec turning(double seconds)
{
    const double angle = 1.57 * seconds - 0.3;
    return support::CameraSpec::perspective({}, {std::sin(angle), std::cos(angle), 0.0},
                                            {0.0, 0.0, 1.0}, 40.0, 4.0 / 3.0, 0.1, 1e4);
}

/// To the right at 40 units a second.
support::CameraSpec sliding(double seconds)
{
    return paged::lookAlong({40.0 * seconds - 40.0, 0.0, 0.0});
}

} // namespace

TEST_F(PrefetchGLTest, whatAMovingEyeWillSeeIsThereBeforeItIsInView)
{
    OSGKITS_NEED_GL(_viewer);
    const osg::ref_ptr<osg::Node> right = makeHouse("right.png", 15.0f);
    const osg::ref_ptr<osg::MatrixTransform> shifted =
        new osg::MatrixTransform(osg::Matrixd::translate(5.0, 0.0, 0.0));
    shifted->addChild(makeHouse("shifted.png", 10.0f));
    for (osg::Node* model : {right.get(), static_cast<osg::Node*>(shifted)})
        for (const auto& path : {turning, sliding})
        {
            const osg::ref_ptr<PagedScene> with = page(*model, "1");
            draw(*with, path);
            EXPECT_EQ(paged::countOf(*with, "textures.inView"), 0.0) << "no proof";
            EXPECT_EQ(paged::countOf(*with, "textures.resident"), 1.0);
        }
}

TEST_F(PrefetchGLTest, withoutPrefetchAndWhereTheEyeDoesNotGoNothingComes)
{
    OSGKITS_NEED_GL(_viewer);
    const osg::ref_ptr<PagedScene> without = page(*makeHouse("right.png", 15.0f), "0");
    draw(*without, turning);
    EXPECT_EQ(paged::countOf(*without, "textures.resident"), 0.0);
    const osg::ref_ptr<PagedScene> left = page(*makeHouse("left.png", -15.0f), "1");
    draw(*left, turning);
    EXPECT_EQ(paged::countOf(*left, "textures.resident"), 0.0);
    const osg::ref_ptr<PagedScene> still = page(*makeHouse("still.png", 15.0f), "1");
    draw(*still, [](double) { return paged::lookAlong(); });
    EXPECT_EQ(paged::countOf(*still, "textures.resident"), 0.0);
}

TEST_F(PrefetchGLTest, levelsOfDetailThatWillNotShowDoNotCome)
{
    OSGKITS_NEED_GL(_viewer);
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(makeHouse("near.png", 15.0f), 0.0f, 8.0f);
    lod->addChild(makeHouse("far.png", 15.0f), 8.0f, 1e6f);
    const osg::ref_ptr<PagedScene> scene = page(*lod, "1");
    draw(*scene, turning);
    EXPECT_EQ(paged::countOf(*scene, "textures.resident"), 1.0);
    const std::vector<osgMultiRender::Plan> plans = scene->getPlans();
    for (const osgMultiRender::PlanEntry& entry : plans.at(0).entries)
        EXPECT_EQ(entry.decision == osgMultiRender::PlanEntry::Decision::Drawn,
                  entry.subject.find("far.png") != std::string::npos)
            << entry.subject;
}
