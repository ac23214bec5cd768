// SPDX-License-Identifier: MIT
#include "../osgPagedTexture/CapturedWall.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/PictureFile.h>
#include <osgPagedTexture/VirtualScene.h>

#include <support/ChildProcess.h>
#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>
#include <support/TemporaryFolder.h>

#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

namespace
{

using namespace osgPagedTexture;

/// An artist's way: a model with photographs becomes an atlas, a store, a model that shows it.
class OsgTileStoreViewGLTest : public testing::Test
{
protected:
    static constexpr int Width = 320, Height = 240;

    void SetUp() override
    {
        OSGKITS_NEED_GL(_viewer);
        _model = CapturedWall(20, 16, 128, 128).write(_folder.getPath().string());
        _original = osgDB::readRefNodeFile(_model);
        ASSERT_TRUE(_original);
        const std::string layout = _folder.file("wall.layout.json");
        run({"layout", _model, layout});
        // Without loss, so that pictures can be compared.
        run({"build", layout, "--store", _store, "--format", "png"});
        run({"atlas", _model, layout, _store, _atlas});
    }

    static void run(const std::vector<std::string>& words)
    {
        support::ChildProcess process;
        process.arguments = {OSGKITS_OSGTILESTORE};
        process.arguments.insert(process.arguments.end(), words.begin(), words.end());
        const auto result = process.run();
        ASSERT_EQ(result.exitCode, 0) << result.output << result.errors;
    }

    osg::ref_ptr<osg::Image> view(osg::Node* node)
    {
        const auto camera = support::CameraSpec::overview(*_original, double(Width) / Height);
        return _viewer.render(node, camera, Width, Height, 20);
    }

    osg::ref_ptr<osg::Image> viewModel()
    {
        osgDB::Registry::instance()->clearObjectCache();
        return view(osgDB::readRefNodeFile(_model));
    }

    osg::ref_ptr<VirtualScene> readAtlas() const
    {
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(_atlas);
        osg::ref_ptr<VirtualScene> scene = dynamic_cast<VirtualScene*>(node.get());
        if (!scene)
            return nullptr;
        VirtualSettings settings = scene->getSettings();
        settings.wait = true;
        settings.compression = Compression::None;
        scene->setSettings(settings);
        return scene;
    }

    /// Where the wall is seen from the side coarser levels count. Those of the atlas average other
    /// pixels than a photograph's own, since photographs lie anywhere in it.
    static void expectEqual(const osg::Image& shown, const osg::Image& truth)
    {
        const auto difference = support::difference(shown, truth, 2.0 / 255.0);
        EXPECT_LT(difference.getShareOver(), 0.03);
        EXPECT_LE(difference.worst, 8.0 / 255.0 + 1e-6);
    }

    static bool isOther(const osg::Image& shown, const osg::Image& before)
    {
        return support::difference(shown, before, 2.0 / 255.0).getShareOver() > 0.01;
    }

    /// A photograph that `update` brings into the store is shown in the place of the former one.
    void expectChangeShows(const std::function<void(VirtualScene&)>& update)
    {
        const auto scene = readAtlas();
        ASSERT_TRUE(scene);
        const auto before = view(scene);
        ASSERT_TRUE(before);
        Pixels photograph = readImageFile(_folder.file("camera1.png")).pixels;
        for (std::uint8_t& byte : photograph.bytes)
            byte = std::uint8_t(255 - byte);
        writePictureFile(_folder.file("camera1.png"), photograph);
        update(*scene);
        // Another thread looks at the store.
        osg::ref_ptr<osg::Image> shown = before;
        for (int i = 0; i < 1000 && !isOther(*shown, *before); ++i)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            shown = view(scene);
            ASSERT_TRUE(shown);
        }
        EXPECT_TRUE(isOther(*shown, *before));
        const auto truth = viewModel();
        ASSERT_TRUE(truth);
        expectEqual(*shown, *truth);
    }

    support::TemporaryFolder _folder;
    support::HeadlessViewer _viewer;
    std::string _model;
    osg::ref_ptr<osg::Node> _original;
    const std::string _store = _folder.file("wall.tiles"), _atlas = _folder.file("atlas.osgb");
};

TEST_F(OsgTileStoreViewGLTest, aModelWithAnAtlasShowsItsPhotographsByItself)
{
    const auto truth = viewModel();
    const auto scene = readAtlas();
    ASSERT_TRUE(truth && scene);
    const auto shown = view(scene);
    ASSERT_TRUE(shown);
    expectEqual(*shown, *truth);
}

TEST_F(OsgTileStoreViewGLTest, aStoreThatAnotherProcessUpdatesIsShown)
{
    expectChangeShows(
        [this](VirtualScene& scene)
        {
            run({"update", _store});
            scene.reload();
        });
}

TEST_F(OsgTileStoreViewGLTest, theViewerItselfUpdatesTheStore)
{
    const support::NotifyCapture notes;
    expectChangeShows([](VirtualScene& scene) { scene.update(); });
}

TEST_F(OsgTileStoreViewGLTest, withoutPhotographsAnUpdateKeepsThePictureAndSaysSo)
{
    const auto scene = readAtlas();
    ASSERT_TRUE(scene);
    const auto before = view(scene);
    for (const auto& each : std::filesystem::directory_iterator(_folder.getPath()))
        if (each.path().extension() == ".png")
            std::filesystem::remove(each.path());
    support::NotifyCapture notes;
    scene->update();
    for (int i = 0; i < 1000 && !(i > 0 && scene->isAtRest()); ++i)
        view(scene);
    EXPECT_FALSE(isOther(*view(scene), *before));
    EXPECT_FALSE(notes.takeWarnings().empty());
}

} // namespace
