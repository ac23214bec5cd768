// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixLights.h>

#include <osgMultiRender/SurfaceState.h>

#include <osg/GLExtensions>
#include <osg/Light>

namespace osgMultiRender
{

namespace
{

GLint enabledLights(const osg::State& state)
{
    GLint bits = 0;
    for (unsigned int number = 0; number < SurfaceState::MaxGLLights; ++number)
        if (state.getLastAppliedMode(GL_LIGHT0 + number))
            bits |= 1 << number;
    return bits;
}

} // namespace

void MixLights::setProgram(const osg::Program::PerContextProgram& program)
{
    static const unsigned int name = osg::Uniform::getNameID("osg_EnabledLights");
    _place = program.getUniformLocation(name);
    _sent = -1;
    _scope = nullptr;
}

void MixLights::send(osg::State& state, const void* scope)
{
    if (_place < 0 || (_scope && scope == _scope))
        return;
    _scope = scope;
    const GLint bits = enabledLights(state);
    if (bits != _sent)
        state.get<osg::GLExtensions>()->glUniform1i(_place, bits);
    _sent = bits;
}

} // namespace osgMultiRender
