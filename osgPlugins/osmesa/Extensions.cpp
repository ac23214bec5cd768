// SPDX-License-Identifier: MIT
#include "OSMesaBackend.h"

#include <osg/GLExtensions>

#include <GL/osmesa.h>
#include <dlfcn.h>

namespace osgOSMesa
{

namespace
{

// OSG looks functions up by symbol. libOSMesa exports only some; for the others the symbol is that
// of libGL, which knows no OSMesa context and does nothing, without an error.
template <class Function> void complete(Function& function, const char* name)
{
    Dl_info osg, mesa;
    if (function && dladdr(reinterpret_cast<void*>(function), &osg) &&
        dladdr(reinterpret_cast<void*>(&OSMesaGetProcAddress), &mesa) &&
        osg.dli_fbase == mesa.dli_fbase)
    {
        return;
    }
    function = reinterpret_cast<Function>(OSMesaGetProcAddress(name));
}

void completeDoubles(osg::GLExtensions& gl)
{
    complete(gl.glVertexAttribLPointer, "glVertexAttribLPointer");
    complete(gl.glUniform1d, "glUniform1d");
    complete(gl.glUniform2d, "glUniform2d");
    complete(gl.glUniform3d, "glUniform3d");
    complete(gl.glUniform4d, "glUniform4d");
    complete(gl.glUniform1dv, "glUniform1dv");
    complete(gl.glUniform2dv, "glUniform2dv");
    complete(gl.glUniform3dv, "glUniform3dv");
    complete(gl.glUniform4dv, "glUniform4dv");
    complete(gl.glUniformMatrix2dv, "glUniformMatrix2dv");
    complete(gl.glUniformMatrix3dv, "glUniformMatrix3dv");
    complete(gl.glUniformMatrix4dv, "glUniformMatrix4dv");
    complete(gl.glUniformMatrix2x3dv, "glUniformMatrix2x3dv");
    complete(gl.glUniformMatrix3x2dv, "glUniformMatrix3x2dv");
    complete(gl.glUniformMatrix2x4dv, "glUniformMatrix2x4dv");
    complete(gl.glUniformMatrix4x2dv, "glUniformMatrix4x2dv");
    complete(gl.glUniformMatrix3x4dv, "glUniformMatrix3x4dv");
    complete(gl.glUniformMatrix4x3dv, "glUniformMatrix4x3dv");
}

void completeSubroutines(osg::GLExtensions& gl)
{
    complete(gl.glGetSubroutineUniformLocation, "glGetSubroutineUniformLocation");
    complete(gl.glGetSubroutineIndex, "glGetSubroutineIndex");
    complete(gl.glGetActiveSubroutineUniformiv, "glGetActiveSubroutineUniformiv");
    complete(gl.glGetActiveSubroutineUniformName, "glGetActiveSubroutineUniformName");
    complete(gl.glGetActiveSubroutineName, "glGetActiveSubroutineName");
    complete(gl.glUniformSubroutinesuiv, "glUniformSubroutinesuiv");
    complete(gl.glGetUniformSubroutineuiv, "glGetUniformSubroutineuiv");
    complete(gl.glGetProgramStageiv, "glGetProgramStageiv");
}

void completeObjects(osg::GLExtensions& gl)
{
    complete(gl.glNamedBufferStorage, "glNamedBufferStorage");
    complete(gl.glTextureStorage1D, "glTextureStorage1D");
    complete(gl.glTextureStorage2D, "glTextureStorage2D");
    complete(gl.glTextureStorage3D, "glTextureStorage3D");
    complete(gl.glNamedFramebufferParameteri, "glNamedFramebufferParameteri");
    complete(gl.glGetNamedFramebufferParameteriv, "glGetNamedFramebufferParameteriv");
    complete(gl.glCreateTransformFeedbacks, "glCreateTransformFeedbacks");
    complete(gl.glTransformFeedbackBufferBase, "glTransformFeedbackBufferBase");
    complete(gl.glTransformFeedbackBufferRange, "glTransformFeedbackBufferRange");
    complete(gl.glGetTransformFeedbackiv, "glGetTransformFeedbackiv");
    complete(gl.glVertexArrayVertexBuffer, "glVertexArrayVertexBuffer");
    complete(gl.glVertexArrayAttribBinding, "glVertexArrayAttribBinding");
    complete(gl.glVertexArrayAttribFormat, "glVertexArrayAttribFormat");
    complete(gl.glVertexArrayAttribIFormat, "glVertexArrayAttribIFormat");
    complete(gl.glVertexArrayAttribLFormat, "glVertexArrayAttribLFormat");
}

} // namespace

void OSMesaBackend::completeExtensions(osg::State& state)
{
    // Creates the table where this context is the first of its ID.
    osg::GLExtensions& gl = *osg::GLExtensions::Get(state.getContextID(), true);
    complete(gl.glClipControl, "glClipControl");
    complete(gl.glPatchParameterfv, "glPatchParameterfv");
    complete(gl.glQueryCounter, "glQueryCounter");
    complete(gl.glGetQueryObjectui64v, "glGetQueryObjectui64v");
    completeDoubles(gl);
    completeSubroutines(gl);
    completeObjects(gl);
}

} // namespace osgOSMesa
