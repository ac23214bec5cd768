// SPDX-License-Identifier: MIT
// Cull and frame time against the number of lights that cast shadows: spots over an industrial
// plant.
//
//   osgShadowVolume.ShadowLightsBenchmark [--size WxH] [--rounds N] [--most N] [--objects N]
//                                         [--angle degrees] [--csv file] [--picture file]
//
// "anew" is the plain way: one cull and one draw a light, each of a scene with this light alone.
// Its frames are summed, less what an empty frame takes for all but one of them; adding them up in
// the framebuffer is not counted. All ways are drawn in turns; printed are medians.
#include <support/FrameTimer.h>

#include <osgShadowVolume/ShadowedScene.h>

#include <examples/plant/Plant.h>

#include <osg/ArgumentParser>
#include <osg/LightSource>
#include <osgDB/WriteFile>

#include <cmath>

using osgShadowVolume::ShadowedScene;

namespace
{

/// Spots over the floor, `side` x `side` of them, that shine down.
void addLights(osg::Group& scene, int number, double size, float cutoff)
{
    const int side = int(std::ceil(std::sqrt(double(number))));
    for (int i = 0; i < number; ++i)
    {
        const float x = float(size * ((i % side + 0.5) / side - 0.5));
        const float y = float(size * ((i / side + 0.5) / side - 0.5));
        osg::ref_ptr<osg::Light> light = new osg::Light(unsigned(i));
        light->setPosition(osg::Vec4(x, y, 14.0f, 1.0f));
        light->setDirection(osg::Vec3(0.1f, 0.15f, -1.0f));
        light->setSpotCutoff(cutoff);
        light->setAmbient(osg::Vec4(0, 0, 0, 1));
        light->setDiffuse(osg::Vec4(1, 1, 1, 1) * (2.0f / number));
        light->setSpecular(osg::Vec4(0, 0, 0, 1));
        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        source->setLight(light);
        scene.addChild(source);
    }
}

struct Candidate
{
    int lights = 0;
    osg::ref_ptr<ShadowedScene> scene;
    std::vector<double> frame, cull, anew, factor;
};

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    int most = 64, objects = 1000;
    float angle = 60.0f;
    std::string picture;
    arguments.read("--most", most);
    arguments.read("--objects", objects);
    arguments.read("--angle", angle);
    arguments.read("--picture", picture);
    if (!options.read(arguments))
        return 2;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;

    PlantSettings settings;
    settings.objects = unsigned(objects);
    settings.lights = false;
    const osg::ref_ptr<osg::Group> plant = makePlant(settings);
    const double radius = plant->getBound().radius();
    const support::CameraSpec camera = support::CameraSpec::perspective(
        {-0.7 * radius, -0.8 * radius, 0.5 * radius}, {0, 0, 0}, {0, 0, 1}, 45.0, timer.getAspect(),
        0.02 * radius, 4.0 * radius);
    std::vector<Candidate> candidates;
    for (int lights : {1, 2, 4, 8, 16, 32, 64})
    {
        if (lights > most)
            break;
        Candidate candidate;
        candidate.lights = lights;
        candidate.scene = new ShadowedScene;
        candidate.scene->setLightScope(ShadowedScene::LightScope::ALL);
        candidate.scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
        candidate.scene->addChild(plant);
        addLights(*candidate.scene, lights, 1.3 * radius, angle);
        candidates.push_back(candidate);
    }
    const osg::ref_ptr<osg::Group> empty = new osg::Group;
    for (int round = -1; round < options.rounds; ++round)
        for (Candidate& candidate : candidates)
        {
            const double idle = timer.draw(*empty, camera).frame;
            candidate.scene->setLightShown(-1);
            const FrameTime all = timer.draw(*candidate.scene, camera);
            double anew = idle;
            for (int light = 0; light < candidate.lights; ++light)
            {
                candidate.scene->setLightShown(light);
                anew += timer.draw(*candidate.scene, camera).frame - idle;
            }
            if (round < 0)
                continue;
            candidate.frame.push_back(all.frame);
            candidate.cull.push_back(all.cull);
            candidate.anew.push_back(anew);
            candidate.factor.push_back(anew / all.frame);
        }
    Table table({"lights", "cull_ms", "frame_ms", "ms_per_light", "anew_ms", "factor", "shadowed",
                 "draw_calls"});
    const double first = median(candidates.front().frame);
    for (const Candidate& candidate : candidates)
    {
        candidate.scene->setLightShown(-1);
        timer.draw(*candidate.scene, camera);
        auto counts = candidate.scene->getPlans().back().counts;
        const double frame = median(candidate.frame);
        table.add(std::to_string(candidate.lights),
                  {median(candidate.cull), frame,
                   candidate.lights > 1 ? (frame - first) / (candidate.lights - 1) : 0.0,
                   median(candidate.anew), median(candidate.factor), counts["shadows.lights"],
                   counts["shadows.drawCalls"]});
    }
    if (!picture.empty())
        osgDB::writeImageFile(*timer.getViewer().render(candidates.back().scene, camera,
                                                        options.width, options.height),
                              picture);
    return table.report(options.csv);
}
