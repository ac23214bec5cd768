// SPDX-License-Identifier: MIT
#include "osgMultiRender/MixTruth.h"

#include <osg/Group>
#include <osg/Program>

#include <algorithm>
#include <cmath>

using osgMultiRender::KeyPoints;
using osgMultiRender::MixWeights;

MixTruth::MixTruth(support::HeadlessViewer& viewer, osg::Node* model,
                   const support::CameraSpec& camera, int size)
    : _viewer(viewer), _model(model), _camera(camera), _size(size)
{
    const osg::ref_ptr<osg::StateSet> places = new osg::StateSet;
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX,
                                       "#version 120\n"
                                       "uniform mat4 osg_ViewMatrixInverse;\n"
                                       "varying vec4 place;\n"
                                       "void main() {\n"
                                       "    place = osg_ViewMatrixInverse * gl_ModelViewMatrix *\n"
                                       "            gl_Vertex;\n"
                                       "    gl_Position = gl_ModelViewProjectionMatrix *\n"
                                       "                  gl_Vertex;\n"
                                       "}\n"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "#version 120\n"
                                       "varying vec4 place;\n"
                                       "void main() { gl_FragColor = vec4(place.xyz, "
                                       "1234.0); }\n"));
    places->setAttribute(program, osg::StateAttribute::OVERRIDE);
    places->setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    _places = draw(places);
}

osg::ref_ptr<osg::Image> MixTruth::draw(osg::StateSet* stateSet)
{
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    group->setStateSet(stateSet);
    group->addChild(_model);
    osg::ref_ptr<osg::Image> picture = _viewer.renderFloat(group, _camera, _size, _size);
    // The next picture may share its memory.
    return picture ? osg::clone(picture.get(), osg::CopyOp::DEEP_COPY_ALL) : nullptr;
}

void MixTruth::add(osg::StateSet* rendering)
{
    _pictures.push_back(draw(rendering));
}

bool MixTruth::hasSurface(int x, int y) const
{
    return reinterpret_cast<const float*>(_places->data(x, y))[3] == 1234.0f;
}

MixTruth::Difference MixTruth::compare(const osg::Image& picture, const KeyPoints& points,
                                       const MixWeights& weights, const glm::dvec4* behind) const
{
    Difference result;
    double squares = 0.0;
    for (int y = 0; y < _size; ++y)
        for (int x = 0; x < _size; ++x)
        {
            const auto* place = reinterpret_cast<const float*>(_places->data(x, y));
            if (!hasSurface(x, y))
                continue;
            ++result.covered;
            const double distance = points.distance({place[0], place[1], place[2]});
            std::vector<glm::dvec3> colors;
            for (const auto& single : _pictures)
            {
                const auto* color = reinterpret_cast<const float*>(single->data(x, y));
                colors.emplace_back(color[0], color[1], color[2]);
            }
            const std::vector<double> each = weights.at(distance);
            result.mixed += std::count_if(each.begin(), each.end(),
                                          [](double weight) { return weight > 0.0; }) > 1;
            glm::dvec4 expected = weights.mix(distance, colors);
            if (behind)
                expected += (1.0 - expected.a) * *behind;
            const auto* actual = reinterpret_cast<const float*>(picture.data(x, y));
            double worst = 0.0;
            for (int i = 0; i < 4; ++i)
            {
                const double off = double(actual[i]) - expected[i];
                worst = std::max(worst, std::abs(off));
                squares += off * off;
            }
            if (!(worst <= 1.0 / 255.0))
                ++result.over;
            result.worst = std::max(result.worst, worst);
        }
    result.rms = std::sqrt(squares / std::max(4 * result.covered, 1));
    return result;
}
