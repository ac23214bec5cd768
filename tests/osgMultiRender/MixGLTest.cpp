// SPDX-License-Identifier: MIT
// mix.glsl against the reference in double precision, through MixState; with OSGKITS_LONG at four
// times as many places and for more numbers of key points.
#include "osgMultiRender/KeySets.h"

#include <osgMultiRender/MixState.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <osg/Geometry>
#include <osg/Program>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace osgMultiRender;

namespace
{

const bool isLong = std::getenv("OSGKITS_LONG") != nullptr;
const int Size = isLong ? 64 : 32; // of the picture: a fragment a place
constexpr unsigned int MixUnit = 5;
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Draws one fragment a position; red is the distance, the others are weights 0, 1 and 2.
class Twin
{
public:
    Twin() : state(new MixState(MixUnit)), _positions(new osg::Image)
    {
        _positions->allocateImage(Size, Size, 1, GL_RGBA, GL_FLOAT);
        _positions->setInternalTextureFormat(GL_RGBA32F_ARB);
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(_positions);
        texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
        texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
        osg::StateSet* const stateSet = state->getStateSet();
        stateSet->setTextureAttribute(0, texture);
        stateSet->addUniform(new osg::Uniform("positions", 0));
        const osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::VERTEX, "#version 330 compatibility\n"
                                                                "void main() { gl_Position = "
                                                                "gl_Vertex; }"));
        program->addShader(new osg::Shader(
            osg::Shader::FRAGMENT,
            "#version 330 compatibility\n" + MixState::getSource() +
                "uniform sampler2D positions;\n"
                "void main() {\n"
                "    osgmr_mixAt(texelFetch(positions, ivec2(gl_FragCoord.xy), 0).xyz);\n"
                "    gl_FragColor = vec4(osgmr_mixDistance, osgmr_weight(0), osgmr_weight(1),\n"
                "                        osgmr_weight(2));\n"
                "}\n"));
        stateSet->setAttribute(program);
        node = osg::createTexturedQuadGeometry({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        node->setStateSet(stateSet);
        node->setCullingActive(false);
    }

    void setPositions(const std::vector<glm::vec3>& positions)
    {
        auto* to = reinterpret_cast<glm::vec4*>(_positions->data());
        for (const glm::vec3& position : positions)
            *to++ = glm::vec4(position, 1.0f);
        _positions->dirty();
    }

    osg::ref_ptr<MixState> state;
    osg::ref_ptr<osg::Geometry> node;

private:
    osg::ref_ptr<osg::Image> _positions;
};

osg::Matrixd makeView(const KeySet& set, int kind)
{
    osg::Matrixd view = osg::Matrixd::translate(-set.center.x, -set.center.y, -set.center.z);
    if (kind > 0)
        view.postMult(osg::Matrixd::rotate(0.7, osg::Vec3d(1, 2, 3)));
    if (kind > 1) // distances are those of the key points' frame
        view.postMult(osg::Matrixd::scale(4.0, 4.0, 4.0) * osg::Matrixd::translate(0, 0, -7.0));
    return view;
}

const std::vector<MixRange> Ranges = {
    {0.0, 0.0, 0.1, 0.3}, {0.1, 0.3, 0.5, 0.5}, {0.4, 0.6, 1.0, Infinity}};

MixRules makeRules(int kind)
{
    MixRules rules;
    rules.excess = kind & 1 ? MixRules::Excess::Normalise : MixRules::Excess::Clamp;
    rules.base = kind & 2 ? 2 : -1;
    return rules;
}

class MixGLTest : public testing::Test
{
protected:
    void SetUp() override { OSGKITS_NEED_GL(_viewer); }

    osg::ref_ptr<osg::Image> draw() { return _viewer.renderFloat(_twin.node, {}, Size, Size); }

