// SPDX-License-Identifier: MIT
#include "PlacementShader.h"

using namespace osgLabels;

namespace placementShader
{

namespace
{

constexpr char Uniforms[] = R"glsl(
uniform vec4 rotation;
uniform vec3 origin;
uniform int shape;
uniform vec3 size;
uniform float width;

osgLabels_Object object()
{
    return osgLabels_Object(rotation, origin, uint(shape), size, 1u);
}
)glsl";

} // namespace

osg::ref_ptr<osg::Program> programOf(const char* vertex, const char* fragment)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT,
                        "#version 330 compatibility\n" + placementSource() + Uniforms + fragment));
    return program;
}

osg::Vec3 vec(const glm::vec3& v)
{
    return osg::Vec3(v.x, v.y, v.z);
}

void setObject(osg::StateSet* state, const ObjectRecord& record, float width)
{
    const glm::quat& q = record.rotation;
    state->addUniform(new osg::Uniform("rotation", osg::Vec4(q.x, q.y, q.z, q.w)));
    state->addUniform(new osg::Uniform("origin", vec(record.origin)));
    state->addUniform(new osg::Uniform("shape", int(record.shape)));
    state->addUniform(new osg::Uniform("size", vec(record.size)));
    state->addUniform(new osg::Uniform("width", width));
}

} // namespace placementShader
