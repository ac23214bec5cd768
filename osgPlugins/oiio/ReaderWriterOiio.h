// SPDX-License-Identifier: MIT
#pragma once

#include <osgPlugins/oiio/Formats.h>

#include <osgDB/ReaderWriter>

namespace osgKitsOiio
{

/// Reads and writes images through OpenImageIO, for the file name extensions that it is made with.
///
/// ImageDecoder.h and ImageEncoder.h say what becomes of the pixels, Settings.h which options
/// there are. Any number of threads may read and write at once.
class ReaderWriterOiio : public osgDB::ReaderWriter
{
public:
    explicit ReaderWriterOiio(const ExtensionMap& extensions = {});

    const char* className() const override { return "OpenImageIO reader and writer"; }

    /// FILE_NOT_HANDLED for other extensions, FILE_NOT_FOUND, or a message where the file is
    /// damaged.
    ReadResult readImage(const std::string& fileName, const Options* options) const override;
    ReadResult readObject(const std::string& fileName, const Options* options) const override;

    /// The format is told by the bytes, whatever the extensions of this reader. The stream is read
    /// to its end.
    ReadResult readImage(std::istream& stream, const Options* options) const override;
    ReadResult readObject(std::istream& stream, const Options* options) const override;

    WriteResult writeImage(const osg::Image& image, const std::string& fileName,
                           const Options* options) const override;
    WriteResult writeObject(const osg::Object& object, const std::string& fileName,
                            const Options* options) const override;

    /// The format is that of the option oiio.format, or else of the extension of the image's file
    /// name.
    WriteResult writeImage(const osg::Image& image, std::ostream& stream,
                           const Options* options) const override;
    WriteResult writeObject(const osg::Object& object, std::ostream& stream,
                            const Options* options) const override;

protected:
    ~ReaderWriterOiio() override = default;

private:
    /// OpenImageIO's name of the format of a file; empty where this reader has not its extension.
    std::string formatOf(const std::string& fileName) const;

    const ExtensionMap _extensions;
};

} // namespace osgKitsOiio
