// SPDX-License-Identifier: MIT
#include "Output.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>
#include <osgDB/fstream>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace osgrender
{

namespace
{

/// The first frame number's place in a pattern: "%d" or "%0<digits>d".
struct Place
{
    std::size_t begin = std::string::npos;
    std::size_t end = std::string::npos;
    std::size_t digits = 0;
};

Place findPlace(const std::string& pattern, std::size_t from = 0)
{
    Place place;
    for (std::size_t i = from; i + 1 < pattern.size(); ++i)
    {
        if (pattern[i] != '%')
            continue;
        if (pattern[i + 1] == '%')
        {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        while (end < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[end])))
            ++end;
        if (end < pattern.size() && pattern[end] == 'd' && end - i <= 3)
        {
            place.begin = i;
            place.end = end + 1;
            place.digits = end > i + 1 ? std::stoul(pattern.substr(i + 1, end - i - 1)) : 0;
        }
        return place;
    }
    return place;
}

std::string unescape(const std::string& text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        result += text[i];
        if (text[i] == '%' && i + 1 < text.size() && text[i + 1] == '%')
            ++i;
    }
    return result;
}

osg::ref_ptr<osg::Image> toBytes(const osg::Image& picture)
{
    osg::ref_ptr<osg::Image> bytes = new osg::Image;
    bytes->allocateImage(picture.s(), picture.t(), 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < picture.t(); ++y)
    {
        const auto* from =
            reinterpret_cast<const float*>(picture.data(0, static_cast<unsigned>(y)));
        unsigned char* to = bytes->data(0, static_cast<unsigned>(y));
        for (int i = 0; i < 3 * picture.s(); ++i)
        {
            // A NaN is compared false both times and becomes 0.
            const float value = from[i] > 0.0f ? std::min(from[i], 1.0f) : 0.0f;
            to[i] = static_cast<unsigned char>(std::lround(255.0f * value));
        }
    }
    return bytes;
}

/// Radiance files through OpenImageIO: OSG's own writer swaps width and height in the header.
osgDB::ReaderWriter::WriteResult writeRadiance(const osg::Image& picture, const std::string& file)
{
    osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("rgbe");
    if (!writer)
        return osgDB::ReaderWriter::WriteResult("the plugin osgdb_rgbe can't be loaded");
    osgDB::ofstream stream(file.c_str(), std::ios::binary);
    if (!stream)
        return osgDB::ReaderWriter::WriteResult(std::strerror(errno));
    const osg::ref_ptr<osg::Image> named = new osg::Image(picture);
    named->setFileName("picture.rgbe");
    const osgDB::ReaderWriter::WriteResult result = writer->writeImage(*named, stream, nullptr);
    stream.close();
    return stream ? result : osgDB::ReaderWriter::WriteResult(std::strerror(errno));
}

bool makeFolder(const std::string& file, std::string& error)
{
    const std::string folder = osgDB::getFilePath(file);
    if (folder.empty() || osgDB::makeDirectory(folder))
        return true;
    error = "can't make the folder '" + folder + "': " + std::strerror(errno);
    return false;
}

} // namespace

std::string checkPattern(const std::string& pattern)
{
    const Place place = findPlace(pattern);
    const std::size_t percent = unescape(pattern).find('%');
    if (place.begin != std::string::npos &&
        findPlace(pattern, place.end).begin != std::string::npos)
        return "'" + pattern + "' has two frame numbers";
    if (place.begin == std::string::npos && percent != std::string::npos &&
        pattern.find("%%") == std::string::npos)
        return "'" + pattern + "': a frame number is written %d or %03d, a percent sign %%";
    if (osgDB::getFileExtension(pattern).empty())
        return "'" + pattern + "' has no extension that names the format";
    return std::string();
}

std::string fileOfFrame(const std::string& pattern, int frame)
{
    const Place place = findPlace(pattern);
    if (place.begin == std::string::npos)
        return unescape(pattern);
    std::string number = std::to_string(frame);
    if (number.size() < place.digits)
        number.insert(0, place.digits - number.size(), '0');
    return unescape(pattern.substr(0, place.begin)) + number + unescape(pattern.substr(place.end));
}

bool hasFrameNumber(const std::string& pattern)
{
    return findPlace(pattern).begin != std::string::npos;
}

bool checkOutputs(const Arguments& arguments, std::string& error)
{
    if (!arguments.drawsFrames() && !arguments.probe.isAsked())
        error =
            "nothing to do: give -o, --stats, --list-plan, --reference, --probe or --probe-grid";
    if (!arguments.probe.csv.empty() && arguments.probe.grids.empty())
        error = "--probe-csv goes with --probe-grid";
    for (const std::string& output : arguments.outputs)
    {
        const std::string extension = osgDB::getLowerCaseFileExtension(output);
        if (!osgDB::Registry::instance()->getReaderWriterForExtension(extension))
            error = "-o '" + output + "': no plugin writes '." + extension + "'";
        else if (arguments.floatPixels && !isFloatFile(output, arguments))
            error = "--float: '" + output + "' can't hold float pixels (exr, hdr and tif can)";
    }
    return error.empty();
}

bool isFloatFile(const std::string& file, const Arguments& arguments)
{
    const std::string extension = osgDB::getLowerCaseFileExtension(file);
    const bool tiff = extension == "tif" || extension == "tiff";
    return extension == "exr" || extension == "hdr" || (tiff && arguments.floatPixels);
}

bool writePicture(const osg::Image& picture, const std::string& file, bool asFloat,
                  std::string& error)
{
    if (!makeFolder(file, error))
        return false;
    osg::ref_ptr<const osg::Image> written = &picture;
    if (picture.getDataType() == GL_FLOAT && !asFloat)
        written = toBytes(picture);
    osgDB::Registry* registry = osgDB::Registry::instance();
    const osgDB::ReaderWriter::WriteResult result =
        osgDB::getLowerCaseFileExtension(file) == "hdr"
            ? writeRadiance(*written, file)
            : registry->writeImage(*written, file, registry->getOptions());
    if (result.success())
        return true;
    error = "can't write '" + file + "'";
    if (!result.message().empty())
        error += ": " + result.message();
    return false;
}

std::string differenceFile(const Arguments& arguments)
{
    if (!arguments.difference.empty())
        return arguments.difference;
    const std::string name = arguments.outputs.empty()
                                 ? osgDB::getSimpleFileName(arguments.reference)
                                 : fileOfFrame(arguments.outputs.back(), arguments.frames - 1);
    return osgDB::getNameLessExtension(name) + ".difference.png";
}

} // namespace osgrender
