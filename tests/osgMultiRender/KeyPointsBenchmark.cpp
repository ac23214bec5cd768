// SPDX-License-Identifier: MIT
// What a fragment pays for key points: a picture of osgmr_distance() alone, drawn in turns with
// each number of them.
//
//   osgMultiRender.KeyPointsBenchmark [--size WxH] [--rounds N] [--csv file]
//
// Fragments lie on a wavy surface through the key points, as those of a model do. Printed are
// medians of milliseconds of CPU time a picture, less that without key points, ratios to 16, and
// what the CPU does where points change. At rest, while one of them is dragged, while all move.
#include "osgMultiRender/KeyMotion.h"
#include "osgMultiRender/KeySets.h"

#include <osgMultiRender/MixState.h>
#include <support/FrameTimer.h>

#include <osg/ArgumentParser>
#include <osg/Geometry>
#include <osg/Program>

#include <algorithm>
#include <map>

using namespace osgMultiRender;

namespace
{

const char* const Fragment = "void main() {\n"
                             "    vec2 at = gl_FragCoord.xy / size * 2.0 - 1.0;\n"
                             "    vec3 place = vec3(at, 0.2 * sin(5.0 * at.x) * cos(4.0 * at.y));\n"
                             "    gl_FragColor = vec4(osgmr_distance(place));\n"
                             "}\n";

struct Candidate
{
    std::string name;
    osg::ref_ptr<osg::Geometry> quad;
    std::vector<double> times;
    double update = 0.0; ///< Milliseconds, of points that have changed.
};

/// Of all threads.
double drawTime(FrameTimer& timer, osg::Geometry& quad)
{
    timer.drawOnce(quad, {});
    const double start = getCpuMilliseconds();
    timer.drawOnce(quad, {});
    return getCpuMilliseconds() - start;
}

/// Within a box of two units, so that all of them are near the surface.
std::vector<glm::dvec3> fit(std::vector<glm::dvec3> points)
{
    glm::dvec3 low(1e30), high(-1e30);
    for (const glm::dvec3& point : points)
    {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::dvec3 extent = high - low;
    const double scale = 2.0 / std::max(1e-9, std::max(extent.x, std::max(extent.y, extent.z)));
    for (glm::dvec3& point : points)
        point = (point - 0.5 * (low + high)) * scale;
    return points;
}

/// Brings the state to how it is while points rest or move.
double update(MixState& state, std::vector<glm::dvec3> points, KeyMode mode, KeyMotion motion)
{
    const MixWeights weights({{0, 0, 1, 2}});
    const KeyPoints keys(points, mode);
    if (motion != KeyMotion::Moving)
    {
        keys.findCells(true);
        for (int frame = 0; frame < 2; ++frame) // cells are for points that stay
            state.update(keys, weights, osg::Matrixd());
    }
    double time = 0.0;
    for (int frame = 0; frame < 5 && motion != KeyMotion::Rest; ++frame)
    {
        points[points.size() / 2] += glm::dvec3(0.01);
        const double start = getCpuMilliseconds();
        state.update(KeyPoints(points, mode), weights, osg::Matrixd());
        time = getCpuMilliseconds() - start;
    }
    return time;
}

Candidate makeCandidate(const std::string& name, const std::vector<glm::dvec3>& points,
                        KeyMode mode, KeyMotion motion, const osg::Vec2& size)
{
    Candidate candidate;
    candidate.name = name;
    candidate.quad = osg::createTexturedQuadGeometry({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    candidate.quad->setCullingActive(false);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, "#version 330 compatibility\nvoid "
                                                            "main() { gl_Position = gl_Vertex; }"));
    const std::string head = "#version 330 compatibility\nuniform vec2 size;\n";
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT, head + MixState::getSource() + Fragment));
    const osg::ref_ptr<MixState> state = new MixState(5);
    candidate.update = update(*state, points, mode, motion);
    state->getStateSet()->setAttribute(program);
    state->getStateSet()->addUniform(new osg::Uniform("size", size));
    candidate.quad->setStateSet(state->getStateSet());
    return candidate;
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    options.width = options.height = 512;
    if (!options.read(arguments))
        return 1;
    FrameTimer timer(options);
    if (!timer.isValid())
        return 1;
    const osg::Vec2 size(float(options.width), float(options.height));
    std::vector<Candidate> candidates = {
        makeCandidate("none", {}, KeyMode::Points, KeyMotion::Rest, size)};
    for (const bool isPath : {false, true})
        for (const std::size_t count : {1, 2, 4, 8, 16, 100, 1000, 10000})
            for (const KeySet& set : makeKeySets(count, 11))
                for (const KeyMotion motion : AllKeyMotions)
                {

                    if (set.name == (isPath ? "path" : "random") &&
                        (motion == KeyMotion::Rest || count >= 1000))
                        candidates.push_back(makeCandidate(
                            (isPath ? "polyline " : "points ") + std::to_string(count) +
                                KeyMotionNames[int(motion)],
                            fit(set.points), isPath ? KeyMode::Polyline : KeyMode::Points, motion,
                            size));
                }
    for (int round = -1; round < options.rounds; ++round)
        for (Candidate& candidate : candidates)
        {
            const double time = drawTime(timer, *candidate.quad);
            if (round >= 0)
                candidate.times.push_back(time);
        }
    const double empty = median(candidates[0].times);
    std::map<std::string, double> medians;
    for (const Candidate& candidate : candidates)
        medians[candidate.name] = median(candidate.times) - empty;
    Table table({"key points", "ms", "to 16", "update ms"});
    for (const Candidate& candidate : candidates)
    {
        const std::string kind = candidate.name.substr(0, candidate.name.find(' '));
        const double time = medians[candidate.name];
        table.add(candidate.name,
                  {time, time / std::max(1e-9, medians[kind + " 16"]), candidate.update});
    }
    return table.report(options.csv);
}
