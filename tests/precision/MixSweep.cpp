// SPDX-License-Identifier: MIT
// What the distance to key points costs in a fragment, by their number.
#include <osgMultiRender/MixState.h>
#include <precision/Sweep.h>
#include <support/HeadlessViewer.h>

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Program>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>

namespace
{

using osgMultiRender::KeyMode;
using osgMultiRender::KeyPoints;
using precision::Outcome;

constexpr int PictureSize = 256;
/// Of the picture on top of itself in one frame: what a frame costs besides is small then.
constexpr int Copies = 8;
const std::vector<double> Counts = {0, 1, 16, 100, 1000, 10000};
/// Without the tree 10,000 take seconds a frame in software.
const std::vector<double> FewCounts = {0, 1, 16, 100, 1000};

const char Vertex[] = "#version 330 compatibility\n"
                      "void main() { gl_Position = gl_Vertex; }\n";

/// A slice through the middle of all points; no two rows and columns alike.
const char Place[] = "vec3 getPlace()\n"
                     "{\n"
                     "    vec2 at = gl_FragCoord.xy / 128.0 - 1.0;\n"
                     "    return vec3(at, 0.25 * at.x * at.y);\n"
                     "}\n";

/// As expensive as a small rendering: light, highlight and a texture's worth of arithmetic.
const char Shading[] =
    "float shade(vec3 at)\n"
    "{\n"
    "    vec3 n = normalize(vec3(sin(9.0 * at.x), cos(7.0 * at.y), 1.5));\n"
    "    float light = max(dot(n, normalize(vec3(0.4, 0.3, 0.9))), 0.0);\n"
    "    float ring = smoothstep(0.2, 0.8, fract(4.0 * length(at.xy + 0.1 * n.xy)));\n"
    "    return light * mix(0.4, 0.9, ring) + pow(light, 40.0);\n"
    "}\n";

enum class Kind
{
    Points,
    Path,     ///< A polyline of steps.
    AllPoints ///< Points without a tree.
};

std::vector<glm::dvec3> makePoints(std::size_t count, Kind kind)
{
    std::mt19937 random(20);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<glm::dvec3> points;
    glm::dvec3 at(0.0);
    for (std::size_t i = 0; i < count; ++i)
    {
        const double x = any(random), y = any(random), z = any(random);
        // A walk that turns around at the sides, as a street through a town.
        at += (kind == Kind::Path ? 0.1 : 0.0) * glm::dvec3(x, y, 0.2 * z);
        at = glm::clamp(at, -1.0, 1.0);
        points.push_back(kind == Kind::Path ? at : glm::dvec3(x, y, z));
    }
    return points;
}

double bruteDistance(const KeyPoints& keys, const glm::dvec3& place)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const osgMultiRender::KeySegment& segment : keys.getTree().getSegments())
        nearest = std::min(nearest, segment.distance(place));
    return nearest;
}

