// SPDX-License-Identifier: MIT
#include <osgShadowVolume/DepthBounds.h>

#include <osg/GLExtensions>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

constexpr GLenum depthBoundsTest = 0x8890; // GL_DEPTH_BOUNDS_TEST_EXT

using SetDepthBounds = void(GL_APIENTRY*)(GLclampd, GLclampd);

SetDepthBounds setDepthBounds()
{
    static const SetDepthBounds function = []
    {
        SetDepthBounds found = nullptr;
        osg::setGLExtensionFuncPtr(found, "glDepthBoundsEXT");
        return found;
    }();
    return function;
}

} // namespace

DepthBounds::DepthBounds(const osg::State& state, double nearDepth, double farDepth)
{
    const bool limits = nearDepth > 0.0 || farDepth < 1.0;
    if (!limits || nearDepth > farDepth ||
        !osg::isGLExtensionSupported(state.getContextID(), "GL_EXT_depth_bounds_test") ||
        !setDepthBounds())
        return;
    setDepthBounds()(std::max(0.0, nearDepth), std::min(1.0, farDepth));
    glEnable(depthBoundsTest);
    _isOn = true;
}

DepthBounds::~DepthBounds()
{
    if (_isOn)
        glDisable(depthBoundsTest);
}

} // namespace osgShadowVolume
