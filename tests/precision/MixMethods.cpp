// SPDX-License-Identifier: MIT
#include <precision/MixMethods.h>

#include <osgMultiRender/Import.h>
#include <osgMultiRender/Merger.h>
#include <osgMultiRender/MixState.h>
#include <osgMultiRender/MixedScene.h>

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Group>
#include <osg/Program>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace precision
{

namespace
{

using osgMultiRender::Merged;
using osgMultiRender::MixState;
using osgMultiRender::Rendering;

constexpr unsigned int MixUnit = 11;

/// The fragment's place as MixedScene finds it.
const char Begin[] =
    "uniform vec4 osgmr_mixViewport; // place; 2 / size\n"
    "void osgmr_mixBegin()\n{\n"
    "    vec3 place = vec3((gl_FragCoord.xy - osgmr_mixViewport.xy) * osgmr_mixViewport.zw,\n"
    "                      2.0 * (gl_FragCoord.z - gl_DepthRange.near) / gl_DepthRange.diff);\n"
    "    vec4 clip = vec4(place - 1.0, 1.0) / gl_FragCoord.w;\n"
    "    osgmr_mixAt((gl_ProjectionMatrixInverse * clip).xyz);\n}\n";

osg::ref_ptr<osg::Program> makeProgram(const std::string& vertex, const std::string& fragment)
{
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return program;
}

osg::ref_ptr<osg::StateSet> makeMixState(const MixTask& task, const osg::Matrixd& view, int size)
{
    const osg::ref_ptr<MixState> state = new MixState(MixUnit);
    state->update(task.points, task.weights, view);
    const osg::ref_ptr<osg::StateSet> stateSet = state->getStateSet();
    const float scale = 2.0f / static_cast<float>(size);
    stateSet->addUniform(new osg::Uniform("osgmr_mixViewport", osg::Vec4(0, 0, scale, scale)));
    return stateSet;
}

/// One program of renderings `first` to `end`, whose weights are those of the task.
void addMerged(osg::StateSet& stateSet, const MixTask& task, std::size_t first, std::size_t end,
               osgMultiRender::MergeOutside outside)
{
    std::vector<osgMultiRender::MergeEntry> entries;
    for (std::size_t i = first; i < end; ++i)
        entries.push_back({&task.renderings[i], 1.0});
    osgMultiRender::MergeOptions options;
    options.weights = "#define osgmr_weight osgmr_slotWeight\n" + MixState::getSource() +
                      "#undef osgmr_weight\n" + Begin +
                      "float osgmr_weight(int rendering)\n{\n    return osgmr_slotWeight(" +
                      std::to_string(first) + " + rendering);\n}\n";
    options.begin = "osgmr_mixBegin();";
    options.beginAt = "osgmr_mixAt";
    options.outside = outside;
    options.lights = 1; // as where nothing moves
    const Merged merged = osgMultiRender::mergeRenderings(entries, options);
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        if (!merged.ok || !merged.renderings[i].included)
            throw std::runtime_error(task.renderings[first + i].name + " is not merged");
        addMixUniforms(stateSet, task.renderings[first + i],
                       [&](const std::string& name) { return merged.nameOf(i, name); });
    }
    stateSet.setAttribute(makeProgram(merged.vertex, merged.fragment));
}

std::string readText(const std::string& name)
{
    std::ifstream file(OSGKITS_HANDWRITTEN "/" + name);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (text.empty())
        throw std::runtime_error("there is no text in " + name);
    return text;
}

void addByHand(osg::StateSet& stateSet, const MixTask& task)
{
    const std::string head = "#version 330 compatibility\n#define LIGHTS 1\n#define COUNT " +
                             std::to_string(task.renderings.size()) + "\n";
    stateSet.setAttribute(
        makeProgram(head + readText("mix.vert"),
                    head + MixState::getSource() + "#line 1\n" + readText("mix.frag")));
    for (const Rendering& rendering : task.renderings)
        addMixUniforms(stateSet, rendering,
                       [&](const std::string& name) { return rendering.name + "_" + name; });
}

osg::ref_ptr<osg::Group> makeGroup(osg::StateSet* stateSet, osg::Node* model)
{
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    group->setStateSet(stateSet);
    group->addChild(model);
    return group;
}

/// The first pass finds what is seen, the others add to it where they have weight.
osg::ref_ptr<osg::Node> makePasses(const MixTask& task, osg::Node* model, osg::StateSet* mix)
{
    const osg::ref_ptr<osg::Group> all = new osg::Group;
    all->setStateSet(mix);
    for (std::size_t i = 0; i < task.renderings.size(); ++i)
    {
        using osgMultiRender::MergeOutside;
        const osg::ref_ptr<osg::StateSet> pass = new osg::StateSet;
        addMerged(*pass, task, i, i + 1, i ? MergeOutside::Background : MergeOutside::Transparent);
        pass->setRenderBinDetails(static_cast<int>(i), "RenderBin");
        if (i)
        {
            pass->setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE));
            pass->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
        }
        all->addChild(makeGroup(pass, model));
    }
    return all;
}

