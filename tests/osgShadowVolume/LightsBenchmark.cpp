// SPDX-License-Identifier: MIT
// Frame time against the number of lights: lamps that hang over a floor, as many more and as much
// smaller as they are nearer to each other.
//
//   osgShadowVolume.LightsBenchmark [--size WxH] [--rounds N] [--most N] [--points] [--tolerance t]
//                                   [--csv file]
//
// Lamps are spots of 60 degrees; with --points they shine everywhere, and then only a tolerance can
// leave any out: the far ones add up.
//
// Each number of lights is drawn at rest and with a moving camera (then light data and grid are
// made anew each frame), in turns; printed are medians and what the plan says.
#include <support/FrameTimer.h>

#include <osgShadowVolume/LitScene.h>

#include <osg/ArgumentParser>
#include <osg/Geometry>
#include <osg/LightSource>

#include <cmath>
#include <random>

namespace
{

osg::ref_ptr<osgShadowVolume::LitScene> makeScene(unsigned int lights, bool points,
                                                  double tolerance)
{
    osg::ref_ptr<osgShadowVolume::LitScene> scene = new osgShadowVolume::LitScene;
    scene->setLightTolerance(tolerance);
    scene->setLightScope(osgShadowVolume::LitScene::LightScope::ALL);
    osg::Geometry* floor = osg::createTexturedQuadGeometry(osg::Vec3(-50.0f, -50.0f, 0.0f),
                                                           osg::Vec3(100.0f, 0.0f, 0.0f),
                                                           osg::Vec3(0.0f, 100.0f, 0.0f));
    scene->addChild(floor);
    scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    // The nearer the lights lie to each other, the steeper they fall off.
    const float spacing = 100.0f / std::sqrt(float(lights));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> at(-50.0f, 50.0f), hue(0.2f, 1.0f);
    for (unsigned int i = 0; i < lights; ++i)
    {
        osg::ref_ptr<osg::Light> light = new osg::Light(i);
        light->setPosition(osg::Vec4(at(random), at(random), 0.5f * spacing, 1.0f));
        light->setDirection(osg::Vec3(0.0f, 0.0f, -1.0f));
        light->setSpotCutoff(points ? 180.0f : 60.0f);
        light->setAmbient(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
        light->setDiffuse(osg::Vec4(hue(random), hue(random), hue(random), 1.0f));
        light->setSpecular(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
        light->setConstantAttenuation(0.0f);
        light->setQuadraticAttenuation(10.0f / (spacing * spacing));
        osg::LightSource* source = new osg::LightSource;
        source->setLight(light);
        scene->addChild(source);
    }
    return scene;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    options.width = 320;
    options.height = 240;
    const bool points = arguments.read("--points");
    double tolerance = 0.5 / 255.0;
    arguments.read("--tolerance", tolerance);
    int most = 65536;
    arguments.read("--most", most);
    if (!options.read(arguments))
        return 2;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;

    std::vector<unsigned int> numbers = {1, 8, 9, 32, 33, 64, 256, 1024, 4097, 16384, 65536};
    while (numbers.size() > 1 && numbers.back() > static_cast<unsigned int>(most))
        numbers.pop_back();
    std::vector<osg::ref_ptr<osgShadowVolume::LitScene>> scenes;
    for (unsigned int number : numbers)
        scenes.push_back(makeScene(number, points, tolerance));
    const auto cameraAt = [&](double shift)
    {
        return support::CameraSpec::perspective(osg::Vec3d(shift, -70.0, 50.0), osg::Vec3d(),
                                                osg::Vec3d(0, 0, 1), 45.0, timer.getAspect(), 1.0,
                                                500.0);
    };
    std::vector<std::vector<double>> resting(numbers.size()), moving(numbers.size());
    for (int round = -1; round < options.rounds; ++round)
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            const double rest = timer.draw(*scenes[i], cameraAt(0.0)).frame;
            const double move = timer.drawOnce(*scenes[i], cameraAt(0.01 * (round + 2))).frame;
            if (round >= 0)
            {
                resting[i].push_back(rest);
                moving[i].push_back(move);
            }
        }
    Table table({"lights", "resting_ms", "moving_ms", "drawn", "dropped", "texture_bytes"});
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
        auto counts = scenes[i]->getPlans().empty() ? std::map<std::string, double>()
                                                    : scenes[i]->getPlans().back().counts;
        table.add(std::to_string(numbers[i]),
                  {median(resting[i]), median(moving[i]), counts["lights.drawn"],
                   counts["lights.dropped"], counts["textureBytes"]});
    }
    return table.report(options.csv);
}
