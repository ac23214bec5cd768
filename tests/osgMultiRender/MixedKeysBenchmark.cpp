// SPDX-License-Identifier: MIT
// What key points cost in frames of a model that is shown in three renderings.
//
//   osgMultiRender.MixedKeysBenchmark [--size WxH] [--rounds N] [--csv file] model
//
// Key points are random over the model's footprint, polylines wander about it. Printed are medians
// of milliseconds of CPU time a frame, of all threads, and ratios to 16: at rest, while one of the
// key points is dragged, while all of them move.
#include "osgMultiRender/KeyMotion.h"

#include <osgMultiRender/Import.h>
#include <osgMultiRender/MixedScene.h>
#include <support/FrameTimer.h>

#include <osg/ComputeBoundsVisitor>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cstdio>
#include <random>

using namespace osgMultiRender;

namespace
{

constexpr int SettlingFrames = 60; ///< Until programs of fewer renderings are there.

struct Candidate
{
    std::string kind, name;
    osg::ref_ptr<MixedScene> scene;
    KeyMotion motion = KeyMotion::Rest;
    std::vector<double> times;

    void move(double by)
    {
        if (motion == KeyMotion::Rest)
            return;
        std::vector<osg::Vec3d> points = scene->getKeyPoints();
        for (osg::Vec3d& point : points)
            if (motion == KeyMotion::Moving || &point == &points[points.size() / 2])
                point.x() += by;
        scene->setKeyPoints(points, scene->getKeyMode());
    }
};

std::vector<osg::Vec3d> makePoints(const osg::BoundingBox& box, int count, bool isPath)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    const osg::Vec3d extent = box._max - box._min;
    std::vector<osg::Vec3d> points;
    double x = any(random), y = any(random);
    const double step = 0.02; // of the model's width
    for (int i = 0; i < count; ++i)
    {
        x = isPath ? std::clamp(x + step * (2.0 * any(random) - 1.0), 0.0, 1.0) : any(random);
        y = isPath ? std::clamp(y + step * (2.0 * any(random) - 1.0), 0.0, 1.0) : any(random);
        points.emplace_back(box.xMin() + x * extent.x(), box.yMin() + y * extent.y(),
                            box.zMin() + 0.1 * any(random) * extent.z());
    }
    return points;
}

osg::ref_ptr<MixedScene> makeScene(osg::Node& model, const osg::BoundingBox& box, int count,
                                   bool isPath)
{
    const osg::ref_ptr<MixedScene> scene = new MixedScene;
    const double unit = 0.01 * (box._max - box._min).length();
    const std::pair<const char*, MixRange> renderings[] = {
        {"phong", {0.0, 0.0, 1.0 * unit, 2.0 * unit}},
        {"toon", {1.0 * unit, 2.0 * unit, 4.0 * unit, 6.0 * unit}},
        {"hatching", {4.0 * unit, 6.0 * unit}}};
    for (const auto& [name, range] : renderings)
        scene->addRendering(importNamed(name), range);
    scene->setKeyPoints(makePoints(box, count, isPath),
                        isPath ? KeyMode::Polyline : KeyMode::Points);
    scene->addChild(&model);
    return scene;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    if (!options.read(arguments))
        return 1;
    const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFiles(arguments);
    if (!model)
    {
        std::fprintf(stderr, "name a model\n");
        return 1;
    }
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;
    osg::ComputeBoundsVisitor bounds;
    model->accept(bounds);
    const auto camera = support::CameraSpec::overview(*model, timer.getAspect());
    std::vector<Candidate> candidates;
    for (const bool isPath : {false, true})
        for (const int count : {1, 16, 10000})
            for (const KeyMotion motion : AllKeyMotions)
            {
                Candidate candidate;
                candidate.kind = isPath ? "polyline" : "points";
                candidate.name =
                    candidate.kind + " " + std::to_string(count) + KeyMotionNames[int(motion)];
                candidate.motion = motion;
                candidate.scene = makeScene(*model, bounds.getBoundingBox(), count, isPath);
                candidates.push_back(candidate);
            }
    const double step = 1e-4 * (bounds.getBoundingBox()._max - bounds.getBoundingBox()._min).x();
    for (Candidate& candidate : candidates)
        for (int frame = 0; frame < SettlingFrames; ++frame)
            timer.drawOnce(*candidate.scene, camera);
    for (int round = 0; round < options.rounds; ++round)
        for (Candidate& candidate : candidates)
        {
            candidate.move(step);
            timer.drawOnce(*candidate.scene, camera); // the one before was of another scene
            const double start = getCpuMilliseconds();
            candidate.move(step);
            timer.drawOnce(*candidate.scene, camera);
            candidate.times.push_back(getCpuMilliseconds() - start);
        }
    Table table({"key points", "ms", "to 16"});
    for (const Candidate& candidate : candidates)
    {
        const auto few = std::find_if(candidates.begin(), candidates.end(),
                                      [&](const Candidate& other)
                                      { return other.name == candidate.kind + " 16"; });
        const double time = median(candidate.times);
        table.add(candidate.name, {time, time / median(few->times)});
    }
    return table.report(options.csv);
}