osg::ref_ptr<osg::Node> makeScene(const MixTask& task, osg::Node* model, bool prunes)
{
    const osg::ref_ptr<osgMultiRender::MixedScene> scene = new osgMultiRender::MixedScene;
    for (std::size_t i = 0; i < task.renderings.size(); ++i)
        scene->addRendering(task.renderings[i], task.ranges[i]);
    std::vector<osg::Vec3d> points;
    for (const glm::dvec3& point : task.places)
        points.emplace_back(point.x, point.y, point.z);
    scene->setKeyPoints(points, task.points.getMode());
    scene->setPruning(prunes);
    scene->setSettleFrames(0);
    scene->addChild(model);
    return scene;
}

} // namespace

void addMixUniforms(osg::StateSet& stateSet, const Rendering& rendering,
                    const std::function<std::string(const std::string&)>& nameOf)
{
    for (const osgMultiRender::RenderingUniform& own : rendering.uniforms)
    {
        const std::string name = nameOf(own.name);
        const std::vector<double>& values = own.values;
        if (name.empty() || values.empty())
            continue;
        const auto at = [&](std::size_t i) { return static_cast<float>(values[i]); };
        osg::ref_ptr<osg::Uniform> uniform;
        if (own.type == "sampler2D" || own.type == "int")
            uniform = new osg::Uniform(name.c_str(), static_cast<int>(values[0]));
        else if (values.size() == 3)
            uniform = new osg::Uniform(name.c_str(), osg::Vec3(at(0), at(1), at(2)));
        else if (values.size() == 1)
            uniform = new osg::Uniform(name.c_str(), at(0));
        else
            throw std::runtime_error("no way for the uniform " + name);
        stateSet.addUniform(uniform);
    }
}

MixTask::MixTask(std::size_t count)
    : places({{-2.0, -2.0, 0.5}, {2.0, 0.0, 0.0}, {3.0, 3.0, 1.0}}),
      points(places, osgMultiRender::KeyMode::Polyline)
{
    const char* const names[] = {"phong", "textured", "xray",   "toon",
                                 "gooch", "checker",  "bricks", "wood"};
    const double end = std::numeric_limits<double>::infinity();
    const double wide = 6.0 / static_cast<double>(count);
    for (std::size_t i = 0; i < count && i < std::size(names); ++i)
    {
        renderings.push_back(osgMultiRender::importNamed(names[i]));
        const double from = wide * static_cast<double>(i);
        ranges.push_back({from - wide, from, from, from + wide});
    }
    ranges.back().dr2 = ranges.back().dr3 = end;
    weights = osgMultiRender::MixWeights(ranges, osgMultiRender::MixRules());
}

osg::ref_ptr<osg::Node> makeMixNode(MixMethod method, const MixTask& task, osg::Node* model,
                                    const osg::Matrixd& view, int size)
{
    if (method == MixMethod::Scene || method == MixMethod::Pruning)
        return makeScene(task, model, method == MixMethod::Pruning);
    const osg::ref_ptr<osg::StateSet> stateSet = makeMixState(task, view, size);
    if (method == MixMethod::Passes)
        return makePasses(task, model, stateSet);
    if (method == MixMethod::Merged)
        addMerged(*stateSet, task, 0, task.renderings.size(),
                  osgMultiRender::MergeOutside::Transparent);
    else
        addByHand(*stateSet, task);
    return makeGroup(stateSet, model);
}

} // namespace precision
