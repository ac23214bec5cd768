// SPDX-License-Identifier: MIT
#include "CoveragePage.h"

#include <osgLabels/Shaders.h>

#include <osg/Geometry>
#include <osg/Program>
#include <osg/TextureBuffer>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

constexpr int Letters = 1024; ///< A line.
constexpr int Lines = 64;     ///< Different ones: each begins some letters later.
constexpr int Step = 13;
constexpr double Pitch = 1.25; ///< em
constexpr unsigned int CodesUnit = 7;
const glm::dvec2 Origin(40.313, 81.771); ///< em; within the text for all views.

const char Vertex[] = R"glsl(#version 330 compatibility
void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)glsl";

const char Table[] = R"glsl(#version 330 compatibility
uniform usamplerBuffer osgLabels_codes;
struct osgLabels_Text { uint offset; int length; };
uint osgLabels_code(osgLabels_Text text, int i)
{
    return texelFetch(osgLabels_codes, int(text.offset) + i).r;
}
)glsl";

const char Main[] = R"glsl(
uniform mat2 footprint;
uniform vec2 origin;
void main()
{
    vec2 place = footprint * gl_FragCoord.xy + origin;
    float line = floor(place.y / 1.25);
    place.y -= line * 1.25 + 0.125;
    osgLabels_Text text = osgLabels_Text(uint(int(line) & 63) * 13u, 1024);
    gl_FragColor = vec4(shade(text, place, footprint));
}
)glsl";

} // namespace

glm::mat2 CoverageView::getFootprint() const
{
    const auto turn = [](double angle)
    {
        const double c = std::cos(angle), s = std::sin(angle);
        return glm::dmat2(c, -s, s, c);
    };
    constexpr double Degree = 3.14159265358979 / 180.0;
    return turn(-axis * Degree) * glm::dmat2(squash, 0.0, 0.0, 1.0) * turn(degrees * Degree) /
           pixelsPerEm;
}

CoveragePage::CoveragePage(const std::shared_ptr<osgLabels::GlyphSet>& glyphs,
                           const std::string& text)
    : _glyphs(glyphs), _codes(), _truth((_codes = glyphs->codesOf(text), *glyphs))
{
    const std::vector<std::uint32_t> once = _codes;
    while (_codes.size() < Letters + Step * Lines)
        _codes.insert(_codes.end(), once.begin(), once.end());
}

std::string CoveragePage::getDefaultText()
{
    return "The quick brown fox jumps over the lazy dog 0123456789 Gearbox housing M8x40 (rev. B) "
           "#42 @% & {wing_rib-17} WMwm P-1047/B ";
}

glm::vec2 CoveragePage::getPlace(const CoverageView& view, const glm::dvec2& pixel, int& line) const
{
    glm::dvec2 place = glm::dmat2(view.getFootprint()) * (pixel + view.shift) + Origin;
    line = static_cast<int>(std::floor(place.y / Pitch));
    place.y -= line * Pitch + 0.125;
    return place;
}

std::vector<std::uint32_t> CoveragePage::getLine(int line) const
{
    const auto begin = _codes.begin() + (line & (Lines - 1)) * Step;
    return {begin, begin + Letters};
}

osg::ref_ptr<osg::Image> CoveragePage::makeTruth(const CoverageView& view, int size) const
{
    osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->allocateImage(size, size, 1, GL_RED, GL_FLOAT);
    std::vector<std::uint32_t> codes;
    int current = std::numeric_limits<int>::min();
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
        {
            int line = 0;
            const glm::vec2 place = getPlace(view, glm::dvec2(x + 0.5, y + 0.5), line);
            if (line != current)
                codes = getLine(current = line);
            *reinterpret_cast<float*>(picture->data(x, y)) =
                _truth.getCoverage(codes, place, view.getFootprint());
        }
    return picture;
}

osg::ref_ptr<osg::Node> CoveragePage::makeNode(const CoverageView& view, const std::string& source,
                                               int copies) const
{
    const osg::ref_ptr<osg::Geometry> triangle = new osg::Geometry;
    triangle->setUseDisplayList(false);
    triangle->setUseVertexBufferObjects(true);
    triangle->setVertexArray(new osg::Vec3Array(3));
    triangle->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3, copies));
    triangle->setCullingActive(false);
    osg::StateSet* const state = triangle->getOrCreateStateSet();
    state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, Vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, Table + source + Main));
    state->setAttributeAndModes(program);

    const osg::ref_ptr<osg::Image> codes = new osg::Image;
    codes->allocateImage(static_cast<int>(_codes.size()), 1, 1, GL_RED_INTEGER_EXT,
                         GL_UNSIGNED_INT);
    std::copy(_codes.begin(), _codes.end(), reinterpret_cast<std::uint32_t*>(codes->data()));
    const osg::ref_ptr<osg::TextureBuffer> buffer = new osg::TextureBuffer(codes);
    buffer->setInternalFormat(0x8236); // GL_R32UI
    state->setTextureAttribute(CodesUnit, buffer);
    state->addUniform(new osg::Uniform("osgLabels_codes", static_cast<int>(CodesUnit)));

    const glm::mat2 footprint = view.getFootprint();
    const glm::dvec2 origin = glm::dmat2(footprint) * view.shift + Origin;
    osg::Matrix2 matrix;
    matrix.set(footprint[0].x, footprint[0].y, footprint[1].x, footprint[1].y);
    state->addUniform(new osg::Uniform("footprint", matrix));
    state->addUniform(new osg::Uniform(
        "origin", osg::Vec2(static_cast<float>(origin.x), static_cast<float>(origin.y))));
    return triangle;
}

osg::ref_ptr<osg::Node> CoveragePage::makeNode(const CoverageView& view,
                                               const osgLabels::GlyphAtlas& atlas, int copies) const
{
    const osg::ref_ptr<osg::Node> node =
        makeNode(view,
                 atlas.getDefines() + osgLabels::shaders::coverage_glsl +
                     "float shade(osgLabels_Text text, vec2 place, mat2 footprint)\n"
                     "{ return osgLabels_coverage(text, place, footprint); }\n",
                 copies);
    atlas.apply(*node->getOrCreateStateSet(), 0);
    return node;
}

double getRmsPercent(const osg::Image& actual, const osg::Image& expected)
{
    if (actual.s() != expected.s() || actual.t() != expected.t())
        throw std::runtime_error("getRmsPercent: pictures of different size");
    double sum = 0.0;
    for (int y = 0; y < actual.t(); ++y)
        for (int x = 0; x < actual.s(); ++x)
        {
            const double difference = *reinterpret_cast<const float*>(actual.data(x, y)) -
                                      *reinterpret_cast<const float*>(expected.data(x, y));
            sum += difference * difference;
        }
    return 100.0 * std::sqrt(sum / (actual.s() * static_cast<double>(actual.t())));
}
