// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/ModelPhotos.h>

#include <osg/Image>

#include <cstdint>
#include <string>
#include <vector>

namespace osgPagedTexture
{

struct AtlasModelSettings
{
    /// Of the tile store, relative to the model's file, with '/': what a virtual texture shows
    /// instead of the overview. User value "osgPagedTexture.store" of the textures.
    std::string store;
    /// A coarse picture of the atlas, for viewers that know no tile stores; null: none.
    osg::ref_ptr<osg::Image> overview;
    /// A drawable with a triangle that repeats its photograph more often keeps its own texture.
    std::int64_t mostRepeats = 256;
};

struct AtlasModelReport
{
    std::size_t drawables = 0;     ///< That have coordinates of the atlas now.
    std::size_t triangles = 0;     ///< Of theirs, before.
    std::size_t split = 0;         ///< Triangles that were cut at borders of repeats.
    std::size_t written = 0;       ///< Triangles after.
    std::size_t notFinite = 0;     ///< Triangles with a coordinate that is not finite.
    double largestRounding = 0.0;  ///< Of a texture coordinate, in pixels of the atlas.
    std::vector<LeftSurface> left; ///< Textures that some drawables keep.
};

/// Gives a model the coordinates of an atlas: texture unit 0 of every drawable that shows a
/// photograph of the layout has one texture for all. Wrapping, repeats, negative coordinates and
/// texture matrices are worked into the vertices by cutting triangles. `folder` is that of the
/// layout's file. The model is changed; drawables that have several photographs on several paths
/// are copied.
OSGPAGEDTEXTURE_EXPORT AtlasModelReport moveToAtlas(ModelPhotos& model, const AtlasLayout& layout,
                                                    const std::string& folder,
                                                    const AtlasModelSettings& settings);

/// Who is to show a model with coordinates of an atlas.
enum class AtlasModelViewer
{
    Kit,  ///< Where the format has classes of kits, a VirtualScene that finds its store by itself.
    Plain ///< Any viewer: the overview, and by the textures' user value the store.
};

/// Writes the model in the format of its name. For any viewer, OSG's own formats have the overview
/// inside, others in a file beside. Photographs that it still shows are named from its folder.
/// Older files are replaced when all is written. Throws ModelError, and TileStoreError where a file
/// cannot be written.
OSGPAGEDTEXTURE_EXPORT void writeAtlasModel(const ModelPhotos& model, const std::string& path,
                                            AtlasModelViewer viewer = AtlasModelViewer::Kit);

} // namespace osgPagedTexture