/// Of all threads of the program: a software renderer works in several, and others may be busy.
double getCpuSeconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// One number of key points, drawn again and again.
class Scene
{
public:
    Scene(std::size_t count, Kind kind, bool isShaded)
        : camera(new osg::Camera), _state(new osgMultiRender::MixState(0)),
          _picture(new osg::Image),
          _keys(makePoints(count, kind), kind == Kind::Path ? KeyMode::Polyline : KeyMode::Points)
    {
        _state->update(_keys, osgMultiRender::MixWeights(), osg::Matrixd());
        if (kind == Kind::AllPoints)
        {
            const glm::ivec4& keys = _state->getTexels().keys;
            _state->getStateSet()->getUniform("osgmr_mixKeys")->set(0, keys.y, keys.z, keys.w);
        }
        makeCamera();
        const osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::VERTEX, Vertex));
        program->addShader(new osg::Shader(
            osg::Shader::FRAGMENT,
            "#version 330 compatibility\n" + osgMultiRender::MixState::getSource() + Place +
                Shading + "void main()\n{\n    vec3 at = getPlace();\n    float d = " +
                "osgmr_distance(at);\n    gl_FragColor = vec4(d, " +
                (isShaded ? "shade(at) + shade(at.yxz)" : "0.0") + ", 0.0, 1.0);\n}\n"));
        _state->getStateSet()->setAttribute(program);
        _state->getStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
        const osg::ref_ptr<osg::Geometry> quad =
            osg::createTexturedQuadGeometry({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        quad->setStateSet(_state->getStateSet());
        for (int i = 0; i < Copies; ++i)
            camera->addChild(quad);
    }

    void clear()
    {
        // So that nothing drawn is a failure, not the last round's picture.
        std::fill_n(reinterpret_cast<float*>(_picture->data()), PictureSize * PictureSize * 4,
                    std::nanf(""));
    }

    /// Of every 17th pixel, against looking at all points in double precision.
    double getWorstError()
    {
        if (_truth.empty())
            for (int i = 0; i < PictureSize * PictureSize; i += 17)
                _truth.push_back(getTruth(i));
        double worst = 0.0;
        std::size_t next = 0;
        for (int i = 0; i < PictureSize * PictureSize; i += 17)
        {
            const double truth = _truth[next++];
            const float shown = reinterpret_cast<const float*>(_picture->data())[4 * i];
            if (std::isnan(shown))
                throw std::runtime_error("nothing was drawn");
            worst = std::max(worst, std::abs(truth - shown) / std::max(1.0, truth));
        }
        return worst;
    }

    osg::ref_ptr<osg::Camera> camera;

private:
    double getTruth(int pixel) const
    {
        const float x = (float(pixel % PictureSize) + 0.5f) / 128.0f - 1.0f;
        const float y = (float(pixel / PictureSize) + 0.5f) / 128.0f - 1.0f;
        // The shader's infinity.
        return std::min(bruteDistance(_keys, glm::dvec3(x, y, 0.25f * x * y)), 1e30);
    }

    void makeCamera()
    {
        _picture->allocateImage(PictureSize, PictureSize, 1, GL_RGBA, GL_FLOAT);
        _picture->setInternalTextureFormat(GL_RGBA32F_ARB);
        camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setCullingMode(osg::CullSettings::NO_CULLING);
        camera->setViewport(0, 0, PictureSize, PictureSize);
        camera->setRenderOrder(osg::Camera::PRE_RENDER);
        camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
        camera->attach(osg::Camera::COLOR_BUFFER, _picture);
    }

    osg::ref_ptr<osgMultiRender::MixState> _state;
    osg::ref_ptr<osg::Image> _picture;
    KeyPoints _keys;
    std::vector<double> _truth; ///< Of every 17th pixel.
};

class Workshop
{
public:
    Workshop()
    {
        if (!_viewer.isValid())
            throw std::runtime_error(_viewer.getError());
    }

    Outcome draw(double count, Kind kind, bool isShaded)
    {
        std::unique_ptr<Scene>& scene = _scenes[{count, int(kind) * 2 + int(isShaded)}];
        if (!scene)
            scene = std::make_unique<Scene>(static_cast<std::size_t>(count), kind, isShaded);
        scene->clear();
        const double start = getCpuSeconds();
        _viewer.render(scene->camera, {}, 1, 1);
        Outcome outcome;
        outcome.seconds = (getCpuSeconds() - start) / Copies;
        outcome.number = scene->getWorstError();
        return outcome;
    }

    std::string getRenderer() { return _viewer.getRenderer(); }

private:
    support::HeadlessViewer _viewer;
    std::map<std::pair<double, int>, std::unique_ptr<Scene>> _scenes;
};

precision::Sweep makeSweep()
{
    const auto shop = std::make_shared<Workshop>();
    precision::Sweep sweep;
    sweep.name = "key-points";
    sweep.title = "Distance to the nearest key point or segment, 256x256 fragments, CPU time";
    sweep.errorName = "largest error of a distance, against all points in double precision";
    sweep.renderer = shop->getRenderer();
    sweep.getError = [](const Outcome& outcome, const Outcome&) { return outcome.number; };
    const auto add = [&](const std::string& name, Kind kind, bool isShaded)
    {
        sweep.methods.push_back({name, "key points", kind == Kind::AllPoints ? FewCounts : Counts,
                                 [shop, kind, isShaded](double count)
                                 { return shop->draw(count, kind, isShaded); }});
    };
    add("points", Kind::Points, false);
    add("points and two small renderings", Kind::Points, true);
    add("polyline", Kind::Path, false);
    add("points without the tree", Kind::AllPoints, false);
    return sweep;
}

const precision::Registration registration("key-points", makeSweep);

} // namespace
