// SPDX-License-Identifier: MIT
// What labels cost: scenes without and with them, drawn in turns from a fixed place and along a
// path around them.
//
//   osgLabels.LabelSceneBenchmark [--size WxH] [--rounds N] [--path N] [--csv file]
//       [--settings a=b] [--against c=d] [--plain-only] model...
//
// plain is the model alone, off a LabelScene that shows no labels (with --against
// one with those settings, that does), on one that does. Printed are
// medians over rounds, for the path of the sums over its N places; ratios are of on to off and of
// on to plain in the same round. --plain-only: for models that bring text of their own.
#include <support/FrameTimer.h>

#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>

#include <osg/ArgumentParser>
#include <osg/Timer>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>

#include <cstdio>
#include <optional>

namespace
{

enum Method
{
    PLAIN,
    OFF,
    ON,
    NumMethods
};

struct Candidate
{
    std::string name;
    std::vector<support::CameraSpec> cameras; ///< The fixed place, then the path.
    osg::ref_ptr<osg::Group> scenes[NumMethods];
    std::vector<double> fixed[NumMethods], path[NumMethods], fixedRatio[2], pathRatio[2];
    double loadSeconds = 0.0, firstFrame = 0.0; ///< firstFrame: with labels, in seconds.
};

/// Around the middle of the scene, close enough that single labels are read.
std::vector<support::CameraSpec> makePath(const osg::Node& model, int places, double aspect)
{
    const osg::BoundingSphere bound = model.getBound();
    std::vector<support::CameraSpec> path;
    for (int i = 0; i < places; ++i)
    {
        const double angle = 2.0 * osg::PI * i / places;
        const osg::Vec3d away(std::cos(angle), std::sin(angle), 0.35);
        const osg::Vec3d eye = osg::Vec3d(bound.center()) + away * (0.5 * bound.radius());
        path.push_back(support::CameraSpec::perspective(eye, bound.center(), {0.0, 0.0, 1.0}, 40.0,
                                                        aspect, 0.001 * bound.radius(),
                                                        3.0 * bound.radius()));
    }
    return path;
}

bool load(const std::string& file, const osgLabels::LabelSettings& settings,
          const std::optional<osgLabels::LabelSettings>& against, int places, double aspect,
          Candidate& candidate)
{
    const osg::Timer_t start = osg::Timer::instance()->tick();
    const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(file);
    if (!model)
        return false;
    candidate.loadSeconds = osg::Timer::instance()->delta_s(start, osg::Timer::instance()->tick());
    candidate.name = osgDB::getStrippedName(file);
    candidate.cameras = {support::CameraSpec::overview(*model, aspect)};
    for (const support::CameraSpec& camera : makePath(*model, places, aspect))
        candidate.cameras.push_back(camera);
    osg::ref_ptr<osgLabels::LabelScene> off = new osgLabels::LabelScene,
                                        on = new osgLabels::LabelScene;
    off->setSettings(against.value_or(settings));
    off->setShown(against.has_value());
    on->setSettings(settings);
    candidate.scenes[PLAIN] = new osg::Group;
    candidate.scenes[OFF] = off;
    candidate.scenes[ON] = on;
    for (auto& scene : candidate.scenes)
        scene->addChild(model);
    return true;
}

void measure(FrameTimer& timer, Candidate& candidate, int round, int methods)
{
    double fixed[NumMethods] = {}, path[NumMethods] = {};
    for (std::size_t place = 0; place < candidate.cameras.size(); ++place)
        for (int method = 0; method < methods; ++method)
        {
            const double time =
                timer.draw(*candidate.scenes[method], candidate.cameras[place]).frame;
            (place == 0 ? fixed : path)[method] += time;
        }
    if (round < 0)
        return;
    for (int method = 0; method < NumMethods; ++method)
    {
        candidate.fixed[method].push_back(fixed[method]);
        candidate.path[method].push_back(path[method]);
    }
    for (int to : {PLAIN, OFF})
    {
        candidate.fixedRatio[to].push_back(fixed[ON] / fixed[to]);
        candidate.pathRatio[to].push_back(path[ON] / path[to]);
    }
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    int places = 8;
    arguments.read("--path", places);
    osgLabels::LabelSettings settings;
    std::optional<osgLabels::LabelSettings> against;
    std::string text;
    if (arguments.read("--settings", text))
        for (const std::string& error : parseLabelOptions(settings, text))
            return std::fprintf(stderr, "%s\n", error.c_str()), 2;
    if (arguments.read("--against", text))
        for (const std::string& error : parseLabelOptions(against.emplace(), text))
            return std::fprintf(stderr, "%s\n", error.c_str()), 2;
    const int methods = arguments.read("--plain-only") ? 1 : int(NumMethods);
    if (!options.read(arguments))
        return 2;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;
    timer.getViewer().getViewer().setLightingMode(osg::View::HEADLIGHT);
    Table table({"scene", "plain_ms", "off_ms", "on_ms", "on/off", "on/plain", "path_plain_ms",
                 "path_off_ms", "path_on_ms", "path_on/off", "path_on/plain", "load_s",
                 "labels_s"});
    for (int i = 1; i < arguments.argc(); ++i)
    {
        Candidate candidate;
        if (!load(arguments[i], settings, against, places, timer.getAspect(), candidate))
            return std::fprintf(stderr, "%s can't be read\n", arguments[i]), 1;
        const osg::Timer_t start = osg::Timer::instance()->tick();
        timer.drawOnce(*candidate.scenes[methods - 1], candidate.cameras.front());
        candidate.firstFrame =
            osg::Timer::instance()->delta_s(start, osg::Timer::instance()->tick());
        for (int round = -1; round < options.rounds; ++round)
            measure(timer, candidate, round, methods);
        std::vector<double> row;
        addMedians(row, candidate.fixed);
        row.push_back(median(candidate.fixedRatio[OFF]));
        row.push_back(median(candidate.fixedRatio[PLAIN]));
        addMedians(row, candidate.path);
        row.push_back(median(candidate.pathRatio[OFF]));
        row.push_back(median(candidate.pathRatio[PLAIN]));
        row.push_back(candidate.loadSeconds);
        row.push_back(candidate.firstFrame);
        table.add(candidate.name, row);
    }
    return table.report(options.csv);
}
