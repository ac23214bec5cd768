// SPDX-License-Identifier: MIT
// What an embedding application does: a PagedScene over a textured model, saved and read back.
#include <osgPagedTexture/PagedKeys.h>
#include <osgPagedTexture/PagedOptions.h>
#include <osgPagedTexture/PagedScene.h>

#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cstdio>

using osgPagedTexture::PagedScene;

int main(int argc, char** argv)
{
    if (argc != 2)
        return std::fprintf(stderr, "usage: consumer_paged file.osgt\n"), 2;
    osgPagedTexture::PagedSettings settings;
    std::string error;
    if (!setPagedOption(settings, "gpu", "64", error) || osgPagedTexture::pagedKeys().empty())
        return std::fprintf(stderr, "%s\n", error.c_str()), 1;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(128, 128, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(77));
    osg::ref_ptr<osg::Geometry> wall = osg::createTexturedQuadGeometry(
        osg::Vec3(), osg::Vec3(1.0f, 0.0f, 0.0f), osg::Vec3(0.0f, 0.0f, 1.0f));
    wall->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(image));
    osg::ref_ptr<PagedScene> scene = osgPagedTexture::install(*wall, settings);
    if (scene->getStatistics().textures != 1 || !osgDB::writeNodeFile(*scene, argv[1]))
        return std::fprintf(stderr, "no texture is paged, or %s can't be written\n", argv[1]), 1;
    osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(argv[1]);
    auto* paged = dynamic_cast<PagedScene*>(read.get());
    if (!paged || paged->getSettingsText() != "gpu='64'" || paged->getNumChildren() != 1)
        return std::fprintf(stderr, "%s did not come back as it was written\n", argv[1]), 1;
    // The pseudo-loader, too, is found in the installation.
    osg::ref_ptr<osg::Node> wrapped =
        osgDB::readRefNodeFile(std::string(argv[1]) + ".(upload=1).pagedtexture");
    paged = dynamic_cast<PagedScene*>(wrapped.get());
    if (!paged || paged->getSettingsText() != "upload='1'")
        return std::fprintf(stderr, "no PagedScene of the suffix\n"), 1;
    return 0;
}
