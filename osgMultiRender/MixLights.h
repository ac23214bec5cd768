// SPDX-License-Identifier: MIT
// Tells renderings which lights are on. Not installed.
#pragma once

#include <osg/Program>
#include <osg/State>

namespace osgMultiRender
{

/// GLSL knows the values of GL's lights, but not whether they are on. A rendering that declares
///
///     uniform int osg_EnabledLights; // = 1
///
/// gets the bits of their numbers, 0 to 7, for each drawable. Where nothing moves programs are made
/// in which they are a constant (MergeOptions::lights).
class MixLights
{
public:
    /// `program` is applied; whether it asks for lights is looked up here.
    void setProgram(const osg::Program::PerContextProgram& program);
    /// The lights of the state that is applied. `scope` tells states apart: those of one have equal
    /// lights.
    void send(osg::State& state, const void* scope);

private:
    GLint _place = -1;
    GLint _sent = -1;
    const void* _scope = nullptr;
};

} // namespace osgMultiRender
