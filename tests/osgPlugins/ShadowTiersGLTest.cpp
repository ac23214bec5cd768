// SPDX-License-Identifier: MIT
#include <support/ChildProcess.h>
#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/TemporaryFolder.h>

#include <osgShadowVolume/ShadowedScene.h>

#include <osg/Geode>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cstdlib>
#include <filesystem>
#include <sstream>

// Stock osgviewer with less and less OpenGL, as Mesa can play it, with both windowing plugins and
// with OSG's optimizer: shadows lie where they lie.

namespace
{

using osgShadowVolume::ShadowedScene;
using osgShadowVolume::Show;
using osgShadowVolume::Technique;
using Environment = std::map<std::string, std::string>;

const Environment Gl33 = {{"MESA_GL_VERSION_OVERRIDE", "3.3COMPAT"},
                          {"MESA_GLSL_VERSION_OVERRIDE", "330"}};
const Environment Gl33Plain = {
    {"MESA_GL_VERSION_OVERRIDE", "3.3COMPAT"},
    {"MESA_GLSL_VERSION_OVERRIDE", "330"},
    {"MESA_EXTENSION_OVERRIDE",
     "-GL_ARB_gpu_shader5 -GL_ARB_tessellation_shader -GL_ARB_sample_shading"}};
const Environment Gl21 = {{"MESA_GL_VERSION_OVERRIDE", "2.1"},
                          {"MESA_GLSL_VERSION_OVERRIDE", "180"}};

class ShadowTiers : public testing::Test
{
protected:
    struct Seen
    {
        osg::ref_ptr<osg::Image> image;
        std::string text; ///< What osgviewer printed.
    };

    void SetUp() override
    {
        static support::HeadlessViewer viewer({16, 16});
        OSGKITS_NEED_GL(viewer);
        buildScene();
    }

    /// A ball and a box over a floor, under a point light and a spot.
    void buildScene()
    {
        _scene = new ShadowedScene;
        _scene->setLightScope(ShadowedScene::LightScope::ALL);
        _scene->setKeys(false);
        // osgviewer looks along the floor: it is tilted.
        osg::ref_ptr<osg::MatrixTransform> world =
            new osg::MatrixTransform(osg::Matrix::rotate(0.7, 1, 0, 0));
        _scene->addChild(world);
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, -0.1f}, 8, 8, 0.2f)));
        geode->addDrawable(new osg::ShapeDrawable(new osg::Sphere({1, 0.5f, 1.2f}, 0.7f)));
        world->addChild(geode);
        osg::ref_ptr<osg::MatrixTransform> turned = new osg::MatrixTransform(
            osg::Matrix::rotate(0.6, 1, 2, 3) * osg::Matrix::translate(-1, -0.5, 1.5));
        osg::ref_ptr<osg::Geode> box = new osg::Geode;
        box->addDrawable(new osg::ShapeDrawable(new osg::Box({}, 1)));
        turned->addChild(box);
        world->addChild(turned);
        for (int number = 1; number < 3; ++number)
        {
            osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
            osg::ref_ptr<osg::Light> light = new osg::Light(number);
            light->setPosition(number == 1 ? osg::Vec4(2.5f, 1, 5, 1) : osg::Vec4(-3, -2, 6, 1));
            light->setDiffuse(osg::Vec4(0.25f, 0.25f, 0.25f, 1));
            if (number == 2)
            {
                light->setDirection(osg::Vec3(3, 2, -6));
                light->setSpotCutoff(40.0f);
            }
            source->setLight(light);
            world->addChild(source);
        }
    }

    /// osgviewer's last frame of the scene, and what it said, with the plan.
    Seen view(const Environment& environment = {}, const std::string& backend = "egl",
              const std::vector<std::string>& more = {"--SingleThreaded"})
    {
        const std::string model = _folder.file("scene.osgt"), picture = _folder.file("view.png");
        std::filesystem::remove(picture);
        EXPECT_TRUE(osgDB::writeNodeFile(*_scene, model));
        support::ChildProcess process;
        process.arguments = {"osgviewer", "-e",  backend, "--window",  "0",
                             "0",         "240", "180",   "--samples", "0"};
        process.arguments.insert(process.arguments.end(), more.begin(), more.end());
        process.arguments.push_back(model);
        process.environment = environment;
        process.environment["OSG_RUN_FRAME_COUNT"] = "3";
        process.environment["OSG_HEADLESS_CAPTURE"] = picture;
        process.environment.insert({"OSG_NOTIFY_LEVEL", "INFO"});
        if (backend == "osmesa")
            process.environment["LD_PRELOAD"] = "libOSMesa.so.8";
        process.unset = {"DISPLAY"};
        const support::ProcessResult result = process.run();
        Seen seen;
        seen.text = result.output + result.errors;
        EXPECT_EQ(result.exitCode, 0) << seen.text;
        seen.image = osgDB::readRefImageFile(picture);
        EXPECT_TRUE(seen.image.valid()) << seen.text;
        return seen;
    }

    void expectSame(const Seen& actual, const Seen& expected, const std::string& name)
    {
        EXPECT_TRUE((support::CompareImage{0.0, 0.0, 0.0}(actual.image, expected.image, name)));
        if (std::getenv("OSGKITS_KEEP_IMAGES") && actual.image)
            support::writeImage(*actual.image, name);
    }

    static std::size_t count(const std::string& text, const std::string& part)
    {
        std::size_t found = 0;
        for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
            ++found;
        return found;
    }

    static std::string linesWith(const std::string& text, const std::string& part)
    {
        std::istringstream lines(text);
        std::string found;
        for (std::string line; std::getline(lines, line);)
            if (line.find(part) != std::string::npos)
                found += line + "\n";
        return found;
    }

    osg::ref_ptr<ShadowedScene> _scene;
    support::TemporaryFolder _folder;
};

} // namespace

