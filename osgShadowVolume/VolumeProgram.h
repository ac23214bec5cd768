// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <osg/Program>

#include <string>

namespace osgShadowVolume
{

/// The programs that draw shadow volumes into a counter, an R32F target with additive blending.
///
/// Uniforms: `osgsv_localLight` and `osgsv_lightRest` (MeshLight), `osgsv_end` (w of extrusions),
/// `osgsv_handedness` (1, or -1 where the modelview's determinant is negative); where the GPU
/// judges `osgsv_meshScale` (EdgeMesh::scale); SILHOUETTE has `osgsv_weight` instead. The modelview
/// and projection matrices are GL's own.
enum class VolumePart
{
    TESS_SIDES,     ///< CasterMesh::getPatches(). OpenGL 4.0.
    GEOMETRY_SIDES, ///< CasterMesh::getLines(). GLSL 4.00, or 3.30 with ARB_gpu_shader5.
    CAPS,           ///< CasterMesh::getTriangles(), near and far. Needs what GEOMETRY_SIDES needs.
    SILHOUETTE      ///< CasterMesh::getExtrudable() with a Silhouette's indices. GLSL 3.30.
};

/// The whole text of one stage, with its version line: `glslVersion` is 330, or 400 or more; tess
/// needs that. Empty for a stage that the part has not.
OSGSHADOWVOLUME_EXPORT std::string volumeShaderText(VolumePart part, osg::Shader::Type stage,
                                                    int glslVersion);

/// Makes the program; nothing is compiled yet. One that is shown writes the uniform `osgsv_color`
/// where the multiplicity is not 0, instead of counts.
OSGSHADOWVOLUME_EXPORT osg::ref_ptr<osg::Program>
makeVolumeProgram(VolumePart part, int glslVersion, bool shown = false);

} // namespace osgShadowVolume
