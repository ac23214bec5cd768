// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>

#include <osg/StateSet>
#include <osg/Texture2D>

#include <string>
#include <vector>

namespace osgPagedTexture
{

/// What a texture's texels are, which decides how they are averaged and kept.
enum class TextureUse
{
    Color,
    Data,     ///< Numbers, such as heights.
    Normals,  ///< Of length 1, 0 to 255 for -1 to 1.
    NormalsXY ///< The same; who uses them computes the third component.
};

/// Where a texture is used in a graph.
struct TextureSite
{
    std::vector<const osg::StateSet*> path; ///< From the root to the one that has it.
    unsigned int unit = 0;
    int bumpUnit = -1; ///< That a reader or an effect keeps for relief; -1: not known.
};

/// What is known of a texture's picture.
struct TexturePicture
{
    std::string name; ///< As the model has it, or that of its file.
    int channels = 3; ///< As Pixels::channels.
};

/// How a texture is used: as its user value "osgPagedTexture.use" says ("color", "data", "normals",
/// "normalsxy"); else as the sampler of its unit is called, or as the texture environment takes it;
/// else by the unit of a reader for relief; else by its name. A picture of one channel that is said
/// to be relief holds heights, which are data.
OSGPAGEDTEXTURE_EXPORT TextureUse useOf(const osg::Texture2D& texture, const TextureSite& site,
                                        const TexturePicture& picture);

/// Whether the last word of a file's name, numbers and sizes apart, says normal map:
/// "wall_normal.png", "WallNormalGL-2k.jpg", "wall_nrm.tga". `isShortToo`: "wall_n.png", too.
OSGPAGEDTEXTURE_EXPORT bool isNamedNormalMap(const std::string& name, bool isShortToo);

} // namespace osgPagedTexture