    void compare(const KeySet& set, KeyMode mode, int kind)
    {
        const KeyPoints keys(set.points, mode);
        std::vector<MixRange> ranges = Ranges;
        for (MixRange& range : ranges)
            range = {range.dr0 * set.radius, range.dr1 * set.radius, range.dr2 * set.radius,
                     range.dr3 * set.radius};
        const MixWeights weights(ranges, makeRules(kind));
        const osg::Matrixd view = makeView(set, kind % 3), inverse = osg::Matrixd::inverse(view);
        std::vector<glm::vec3> positions;
        for (int i = 0; i < Size * Size; ++i)
        {
            const glm::dvec3 place = set.place(_random);
            const osg::Vec3d eye = osg::Vec3d(place.x, place.y, place.z) * view;
            positions.emplace_back(eye.x(), eye.y(), eye.z());
        }
        _twin.setPositions(positions);
        _twin.state->update(keys, weights, view);
        ASSERT_NO_FATAL_FAILURE(comparePicture(keys, weights, inverse, positions, set.radius));
        keys.findCells(true);
        _twin.state->update(keys, weights, view); // again: with cells
        ASSERT_EQ(_twin.state->getTexels().grids.x > 0,
                  keys.getTree().getSegments().size() > MixTexels::LinearSize);
        ASSERT_NO_FATAL_FAILURE(comparePicture(keys, weights, inverse, positions, set.radius));
        if (set.points.size() <= MixTexels::LinearSize || set.points.size() > 300)
            return;
        std::vector<glm::dvec3> points = set.points; // one is dragged, another one gone
        points[points.size() / 2] = set.place(_random);
        points.erase(points.begin());
        const KeyPoints moved(points, mode);
        _twin.state->update(moved, weights, view);
        ASSERT_NO_FATAL_FAILURE(comparePicture(moved, weights, inverse, positions, set.radius));
    }

    void comparePicture(const KeyPoints& keys, const MixWeights& weights,
                        const osg::Matrixd& inverse, const std::vector<glm::vec3>& positions,
                        double radius)
    {
        const osg::ref_ptr<osg::Image> picture = draw();
        ASSERT_TRUE(picture);
        for (std::size_t i = 0; i < positions.size(); ++i)
        {
            const glm::dvec3 p(positions[i]);
            const osg::Vec3d world = osg::Vec3d(p.x, p.y, p.z) * inverse;
            const double distance = keys.distance({world.x(), world.y(), world.z()});
            const auto* const pixel = reinterpret_cast<const float*>(picture->data()) + 4 * i;
            ASSERT_NO_FATAL_FAILURE(comparePixel(pixel, weights, distance, glm::length(p), radius))
                << "fragment " << i;
        }
    }

    /// `size` of the position's coordinates, which the shader turns in single precision.
    void comparePixel(const float* pixel, const MixWeights& weights, double distance, double size,
                      double radius)
    {
        if (distance == Infinity)
        {
            ASSERT_EQ(pixel[0], 1e30f);
        }
        // Rotation, subtraction, product, sum, root: some ten roundings of 6e-8 each.
        const double tolerance = 6e-7 * (std::min(distance, 1e30) + size);
        if (distance != Infinity)
        {
            ASSERT_NEAR(pixel[0], distance, tolerance);
            _worst = std::max(_worst, std::abs(pixel[0] - distance) / (distance + size + 1e-30));
        }
        const auto bounds = weights.over(std::max(0.0, distance - tolerance), distance + tolerance);
        for (std::size_t k = 0; k < 3; ++k)
        {
            // At a step either side may be right; the bounds know. Weights round at 1.
            ASSERT_GE(pixel[1 + k], bounds[k].low - 1e-6) << k << " at " << distance << radius;
            ASSERT_LE(pixel[1 + k], bounds[k].high + 1e-6) << k << " at " << distance << radius;
        }
    }

