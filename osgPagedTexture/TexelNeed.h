// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace osgPagedTexture
{

/// A textured surface in coordinates of its own, as far as that decides how fine its texture has to
/// be.
struct TexelSurface
{
    glm::dvec3 low{0.0};  ///< Box of the surface.
    glm::dvec3 high{0.0}; ///< Below `low` in a component: the box is not known.
    /// Area in texture coordinates over area of the surface, of where the texture is stretched the
    /// most. 0 or not finite: not known, any level may be needed.
    double uvDensity = 0.0;
    glm::dvec3 axis{0.0}; ///< Middle of the normals, of length 1; 0: they point anywhere.
    double spread = 0.0;  ///< Largest angle between a normal, or its opposite, and `axis`, radians.
};

/// Who looks at it.
struct TexelView
{
    glm::dmat4 toEye{1.0}; ///< From the surface's coordinates to those of the eye, affine.
    glm::dvec3 moved{0.0}; ///< Where the eye is asked for, in eye coordinates; 0 for where it is.
    double pixelsX = 0.0;  ///< Pixels of a unit at distance 1; of a unit where rays are parallel.
    double pixelsY = 0.0;  ///< As `pixelsX`, upwards.
    bool isParallel = false;
    double corner = 1.0; ///< 1 / cosine of the widest angle that a ray has with the middle one.
};

/// Pixels that one whole texture covers where the surface shows it largest, at most. Never NaN;
/// infinite where there is no bound, such as for a surface that the eye is in.
OSGPAGEDTEXTURE_EXPORT double pixelsOfTexture(const TexelSurface& surface, const TexelView& view);

/// What of a texture decides which level GL takes.
struct TexelTexture
{
    int width = 1;           ///< Texels of level 0.
    int height = 1;          ///< Texels of level 0.
    double anisotropy = 1.0; ///< Largest ratio that the filter allows.
    double bias = 0.0;       ///< Levels that the texture adds, GL_TEXTURE_LOD_BIAS.
};

/// The level of a texture of which all lies on one pixel, before it is clamped.
OSGPAGEDTEXTURE_EXPORT double levelOnOnePixel(const TexelTexture& texture);

/// The level that GL looks at where a whole texture covers `pixels`: no finer one is used. From 0
/// to the last level, with a fraction; 0 for NaN.
OSGPAGEDTEXTURE_EXPORT double neededLevel(const TexelTexture& texture, double pixels);

} // namespace osgPagedTexture
