// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSurface.h>

#include <osg/Node>
#include <osg/Texture>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace osgPagedTexture
{

class FileImages;

/// A model can't be read or written: one line with file, cause and remedy.
class OSGPAGEDTEXTURE_EXPORT ModelError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// A model and the photographs on it.
struct OSGPAGEDTEXTURE_EXPORT ModelPhotos
{
    osg::ref_ptr<osg::Node> model; ///< Its images of files are stand-ins of one texel.
    std::vector<Photo> photos;     ///< In the order in which the model has them, each file once.
    std::vector<LeftSurface> left;
    std::shared_ptr<const FileImages> images; ///< What the stand-ins stand for.
};

/// Reads a model of any format that OSG reads. No photograph is decoded. All texture units count;
/// children that a Switch or LOD hides too. `withPlaces`: PhotoSurface::places are filled. Throws
/// ModelError. To be called and destroyed in the same thread.
OSGPAGEDTEXTURE_EXPORT ModelPhotos readModelPhotos(const std::string& path,
                                                   bool withPlaces = false);

/// The same of a graph in memory; `images` may be null.
OSGPAGEDTEXTURE_EXPORT void collectPhotos(ModelPhotos& photos, bool withPlaces);

/// The file of a texture's image, absolute; empty where it has none. `images` may be null.
std::string photoFileOf(const osg::Texture& texture, const FileImages* images);

PhotoWrap wrapOf(const osg::Texture& texture, osg::Texture::WrapParameter side);

} // namespace osgPagedTexture