    support::HeadlessViewer _viewer;
    Twin _twin;
    std::mt19937 _random{6};
    double _worst = 0.0;
};

TEST_F(MixGLTest, equalsTheReferenceForAllSetsModesViewsAndRules)
{
    std::vector<std::size_t> counts = {0, 1, 2, 5, 16, 17, 300, 10000};
    if (isLong)
        counts.insert(counts.end(), {3, 40, 1000});
    int kind = 0;
    for (const std::size_t count : counts)
        for (const KeySet& set : makeKeySets(count, 11))
            for (const KeyMode mode : AllKeyModes)
            {
                // 10,000 lines across each other take seconds a picture in software.
                if (count == 10000 &&
                    mode != (set.name == "path" ? KeyMode::Polyline : KeyMode::Points))
                    continue;
                SCOPED_TRACE(set.name + " " + std::to_string(count) + " mode " +
                             std::to_string(int(mode)) + " kind " + std::to_string(kind));
                ASSERT_NO_FATAL_FAILURE(compare(set, mode, kind++));
            }
    std::printf("worst error of a distance: %.2g of distance + position\n", _worst);
}

TEST_F(MixGLTest, fragmentsAskTheCellsOfPointsThatStay)
{
    const KeySet set = makeKeySets(1000, 11)[0];
    const KeyPoints keys(set.points);
    const MixWeights weights(Ranges, makeRules(0));
    std::vector<glm::vec3> positions;
    for (int i = 0; i < Size * Size; ++i)
        positions.emplace_back(set.place(_random));
    _twin.setPositions(positions);
    keys.findCells(true);
    for (int frame = 0; frame < 2; ++frame)
        _twin.state->update(keys, weights, osg::Matrixd());
    // Without the tree, and without segments to look at one by one.
    const glm::ivec4 there = _twin.state->getTexels().keys;
    _twin.state->getStateSet()->getUniform("osgmr_mixKeys")->set(0, there.y, 0, there.w);
    ASSERT_NO_FATAL_FAILURE(comparePicture(keys, weights, osg::Matrixd(), positions, set.radius));
}

TEST_F(MixGLTest, fragmentsAskTheCellsWhileAPointIsDragged)
{
    KeySet set = makeKeySets(1000, 11)[0];
    const MixWeights weights(Ranges, makeRules(0));
    const KeyPoints keys(set.points);
    keys.findCells(true);
    for (int frame = 0; frame < 2; ++frame)
        _twin.state->update(keys, weights, osg::Matrixd());
    for (int frame = 0; frame < 3; ++frame)
    {
        set.points[0] = set.place(_random);
        const KeyPoints moved(set.points);
        _twin.state->update(moved, weights, osg::Matrixd());
        ASSERT_GT(_twin.state->getTexels().grids.x, 0);
        ASSERT_EQ(_twin.state->getTexels().listed.z, 1);
        std::vector<glm::vec3> positions(Size * Size, glm::vec3(set.points[0]));
        for (std::size_t i = 1; i < positions.size(); ++i)
            positions[i] = set.place(_random);
        _twin.setPositions(positions);
        ASSERT_NO_FATAL_FAILURE(
            comparePicture(moved, weights, osg::Matrixd(), positions, set.radius));
    }
}

TEST_F(MixGLTest, aPositionThatIsNotANumberIsInfinitelyFar)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<glm::vec3> positions(Size * Size, glm::vec3(nan));
    positions[0] = {std::numeric_limits<float>::infinity(), 0.0f, 0.0f};
    _twin.setPositions(positions);
    for (const std::size_t count : {1, 16, 1000})
    {
        const MixWeights weights({{0, 0, 1, 2}, {0, 1, 2, Infinity}, {0, 0, 0, 0}}, makeRules(0));
        _twin.state->update(KeyPoints(makeKeySets(count, 3)[0].points, KeyMode::Polyline), weights,
                            osg::Matrixd());
        const osg::ref_ptr<osg::Image> picture = draw();
        ASSERT_TRUE(picture);
        const auto* const pixels = reinterpret_cast<const float*>(picture->data());
        for (const int i : {0, 1, Size * Size - 1})
        {
            EXPECT_EQ(pixels[4 * i], 1e30f) << count;
            EXPECT_EQ(pixels[4 * i + 1], 0.0f);
            EXPECT_EQ(pixels[4 * i + 2], 1.0f);
        }
    }
}

