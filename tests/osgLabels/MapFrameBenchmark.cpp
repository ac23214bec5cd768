// SPDX-License-Identifier: MIT
// What map labels cost a frame along the recorded path over the town, by test, with and without
// decluttering, for the town's labels and for 10,000. CPU time of the whole process, so that a
// software renderer's threads count and other processes don't.
#include "CityPictures.h"

#include <support/FrameTimer.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>

using namespace cityPictures;

namespace
{

/// The town's labels, and as many more beside them.
std::vector<osgLabels::MapLabel> manyLabels(const City& town, std::size_t count)
{
    std::vector<osgLabels::MapLabel> labels = town.labels;
    const std::size_t own = labels.size();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> beside(-30.0, 30.0);
    for (std::size_t i = own; i < count; ++i)
    {
        osgLabels::MapLabel label = labels[i % own];
        label.anchor += osg::Vec3d(beside(random), beside(random), 0.5 * beside(random));
        label.priority = beside(random);
        label.feature.clear();
        labels.push_back(label);
    }
    return labels;
}

/// Milliseconds, median over frames of the path.
double timeOf(osg::Node& scene, unsigned int frames)
{
    std::vector<double> times;
    for (unsigned int i = 0; i < frames + 2; ++i)
    {
        viewer().setSimulationTime(1.0 + i / 60.0);
        const std::clock_t begin = std::clock();
        if (!render(scene, cameraAt(10.0 + i / 60.0)))
            return -1.0;
        if (i >= 2) // what is made in the first ones doesn't count
            times.push_back(1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return median(times);
}

double countOf(const osgLabels::LabelScene& scene, const std::string& name)
{
    const auto plans = scene.getPlans();
    if (plans.empty())
        return 0.0;
    const auto found = plans.front().counts.find(name);
    return found == plans.front().counts.end() ? 0.0 : found->second;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    options.rounds = 31;
    if (!options.read(arguments))
        return 1;
    if (!viewer().isValid())
    {
        std::fprintf(stderr, "%s\n", viewer().getError().c_str());
        return 1;
    }
    const City town = makeTown();
    Table table({"labels", "frame_ms", "more_than_without_ms", "in_view", "shown", "occluders"});
    const osg::ref_ptr<osgLabels::LabelScene> bare = makeScene(town.scene, {});
    const double without = timeOf(*bare, unsigned(options.rounds));
    table.add("none", {without, 0.0, 0.0, 0.0, 0.0});
    for (const std::size_t count : {town.labels.size(), std::size_t(10000)})
    {
        std::vector<InView> all;
        for (const osgLabels::MapLabel& label : manyLabels(town, count))
            all.push_back({label, 0.0, {}});
        for (const char* const declutter : {"off", "on"})
            for (const char* const test : {"pixel", "anchor", "share"})
            {
                const std::string settings =
                    std::string("maptest=") + test + ",declutter=" + declutter;
                const osg::ref_ptr<osgLabels::LabelScene> scene =
                    makeScene(town.scene, all, settings);
                const double time = timeOf(*scene, unsigned(options.rounds));
                table.add(std::to_string(count) + " by " + test +
                              (declutter == std::string("on") ? " decluttered" : ""),
                          {time, time - without, countOf(*scene, "map.labels.inView"),
                           countOf(*scene, "map.labels"), countOf(*scene, "map.occluders")});
            }
    }
    return table.report(options.csv);
}
