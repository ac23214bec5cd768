// SPDX-License-Identifier: MIT
// What a ShadowedScene costs where nothing casts: models under the viewer's headlight alone, drawn
// by the fixed function, by a LitScene and by a ShadowedScene.
//
//   osgShadowVolume.HeadlightBenchmark [--size WxH] [--rounds N] [--drawables N] [--csv file]
//
// Without a headlight of its own the benchmark's is a light that is placed in eye coordinates. The
// last row has as many drawables as asked for, each under a matrix of its own. All are drawn in
// turns; printed are medians, of ratios those of a round.
#include <support/FrameTimer.h>

#include <osgShadowVolume/ShadowedScene.h>

#include <support/InventorModels.h>

#include <osg/ArgumentParser>
#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>

#include <cmath>

using namespace osgShadowVolume;

namespace
{

enum Method
{
    FIXED,
    LIT,
    SHADOWED,
    NumMethods
};

osg::ref_ptr<osg::Group> makeGrid(int drawables)
{
    osg::ref_ptr<osg::Group> grid = new osg::Group;
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 0.5f)));
    const int side = int(std::ceil(std::cbrt(double(drawables))));
    for (int i = 0; i < drawables; ++i)
    {
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(
            osg::Matrix::translate(i % side, i / side % side, i / (side * side)));
        place->addChild(box);
        grid->addChild(place);
    }
    return grid;
}

struct Candidate
{
    std::string name;
    support::CameraSpec camera;
    osg::ref_ptr<osg::Group> scene[NumMethods];
    std::vector<double> frame[NumMethods], cull[NumMethods], ratio[NumMethods];
};

Candidate makeCandidate(const std::string& name, osg::Node& model, double aspect)
{
    Candidate candidate;
    candidate.name = name;
    candidate.camera = support::CameraSpec::overview(model, aspect);
    candidate.scene[FIXED] = new osg::Group;
    candidate.scene[LIT] = new LitScene;
    candidate.scene[SHADOWED] = new ShadowedScene;
    for (auto& scene : candidate.scene)
        scene->addChild(&model);
    return candidate;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    options.rounds = 9;
    int drawables = 30000;
    arguments.read("--drawables", drawables);
    if (!options.read(arguments))
        return 2;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;
    timer.getViewer().getViewer().setLightingMode(osg::View::HEADLIGHT);
    std::vector<Candidate> candidates;
    for (const char* name : {"chess/king.iv", "engine.iv", "buildings/temple.iv"})
    {
        const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(support::inventorModel(name));
        if (model)
            candidates.push_back(
                makeCandidate(osgDB::getStrippedName(name), *model, timer.getAspect()));
    }
    candidates.push_back(makeCandidate("grid", *makeGrid(drawables), timer.getAspect()));
    for (int round = -1; round < options.rounds; ++round)
        for (Candidate& candidate : candidates)
        {
            FrameTime times[NumMethods];
            for (int method = 0; method < NumMethods; ++method)
                times[method] = timer.draw(*candidate.scene[method], candidate.camera);
            for (int method = 0; round >= 0 && method < NumMethods; ++method)
            {
                candidate.frame[method].push_back(times[method].frame);
                candidate.cull[method].push_back(times[method].cull);
                candidate.ratio[method].push_back(times[method].frame / times[FIXED].frame);
            }
        }
    Table table({"model", "fixed_ms", "lit_ms", "shadowed_ms", "lit_ratio", "shadowed_ratio",
                 "fixed_cull_ms", "lit_cull_ms", "shadowed_cull_ms"});
    for (const Candidate& candidate : candidates)
    {
        std::vector<double> row;
        addMedians(row, candidate.frame);
        row.push_back(median(candidate.ratio[LIT]));
        row.push_back(median(candidate.ratio[SHADOWED]));
        addMedians(row, candidate.cull);
        table.add(candidate.name, row);
    }
    return table.report(options.csv);
}
