// SPDX-License-Identifier: MIT
#pragma once

#include <osg/GLExtensions>

namespace osgLabels
{

/// What OSG does not load.
struct LabelExtensions
{
    void(GL_APIENTRY* vertexAttribI1i)(GLuint, GLint) = nullptr;
    void(GL_APIENTRY* clearBufferuiv)(GLenum, GLint, const GLuint*) = nullptr;
    void(GL_APIENTRY* getIntegeri)(GLenum, GLuint, GLint*) = nullptr;
    void(GL_APIENTRY* clearBufferfv)(GLenum, GLint, const GLfloat*) = nullptr;

    static const LabelExtensions& instance()
    {
        static const LabelExtensions extensions = []
        {
            LabelExtensions e;
            osg::setGLExtensionFuncPtr(e.vertexAttribI1i, "glVertexAttribI1i");
            osg::setGLExtensionFuncPtr(e.clearBufferuiv, "glClearBufferuiv");
            osg::setGLExtensionFuncPtr(e.getIntegeri, "glGetIntegeri_v");
            osg::setGLExtensionFuncPtr(e.clearBufferfv, "glClearBufferfv");
            return e;
        }();
        return extensions;
    }
};

} // namespace osgLabels
