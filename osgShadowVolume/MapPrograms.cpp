// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MapPrograms.h>

#include <osgShadowVolume/Shaders.h>

#include <osg/Depth>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osgDB/ReadFile>

#ifndef GL_DEPTH_CLAMP
#define GL_DEPTH_CLAMP 0x864F
#endif

namespace osgShadowVolume
{

namespace
{

osg::ref_ptr<osg::Program> makeProgram()
{
    osg::ref_ptr<osg::Shader> text = osgDB::readRefShaderFileWithFallback(
        osg::Shader::VERTEX, "osgShadowVolume/map.vert", shaders::map_vert);
    osg::ref_ptr<osg::Shader> vertex = new osg::Shader(
        osg::Shader::VERTEX, "#version 330 compatibility\n" + text->getShaderSource());
    osg::ref_ptr<osg::Shader> fragment =
        new osg::Shader(osg::Shader::FRAGMENT, "#version 330 compatibility\nvoid main()\n{\n}\n");
    vertex->setName("osgShadowVolume/map.vert");
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->setThreadSafeRefUnref(true);
    program->setName("osgShadowVolume map.vert");
    program->addShader(vertex);
    program->addShader(fragment);
    return program;
}

osg::ref_ptr<osg::StateSet> makeState(unsigned int samples)
{
    constexpr auto on = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
    constexpr auto off = osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE;
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setThreadSafeRefUnref(true);
    state->setAttribute(makeProgram(), on);
    state->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, true), on);
    // A sample is compared up to half of the filtered square from where it was drawn, in x and y:
    // a plane falls by `samples` times the larger slope at most. A tenth is for rounding.
    state->setAttributeAndModes(new osg::PolygonOffset(1.1f * float(samples), 4.0f), on);
    state->setMode(GL_DEPTH_CLAMP, on); // casters between the light and its nearest depth
    for (GLenum mode :
         {GL_CULL_FACE, GL_BLEND, GL_ALPHA_TEST, GL_STENCIL_TEST, GL_CLIP_PLANE0, GL_CLIP_PLANE1,
          GL_CLIP_PLANE2, GL_CLIP_PLANE3, GL_CLIP_PLANE4, GL_CLIP_PLANE5})
        state->setMode(mode, off);
    return state;
}

} // namespace

const osg::StateSet& MapPrograms::get(unsigned int samples)
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<osg::StateSet>& state = _states[samples];
    if (!state)
        state = makeState(samples);
    return *state;
}

void MapPrograms::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [samples, stateSet] : _states)
        stateSet->releaseGLObjects(state);
}

} // namespace osgShadowVolume