TEST_F(ShadowTiers, eachTierHasTheSameMaskByTheTechniqueThatItHas)
{
    struct Case
    {
        Technique technique;
        const Environment& environment;
        const char* used;
    };
    static const Environment full;
    const Case cases[] = {
        {Technique::AUTO, full, "geometry"},     {Technique::TESS, full, "tess"},
        {Technique::GEOMETRY, full, "geometry"}, {Technique::CPU, full, "cpu"},
        {Technique::AUTO, Gl33, "geometry"},     {Technique::TESS, Gl33, "geometry"},
        {Technique::CPU, Gl33, "cpu"},           {Technique::AUTO, Gl33Plain, "cpu"},
        {Technique::TESS, Gl33Plain, "cpu"},     {Technique::GEOMETRY, Gl33Plain, "cpu"}};
    _scene->setShow(Show::MASK);
    for (int light = 1; light < 3; ++light)
    {
        _scene->setLightShown(light);
        Seen first;
        for (const Case& tier : cases)
        {
            _scene->setTechnique(tier.technique);
            const Seen seen = view(tier.environment);
            EXPECT_NE(seen.text.find(std::string("technique=") + tier.used + ","),
                      std::string::npos)
                << linesWith(seen.text, "technique=");
            EXPECT_EQ(linesWith(seen.text, "FAILED"), "");
            if (!first.image)
                first = seen;
            expectSame(seen, first, "tiers.light" + std::to_string(light));
        }
    }
}

TEST_F(ShadowTiers, picturesOfTiersAreTheSame)
{
    const Seen full = view(), older = view(Gl33), plain = view(Gl33Plain);
    // Programs of another version may round otherwise.
    for (const Seen* seen : {&older, &plain})
        EXPECT_TRUE((support::CompareImage{1.0 / 255.0, 0.0, 1.0 / 255.0}(seen->image, full.image,
                                                                          "tiers.picture")));
}

TEST_F(ShadowTiers, belowOpenGL33OneWarningAndTheLookOfOsg)
{
    const Seen old = view(Gl21);
    EXPECT_EQ(count(old.text, "is older than 3.3, so models keep their fixed-function look"), 1u);
    // The same children in a plain group: light 1 and 2 have no mode, as OSG has it.
    osg::ref_ptr<osg::Group> group = new osg::Group;
    for (unsigned int i = 0; i < _scene->getNumChildren(); ++i)
        group->addChild(_scene->getChild(i));
    const std::string model = _folder.file("plain.osgt");
    ASSERT_TRUE(osgDB::writeNodeFile(*group, model));
    support::ChildProcess process;
    process.arguments = {"osgviewer", "-e",        "egl", "--window",         "0",  "0", "240",
                         "180",       "--samples", "0",   "--SingleThreaded", model};
    process.environment = Gl21;
    process.environment["OSG_RUN_FRAME_COUNT"] = "3";
    process.environment["OSG_HEADLESS_CAPTURE"] = _folder.file("plain.png");
    process.unset = {"DISPLAY"};
    EXPECT_EQ(process.run().exitCode, 0);
    Seen plain;
    plain.image = osgDB::readRefImageFile(_folder.file("plain.png"));
    expectSame(old, plain, "tiers.gl21");
}

TEST_F(ShadowTiers, osmesaShowsWhatEglShows)
{
    const Seen egl = view(), osmesa = view({}, "osmesa");
    EXPECT_TRUE(
        (support::CompareImage{1.0 / 255.0, 0.001, 1.0}(osmesa.image, egl.image, "tiers.osmesa")));
    _scene->setShow(Show::MASK);
    _scene->setLightShown(1);
    for (const Technique technique : {Technique::TESS, Technique::GEOMETRY, Technique::CPU})
    {
        _scene->setTechnique(technique);
        const Seen mask = view(), other = view({}, "osmesa");
        // Another rasterizer: pixels whose centres lie on an edge may differ.
        EXPECT_TRUE((support::CompareImage{1.0 / 255.0, 0.001, 1.0}(other.image, mask.image,
                                                                    "tiers.osmesaMask")));
    }
}

TEST_F(ShadowTiers, theOptimizerAndThreadsChangeNothing)
{
    const Seen plain = view({{"OSG_OPTIMIZER", "OFF"}});
    expectSame(view(), plain, "tiers.optimizer");
    expectSame(view({{"OSG_OPTIMIZER", "DEFAULT FLATTEN_STATIC_TRANSFORMS MERGE_GEODES "
                                       "MERGE_GEOMETRY SPATIALIZE_GROUPS TRISTRIP_GEOMETRY"}}),
               plain, "tiers.optimizerAll");
    for (const char* threads : {"CullDrawThreadPerContext", "DrawThreadPerContext",
                                "CullThreadPerCameraDrawThreadPerContext"})
        expectSame(view({{"OSG_THREADING", threads}}, "egl", {}), plain,
                   std::string("tiers.") + threads);
    // Without shadows it is another picture, or all of this shows nothing.
    _scene->setShadows(osgShadowVolume::Shadows::OFF);
    EXPECT_GT(support::difference(*view().image, *plain.image, 0.04).getShareOver(), 0.005);
}
