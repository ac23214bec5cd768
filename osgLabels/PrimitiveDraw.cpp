// SPDX-License-Identifier: MIT
#include <osgLabels/PrimitiveRun.h>

#include "PixelScale.h"
#include "PrimitiveMeshes.h"

#include <osg/GLExtensions>
#include <osg/Notify>
#include <osg/State>
#include <osg/VertexArrayState>

#include <atomic>

namespace osgLabels
{

namespace
{

constexpr GLuint ObjectAttribute = 6; ///< As instance.vert has it.

using SetInteger = void(GL_APIENTRY*)(GLuint index, GLint value);

/// OSG's own table lacks this function of OpenGL 3.0.
SetInteger integerSetter()
{
    static const SetInteger function =
        reinterpret_cast<SetInteger>(osg::getGLExtensionFuncPtr("glVertexAttribI1i"));
    return function;
}

bool canDraw(const osg::GLExtensions& gl)
{
    if (gl.glVersion >= 3.3f && gl.glDrawElementsInstanced && integerSetter())
        return true;
    static std::atomic<bool> said{false};
    if (!said.exchange(true))
        OSG_WARN << "osgLabels::PrimitiveBatch: OpenGL " << gl.glVersion
                 << " has no instancing with integer attributes, so it is not drawn; 3.3 is needed"
                 << std::endl;
    return false;
}

} // namespace

void PrimitiveRun::drawImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    const osg::GLExtensions& gl = *state.get<osg::GLExtensions>();
    if (!_count || !canDraw(gl))
        return;
    osg::VertexArrayState* arrays = state.getCurrentVertexArrayState();
    arrays->setVertexBufferObjectSupported(true);
    const bool keepsArrays = state.useVertexArrayObject(_useVertexArrayObject);
    if (!keepsArrays || arrays->getRequiresSetArrays())
    {
        arrays->lazyDisablingOfVertexAttributes();
        arrays->setVertexArray(state, _meshes->positions());
        arrays->setNormalArray(state, _meshes->normals());
        arrays->applyDisablingOfVertexAttributes(state);
    }
    const osg::DrawElementsUShort& indices = *_meshes->indices();
    osg::GLBufferObject* buffer = indices.getOrCreateGLBufferObject(state.getContextID());
    arrays->bindElementBufferObject(buffer);
    const auto offset = reinterpret_cast<const char*>(buffer->getOffset(indices.getBufferIndex()));
    forEachRange(PixelScale::of(renderInfo),
                 [&](const Range& range)
                 {
                     const PrimitiveMeshes::Level& level = _meshes->level(range.level);
                     integerSetter()(ObjectAttribute, GLint(_first + range.first));
                     gl.glDrawElementsInstanced(
                         GL_TRIANGLES, GLsizei(level.mesh.triangles.size()), GL_UNSIGNED_SHORT,
                         offset + level.firstIndex * sizeof(GLushort), GLsizei(range.count));
                 });
    // It would count for whatever comes next.
    integerSetter()(ObjectAttribute, 0);
    if (!keepsArrays)
    {
        arrays->unbindVertexBufferObject();
        arrays->unbindElementBufferObject();
    }
}

osg::VertexArrayState*
PrimitiveRun::createVertexArrayStateImplementation(osg::RenderInfo& renderInfo) const
{
    osg::State& state = *renderInfo.getState();
    osg::VertexArrayState* arrays = new osg::VertexArrayState(&state);
    arrays->assignVertexArrayDispatcher();
    arrays->assignNormalArrayDispatcher();
    if (state.useVertexArrayObject(_useVertexArrayObject))
        arrays->generateVertexArrayObject();
    return arrays;
}

void PrimitiveRun::compileGLObjects(osg::RenderInfo& renderInfo) const
{
    if (!_meshes)
        return;
    const unsigned int context = renderInfo.getState()->getContextID();
    for (osg::GLBufferObject* buffer : {_meshes->positions()->getOrCreateGLBufferObject(context),
                                        _meshes->indices()->getOrCreateGLBufferObject(context)})
        if (buffer && buffer->isDirty())
            buffer->compileBuffer();
}

void PrimitiveRun::resizeGLObjectBuffers(unsigned int maxSize)
{
    osg::Drawable::resizeGLObjectBuffers(maxSize);
    if (!_meshes)
        return;
    const auto resize = [maxSize](const osg::BufferData& data)
    { const_cast<osg::BufferData&>(data).resizeGLObjectBuffers(maxSize); };
    resize(*_meshes->positions());
    resize(*_meshes->normals());
    resize(*_meshes->indices());
}

void PrimitiveRun::releaseGLObjects(osg::State* state) const
{
    osg::Drawable::releaseGLObjects(state);
    if (!_meshes)
        return;
    _meshes->positions()->releaseGLObjects(state);
    _meshes->normals()->releaseGLObjects(state);
    _meshes->indices()->releaseGLObjects(state);
}

} // namespace osgLabels
