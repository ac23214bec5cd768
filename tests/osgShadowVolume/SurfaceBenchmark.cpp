// SPDX-License-Identifier: MIT
// Frame time of the surface programs against the fixed function, as ratios in one run.
//
//   osgShadowVolume.SurfaceBenchmark [--size WxH] [--rounds N] [--csv file] [model ...]
//
// Each model is drawn as stock OSG, with lighting=vertex and with lighting=pixel in turns; printed
// are medians over the rounds and the median of the ratios of each round.
#include <support/FrameTimer.h>

#include <osgShadowVolume/LitScene.h>

#include <support/InventorModels.h>

#include <osg/ArgumentParser>
#include <osg/Switch>
#include <osg/Timer>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cstdio>

namespace
{

enum Method
{
    Fixed,
    Vertex,
    Pixel,
    NumMethods
};

struct Result
{
    double milliseconds[NumMethods];
    double ratio[NumMethods];
    osgMultiRender::Plan plans[NumMethods];
};

Result measure(support::HeadlessViewer& viewer, osg::Node& model, const BenchmarkOptions& options)
{
    using osgShadowVolume::LitScene;
    osg::ref_ptr<osg::Switch> methods = new osg::Switch;
    osg::ref_ptr<LitScene> vertex = new LitScene, pixel = new LitScene;
    vertex->setLighting(LitScene::Lighting::VERTEX);
    vertex->addChild(&model);
    pixel->addChild(&model);
    methods->addChild(&model);
    methods->addChild(vertex);
    methods->addChild(pixel);
    const auto camera =
        support::CameraSpec::overview(model, double(options.width) / options.height);
    std::vector<double> times[NumMethods], ratios[NumMethods];
    for (int round = -2; round < options.rounds; ++round)
    {
        double ms[NumMethods];
        for (int method = 0; method < NumMethods; ++method)
        {
            methods->setSingleChildOn(method);
            viewer.render(methods, camera, options.width, options.height, round < 0 ? 3 : 1);
            const osg::Timer_t start = osg::Timer::instance()->tick();
            viewer.getViewer().frame(0.0);
            ms[method] = osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
        }
        for (int method = 0; round >= 0 && method < NumMethods; ++method)
        {
            times[method].push_back(ms[method]);
            ratios[method].push_back(ms[method] / ms[Fixed]);
        }
    }
    Result result{};
    for (int method = 0; method < NumMethods; ++method)
    {
        result.milliseconds[method] = median(times[method]);
        result.ratio[method] = median(ratios[method]);
    }
    if (!vertex->getPlans().empty())
        result.plans[Vertex] = vertex->getPlans().back();
    if (!pixel->getPlans().empty())
        result.plans[Pixel] = pixel->getPlans().back();
    return result;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    options.rounds = 15;
    if (!options.read(arguments))
        return 2;
    std::vector<std::string> models;
    for (int i = 1; i < argc; ++i)
        models.push_back(argv[i]);
    if (models.empty())
        models = support::inventorModels();

    support::HeadlessSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    support::HeadlessViewer viewer(settings);
    if (!viewer.isValid())
        return std::fprintf(stderr, "%s\n", viewer.getError().c_str()), 1;
    Table table({"model", "fixed_ms", "vertex_ms", "vertex_ratio", "pixel_ms", "pixel_ratio",
                 "drawables", "states", "variants", "vertex_compile_ms", "pixel_compile_ms"});
    std::vector<double> vertexRatios, pixelRatios;
    double sum[NumMethods] = {};
    for (const std::string& name : models)
    {
        osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(name);
        if (!model || !model->getBound().valid())
            continue;
        Result r = measure(viewer, *model, options);
        auto& counts = r.plans[Vertex].counts;
        table.add(osgDB::getSimpleFileName(name),
                  {r.milliseconds[Fixed], r.milliseconds[Vertex], r.ratio[Vertex],
                   r.milliseconds[Pixel], r.ratio[Pixel], counts["drawCalls"], counts["states"],
                   counts["variants"], counts["programs.compileMilliseconds"],
                   r.plans[Pixel].counts["programs.compileMilliseconds"]});
        vertexRatios.push_back(r.ratio[Vertex]);
        pixelRatios.push_back(r.ratio[Pixel]);
        for (int method = 0; method < NumMethods; ++method)
            sum[method] += r.milliseconds[method];
    }
    const int status = table.report(options.csv);
    std::printf(
        "%zu models: vertex median x%.3f, worst x%.3f, of sums x%.3f; pixel median x%.3f, of sums "
        "x%.3f\n",
        vertexRatios.size(), median(vertexRatios),
        vertexRatios.empty() ? 0.0 : *std::max_element(vertexRatios.begin(), vertexRatios.end()),
        sum[Vertex] / sum[Fixed], median(pixelRatios), sum[Pixel] / sum[Fixed]);
    return status;
}