TEST_F(MixGLTest, aViewThatCannotBeInvertedLeavesNoKeyPoints)
{
    _twin.setPositions(std::vector<glm::vec3>(Size * Size, glm::vec3(0.0f)));
    for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN(), 1e300})
    {
        _twin.state->update(KeyPoints({{0, 0, 0}}), MixWeights(Ranges, makeRules(0)),
                            osg::Matrixd::scale(bad, bad, bad));
        const osg::ref_ptr<osg::Image> picture = draw();
        ASSERT_TRUE(picture);
        if (bad != 1e300)
        {
            EXPECT_EQ(reinterpret_cast<const float*>(picture->data())[0], 1e30f) << bad;
        }
    }
}

TEST_F(MixGLTest, nothingIsCompiledWhileEverythingMoves)
{
    const auto countCompilations = [](const support::NotifyCapture::Lines& lines)
    {
        return std::count_if(lines.begin(), lines.end(),
                             [](const std::string& line)
                             {
                                 return line.find("Compiling") != std::string::npos ||
                                        line.find("Linking") != std::string::npos;
                             });
    };
    support::NotifyCapture capture(osg::INFO);
    const std::size_t counts[] = {0, 1, 16, 17, 100, 1000};
    for (int frame = 0; frame < 1000; ++frame)
    {
        // The key points' number, places and mode; ranges; rules; the view; positions now and then.
        const KeyMode mode = AllKeyModes[frame % 3];
        KeySet set{"moved", {}, randomIn(_random, 100.0), 1.0 + frame % 10};
        for (std::size_t i = 0; i < counts[frame % 6]; ++i)
            set.points.push_back(set.center + randomIn(_random, set.radius));
        if (frame % 25 == 0)
        {
            ASSERT_NO_FATAL_FAILURE(compare(set, mode, frame)) << frame;
        }
        else
        {
            const MixWeights weights({{0.0, 0.1 * (frame % 7), 1.0, 0.01 * frame}},
                                     makeRules(frame));
            _twin.state->update(KeyPoints(set.points, mode), weights, makeView(set, frame % 3));
            ASSERT_TRUE(draw());
        }
        const auto compilations = countCompilations(capture.takeMessages());
        ASSERT_EQ(compilations > 0, frame == 0) << frame << ": " << compilations;
    }
}

TEST_F(MixGLTest, colorsMixByTheRules)
{
    MixRules rules;
    rules.background = {0.5, 0.25, 1.0, 0.5};
    const MixWeights weights({{0, 0, 1, 2}, {0, 1, 1, 4}}, rules);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(
        osg::Shader::FRAGMENT, "#version 330 compatibility\n" + MixState::getSource() +
                                   "void main() {\n"
                                   "    osgmr_mixAt(vec3(gl_FragCoord.x / 6.0, 0.0, 0.0));\n"
                                   "    gl_FragColor = osgmr_mixed(\n"
                                   "        osgmr_weight(0) * vec4(0.75, 0.5, 0.0, 1.0) +\n"
                                   "        osgmr_weight(1) * vec4(0.5, 0.0, 0.25, 1.0));\n"
                                   "}\n"));
    program->addShader(
        new osg::Shader(osg::Shader::VERTEX, "void main() { gl_Position = gl_Vertex; }"));
    _twin.node->getStateSet()->setAttribute(program);
    const KeyPoints keys({{0, 0, 0}});
    _twin.state->update(keys, weights, osg::Matrixd());
    const osg::ref_ptr<osg::Image> picture = draw();
    ASSERT_TRUE(picture);
    const auto* const pixels = reinterpret_cast<const glm::vec4*>(picture->data());
    for (int x = 0; x < Size; ++x)
    {
        const double distance = (x + 0.5) / 6.0;
        const glm::dvec4 expected = weights.mix(distance, {{0.75, 0.5, 0.0}, {0.5, 0.0, 0.25}});
        for (int channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(pixels[x][channel], expected[channel], 1e-6) << x << ", " << channel;
    }
}

} // namespace
