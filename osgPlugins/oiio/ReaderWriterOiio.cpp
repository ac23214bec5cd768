// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/ReaderWriterOiio.h>

#include <osgPlugins/oiio/FileCheck.h>
#include <osgPlugins/oiio/ImageDecoder.h>
#include <osgPlugins/oiio/ImageEncoder.h>
#include <osgPlugins/oiio/Report.h>
#include <osgPlugins/oiio/Settings.h>
#include <osgPlugins/oiio/TemporaryFile.h>

#include <OpenImageIO/filesystem.h>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <iterator>

namespace osgKitsOiio
{

namespace
{

const char StreamName[] = "stream";

/// A name for OpenImageIO, whose JPEG 2000 coder tells its two kinds by the extension.
std::string streamName(const std::string& extension)
{
    return StreamName + ("." + extension);
}

std::string lookUp(const ExtensionMap& extensions, const std::string& extension)
{
    const auto found = extensions.find(extension);
    return found == extensions.end() ? std::string() : found->second;
}

bool supportsMemory(const std::string& format, bool writing)
{
    if (writing)
    {
        const auto output = OIIO::ImageOutput::create(format);
        return output && output->supports("ioproxy");
    }
    const auto input = OIIO::ImageInput::create(format);
    return input && input->supports("ioproxy");
}

std::string readAll(const std::string& path)
{
    osgDB::ifstream file(path.c_str(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Decodes a file, by way of its bytes where OpenImageIO has to be kept from damaged ones.
osgDB::ReaderWriter::ReadResult decodeFile(const std::string& format, const std::string& path,
                                           const Settings& settings)
{
    if (!isCheckedForDamage(format))
    {
        return decodeImage(format, path, nullptr, settings);
    }
    const std::string bytes = readAll(path);
    const std::string damage = findDamage(format, bytes);
    if (!damage.empty())
    {
        return osgDB::ReaderWriter::ReadResult(failure(path, damage));
    }
    const std::string png = format == "ico" && !settings.subimage ? extractPng(bytes) : "";
    if (png.empty())
    {
        return decodeImage(format, path, nullptr, settings);
    }
    OIIO::Filesystem::IOMemReader reader(png.data(), png.size());
    return decodeImage("png", path, &reader, settings);
}

/// Decodes a file in memory whose format is known.
osgDB::ReaderWriter::ReadResult decodeBytes(const std::string& format, const std::string& bytes,
                                            const Settings& settings)
{
    if (supportsMemory(format, false) && !isCheckedForDamage(format))
    {
        OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
        return decodeImage(format, streamName(usualExtension(format)), &reader, settings);
    }
    const TemporaryFile file(usualExtension(format));
    osgDB::ofstream(file.getName().c_str(), std::ios::binary) << bytes;
    return decodeFile(format, file.getName(), settings);
}

bool opensAs(const std::string& format, const std::string& bytes)
{
    if (!findDamage(format, bytes).empty())
    {
        return false;
    }
    OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
    const auto input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    const bool opened = input && input->set_ioproxy(&reader) &&
                        input->open(streamName(usualExtension(format)), spec, OIIO::ImageSpec());
    if (!opened && input)
    {
        takeError(*input);
    }
    return opened;
}

/// The format of a file in memory; empty where OpenImageIO knows none.
std::string detectFormat(const std::string& bytes)
{
    for (const std::string& format : formatsReadFromMemory())
    {
        if (opensAs(format, bytes))
        {
            return format;
        }
    }
    const TemporaryFile file("");
    osgDB::ofstream(file.getName().c_str(), std::ios::binary) << bytes;
    const auto input = OIIO::ImageInput::open(file.getName());
    OIIO::geterror();
    return input ? input->format_name() : "";
}

} // namespace

ReaderWriterOiio::ReaderWriterOiio(const ExtensionMap& extensions) : _extensions(extensions)
{
    for (const auto& [extension, format] : extensions)
    {
        supportsExtension(extension, format + " by OpenImageIO");
    }
    for (const auto& [name, description] : describeSettings())
    {
        supportsOption(name, description);
    }
}

std::string ReaderWriterOiio::formatOf(const std::string& fileName) const
{
    return lookUp(_extensions, osgDB::getLowerCaseFileExtension(fileName));
}

osgDB::ReaderWriter::ReadResult ReaderWriterOiio::readImage(const std::string& fileName,
                                                            const Options* options) const
{
    const std::string format = formatOf(fileName);
    if (format.empty())
    {
        return ReadResult::FILE_NOT_HANDLED;
    }
    const std::string path = osgDB::findDataFile(fileName, options);
    if (path.empty())
    {
        return ReadResult::FILE_NOT_FOUND;
    }
    Settings settings;
    std::string error;
    if (!parseSettings(options, settings, error))
    {
        return ReadResult(error);
    }
    ReadResult result = decodeFile(format, path, settings);
    if (result.validImage())
    {
        result.getImage()->setFileName(fileName);
    }
    return result;
}

osgDB::ReaderWriter::ReadResult ReaderWriterOiio::readObject(const std::string& fileName,
                                                             const Options* options) const
{
    return readImage(fileName, options);
}

osgDB::ReaderWriter::ReadResult ReaderWriterOiio::readImage(std::istream& stream,
                                                            const Options* options) const
{
    Settings settings;
    std::string error;
    if (!parseSettings(options, settings, error))
    {
        return ReadResult(error);
    }
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    const std::string format = settings.format.empty() ? detectFormat(bytes) : settings.format;
    if (format.empty())
    {
        return ReadResult(failure(StreamName, "no format that OpenImageIO knows"));
    }
    return decodeBytes(format, bytes, settings);
}

osgDB::ReaderWriter::ReadResult ReaderWriterOiio::readObject(std::istream& stream,
                                                             const Options* options) const
{
    return readImage(stream, options);
}

osgDB::ReaderWriter::WriteResult ReaderWriterOiio::writeImage(const osg::Image& image,
                                                              const std::string& fileName,
                                                              const Options* options) const
{
    const std::string format = formatOf(fileName);
    if (format.empty())
    {
        return WriteResult::FILE_NOT_HANDLED;
    }
    if (!isWritable(format))
    {
        return WriteResult(failure(fileName, "OpenImageIO reads but does not write " + format));
    }
    Settings settings;
    std::string error;
    if (!parseSettings(options, settings, error))
    {
        return WriteResult(error);
    }
    return encodeImage(image, format, fileName, nullptr, settings);
}

osgDB::ReaderWriter::WriteResult ReaderWriterOiio::writeObject(const osg::Object& object,
                                                               const std::string& fileName,
                                                               const Options* options) const
{
    const auto image = dynamic_cast<const osg::Image*>(&object);
    return image ? writeImage(*image, fileName, options) : WriteResult::FILE_NOT_HANDLED;
}

osgDB::ReaderWriter::WriteResult ReaderWriterOiio::writeImage(const osg::Image& image,
                                                              std::ostream& stream,
                                                              const Options* options) const
{
    Settings settings;
    std::string error;
    if (!parseSettings(options, settings, error))
    {
        return WriteResult(error);
    }
    std::string format = settings.format;
    std::string extension = usualExtension(format);
    if (format.empty())
    {
        extension = osgDB::getLowerCaseFileExtension(image.getFileName());
        format = lookUp(readableExtensions(), extension);
    }
    if (!isWritable(format))
    {
        return WriteResult(failure(StreamName, "no format to write ('" + format +
                                                   "'); set the option oiio.format"));
    }
    if (supportsMemory(format, true))
    {
        OIIO::Filesystem::IOVecOutput memory;
        const WriteResult result =
            encodeImage(image, format, streamName(extension), &memory, settings);
        const auto& bytes = memory.buffer();
        stream.write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return result.success() && !stream ? WriteResult(failure(StreamName, "cannot be written"))
                                           : result;
    }
    const TemporaryFile file(extension);
    const WriteResult result = encodeImage(image, format, file.getName(), nullptr, settings);
    if (result.success())
    {
        stream << osgDB::ifstream(file.getName().c_str(), std::ios::binary).rdbuf();
    }
    return result.success() && !stream ? WriteResult(failure(StreamName, "cannot be written"))
                                       : result;
}

osgDB::ReaderWriter::WriteResult ReaderWriterOiio::writeObject(const osg::Object& object,
                                                               std::ostream& stream,
                                                               const Options* options) const
{
    const auto image = dynamic_cast<const osg::Image*>(&object);
    return image ? writeImage(*image, stream, options) : WriteResult::FILE_NOT_HANDLED;
}

} // namespace osgKitsOiio
