// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Placement.h>

#include <osg/Program>
#include <osg/StateSet>

/// The GLSL of the placement on one object, whose record is uniforms.
namespace placementShader
{

osg::Vec3 vec(const glm::vec3& v);

/// A fragment shader finds the functions of the placement, `osgLabels_Object object()` and the
/// text's `width` in em.
osg::ref_ptr<osg::Program> programOf(const char* vertex, const char* fragment);

void setObject(osg::StateSet* state, const osgLabels::ObjectRecord& record, float width);

} // namespace placementShader
