// SPDX-License-Identifier: MIT
// Labels against what is done without them: one osgText::Text, or one texture, an object. The
// models are drawn in turns, from a place that shows all and from one among the objects.
//
//   osgLabels.LabelPeersBenchmark [--size WxH] [--rounds N] [--csv file] ours peer...
//
// ours is drawn on a LabelScene, each peer (a model that brings its text) as it is. Models by
// osgrefinery --objects N [--as drawables --labels text|texture]. Printed are medians over rounds
// and of the ratios to ours in the same round.
#include <support/FrameTimer.h>

#include <osgLabels/LabelScene.h>

#include <osg/ArgumentParser>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>

#include <cstdio>

namespace
{

struct Candidate
{
    std::string name;
    osg::ref_ptr<osg::Node> scene;
    std::vector<double> far, near, cull, farRatio, nearRatio;
};

bool load(osg::ArgumentParser& files, std::vector<Candidate>& candidates)
{
    for (int i = 1; i < files.argc(); ++i)
    {
        const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(files[i]);
        if (!model)
            return std::fprintf(stderr, "%s can't be read\n", files[i]), false;
        osg::ref_ptr<osg::Group> scene = i == 1 ? new osgLabels::LabelScene : new osg::Group;
        scene->addChild(model);
        candidates.push_back({osgDB::getStrippedName(files[i]), scene, {}, {}, {}, {}, {}});
    }
    return candidates.size() > 1;
}

support::CameraSpec cameraAmong(const osg::Node& model, double aspect)
{
    const osg::BoundingSphere bound = model.getBound();
    const osg::Vec3d eye =
        osg::Vec3d(bound.center()) + osg::Vec3d(1.0, 0.0, 0.35) * (0.5 * bound.radius());
    return support::CameraSpec::perspective(eye, bound.center(), {0.0, 0.0, 1.0}, 40.0, aspect,
                                            0.001 * bound.radius(), 3.0 * bound.radius());
}

void measure(FrameTimer& timer, std::vector<Candidate>& candidates, bool counts)
{
    const osg::Node& ours = *candidates.front().scene;
    const support::CameraSpec all = support::CameraSpec::overview(ours, timer.getAspect());
    const support::CameraSpec among = cameraAmong(ours, timer.getAspect());
    for (Candidate& candidate : candidates)
    {
        const FrameTime far = timer.draw(*candidate.scene, all);
        const FrameTime near = timer.draw(*candidate.scene, among);
        if (!counts)
            continue;
        candidate.far.push_back(far.frame);
        candidate.near.push_back(near.frame);
        candidate.cull.push_back(far.cull);
        candidate.farRatio.push_back(far.frame / candidates.front().far.back());
        candidate.nearRatio.push_back(near.frame / candidates.front().near.back());
    }
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    if (!options.read(arguments))
        return 2;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;
    timer.getViewer().getViewer().setLightingMode(osg::View::HEADLIGHT);
    std::vector<Candidate> candidates;
    if (!load(arguments, candidates))
        return std::fprintf(stderr, "a model for labels and others to compare are needed\n"), 1;
    for (int round = -1; round < options.rounds; ++round)
        measure(timer, candidates, round >= 0);
    Table table({"scene", "all_ms", "among_ms", "all_cull_ms", "all/ours", "among/ours"});
    for (const Candidate& candidate : candidates)
        table.add(candidate.name,
                  {median(candidate.far), median(candidate.near), median(candidate.cull),
                   median(candidate.farRatio), median(candidate.nearRatio)});
    return table.report(options.csv);
}
