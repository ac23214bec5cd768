// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/Pixels.h>

#include <osg/Texture2D>

#include <string>

namespace osgDB
{
class Options;
} // namespace osgDB

namespace osgPagedTexture
{

/// A texture whose texels lie in a tile store, of which a VirtualScene above loads what is seen.
///
/// Coordinates 0 to 1 are the whole picture, v up. Wrap modes and the maximum anisotropy count;
/// filters are linear, with all levels. Elsewhere than below a VirtualScene, under a model's own
/// program and below OpenGL 3.3 it shows its image: the coarsest page.
class OSGPAGEDTEXTURE_EXPORT VirtualTexture : public osg::Texture2D
{
public:
    VirtualTexture();
    explicit VirtualTexture(const std::string& store);
    /// Takes the parameters of a texture over.
    VirtualTexture(const osg::Texture2D& like, const std::string& store);
    VirtualTexture(const VirtualTexture& other,
                   const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);
    META_StateAttribute(osgPagedTexture, VirtualTexture, TEXTURE)

    /// By store and parameters.
    int compare(const osg::StateAttribute& other) const override;

    /// A packed store's file, a folder of LibVT's, or a .dzi file. Before it is drawn.
    void setStore(const std::string& store);
    const std::string& getStore() const { return _store; }

    /// Looks for the store in the options' folders and OSG's. False where it is not there.
    bool find(const osgDB::Options* options);
    /// Where find() found it, else the store's name.
    const std::string& getFile() const { return _file.empty() ? _store : _file; }

    /// Makes the coarsest page of getFile() the image; in the calling thread. Returns an empty
    /// string, or why the store can't be read: then the image is a grey texel.
    std::string loadImage();

    /// Puts another picture of the same size, and its levels, in the place of the image in one
    /// context. Uses unit 0; in the draw thread.
    void showPicture(osg::State& state, const Pixels& picture) const;

protected:
    ~VirtualTexture() override = default;

private:
    std::string _store;
    std::string _file;
};

} // namespace osgPagedTexture
