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
#include <osgShadowVolume/LitScene.h>

#include <support/HeadlessViewer.h>

#include <osg/ArgumentParser>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Timer>

#include <algorithm>
#include <cmath>
#include <cstdio>
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

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    std::string size = "320x240", csvName;
    int rounds = 7, width = 0, height = 0;
    arguments.read("--size", size);
    arguments.read("--rounds", rounds);
    const bool points = arguments.read("--points");
    double tolerance = 0.5 / 255.0;
    arguments.read("--tolerance", tolerance);
    arguments.read("--csv", csvName);
    if (std::sscanf(size.c_str(), "%dx%d", &width, &height) != 2)
        return std::fprintf(stderr, "--size wants WxH, not '%s'\n", size.c_str()), 2;
    support::HeadlessSettings settings;
    settings.width = width;
    settings.height = height;
    support::HeadlessViewer viewer(settings);
    if (!viewer.isValid())
        return std::fprintf(stderr, "%s\n", viewer.getError().c_str()), 1;
    viewer.getViewer().setLightingMode(osg::View::NO_LIGHT);

    std::vector<unsigned int> numbers = {1, 8, 9, 32, 33, 64, 256, 1024, 4097, 16384, 65536};
    int most = 65536;
    arguments.read("--most", most);
    while (numbers.size() > 1 && numbers.back() > static_cast<unsigned int>(most))
        numbers.pop_back();
    std::vector<osg::ref_ptr<osgShadowVolume::LitScene>> scenes;
    for (unsigned int number : numbers)
        scenes.push_back(makeScene(number, points, tolerance));
    const auto cameraAt = [&](double shift)
    {
        return support::CameraSpec::perspective(osg::Vec3d(shift, -70.0, 50.0), osg::Vec3d(),
                                                osg::Vec3d(0, 0, 1), 45.0, double(width) / height,
                                                1.0, 500.0);
    };
    std::vector<std::vector<double>> resting(numbers.size()), moving(numbers.size());
    for (int round = -1; round < rounds; ++round)
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            viewer.render(scenes[i], cameraAt(0.0), width, height, 1);
            osg::Timer_t start = osg::Timer::instance()->tick();
            viewer.render(scenes[i], cameraAt(0.0), width, height, 1);
            const double rest =
                osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
            start = osg::Timer::instance()->tick();
            viewer.render(scenes[i], cameraAt(0.01 * (round + 2)), width, height, 1);
            const double move =
                osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
            if (round >= 0)
            {
                resting[i].push_back(rest);
                moving[i].push_back(move);
            }
        }
    std::FILE* csv = csvName.empty() ? nullptr : std::fopen(csvName.c_str(), "w");
    if (csv)
        std::fprintf(csv, "lights,resting_ms,moving_ms,drawn,dropped,texture_bytes\n");
    std::printf("%8s %12s %12s %8s %8s %14s\n", "lights", "resting ms", "moving ms", "drawn",
                "dropped", "texture bytes");
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
        auto counts = scenes[i]->getPlans().empty() ? std::map<std::string, double>()
                                                    : scenes[i]->getPlans().back().counts;
        std::printf("%8u %12.2f %12.2f %8.0f %8.0f %14.0f\n", numbers[i], median(resting[i]),
                    median(moving[i]), counts["lights.drawn"], counts["lights.dropped"],
                    counts["textureBytes"]);
        if (csv)
            std::fprintf(csv, "%u,%.3f,%.3f,%.0f,%.0f,%.0f\n", numbers[i], median(resting[i]),
                         median(moving[i]), counts["lights.drawn"], counts["lights.dropped"],
                         counts["textureBytes"]);
    }
    if (csv)
        std::fclose(csv);
    return 0;
}
