// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>

#include <map>
#include <mutex>
#include <string>

namespace osgPagedTexture
{

/// Pictures that came with a model and have no file: kept in a temporary folder of this process, so
/// that they can be read again like any other. Any thread.
class EmbeddedImages
{
public:
    /// Images with fewer texels stay in memory.
    static constexpr int LeastTexels = 64 * 64;

    EmbeddedImages() = default;
    ~EmbeddedImages(); ///< Removes the folder.
    EmbeddedImages(const EmbeddedImages&) = delete;
    EmbeddedImages& operator=(const EmbeddedImages&) = delete;

    /// Why an image has to stay in memory; empty where keep() can take it.
    static std::string obstacle(const osg::Image& image);

    /// Writes it and returns the file; equal images have one. Empty where nothing can be written.
    std::string keep(const osg::Image& image);

    /// What keep() has written, in the pixel format that the image had; null where the file is
    /// gone.
    static osg::ref_ptr<osg::Image> read(const std::string& file, GLenum format);

private:
    std::mutex _mutex;
    std::string _folder;
};

} // namespace osgPagedTexture
