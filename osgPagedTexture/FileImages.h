// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ImageFile.h>

#include <osg/Image>
#include <osgDB/Options>

#include <deque>
#include <map>
#include <string>
#include <utility>

namespace osgPagedTexture
{

/// While it lives, image files that its thread reads through osgDB come as images of one texel,
/// with the name and the translucency of the file; their pixels are not decoded. Other threads read
/// as ever, and so does this one what is no ordinary picture: compressed and animated formats,
/// archives, what can't be read. They nest: the inner one takes all. At its end the Registry is as
/// it was.
class FileImages
{
public:
    FileImages();
    ~FileImages();
    FileImages(const FileImages&) = delete;
    FileImages& operator=(const FileImages&) = delete;

    /// What the model has to be read with: options with a read callback of their own would pass the
    /// images by.
    osg::ref_ptr<const osgDB::Options> optionsFor(const osgDB::Options* options) const;

    struct Found
    {
        std::string name; ///< As the model has it.
        std::string file; ///< Where it was found.
        ImageInfo info;
        osg::ref_ptr<osg::Image> image; ///< The one that the reader was given.
        osg::ref_ptr<const osgDB::Options> options;
    };
    /// What an image stands for, also one that a reader has made as its copy; null for any other.
    const Found* find(const osg::Image& image) const;

    /// Reads the file into an image that stands for it, as without paging.
    void restore(osg::Image& image, const Found& found) const;

    /// Restores what somebody still holds apart from this object.
    void restoreHeld() const;

    /// Of the thread; null where there is none.
    static FileImages* current();

    /// A new image for a file, or null where it has to be read as ever.
    osg::ref_ptr<osg::Image> standIn(const std::string& name, const osgDB::Options* options);

private:
    FileImages* const _outer;
    std::deque<Found> _found;
    std::map<std::pair<std::string, std::string>, std::size_t> _byName; ///< And by file.
};

/// What a paged texture has as its image: translucent or not, written to files as its name alone.
osg::ref_ptr<osg::Image> makeKeptStandIn(const std::string& name, bool translucent);

} // namespace osgPagedTexture
