// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/Settings.h>

#include <osgDB/Options>

#include <charconv>
#include <sstream>

namespace osgKitsOiio
{

namespace
{

// An osg::Image counts its bytes in 32 bits.
constexpr int MaxMegabytes = 4095;

bool parseNumber(const std::string& text, int low, int high, int& number)
{
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    return failure == std::errc() && stop == end && number >= low && number <= high;
}

bool parseType(const std::string& text, OIIO::TypeDesc& type)
{
    static const std::map<std::string, OIIO::TypeDesc> types = {{"uint8", OIIO::TypeDesc::UINT8},
                                                                {"uint16", OIIO::TypeDesc::UINT16},
                                                                {"half", OIIO::TypeDesc::HALF},
                                                                {"float", OIIO::TypeDesc::FLOAT}};
    const auto found = types.find(text);
    if (found != types.end())
    {
        type = found->second;
    }
    return found != types.end();
}

/// Whether the name is known; valid tells of the value.
bool assign(const std::string& name, const std::string& value, Settings& settings, bool& valid)
{
    valid = !value.empty();
    if (name == "subimage")
    {
        valid = parseNumber(value, 0, 1 << 30, settings.subimage);
    }
    else if (name == "format")
    {
        settings.format = value;
    }
    else if (name == "maxMegabytes")
    {
        int megabytes = 0;
        valid = parseNumber(value, 1, MaxMegabytes, megabytes);
        settings.maxBytes = static_cast<std::uint64_t>(megabytes) << 20;
    }
    else if (name == "quality")
    {
        valid = parseNumber(value, 1, 100, settings.quality);
    }
    else if (name == "compression")
    {
        settings.compression = value;
    }
    else if (name == "type")
    {
        valid = parseType(value, settings.type);
    }
    else
    {
        return false;
    }
    return true;
}

} // namespace

bool parseSettings(const osgDB::Options* options, Settings& settings, std::string& error)
{
    if (!options)
    {
        return true;
    }
    std::istringstream words(options->getOptionString());
    const std::string prefix = "oiio.";
    for (std::string word; words >> word;)
    {
        if (word.compare(0, prefix.size(), prefix) != 0)
        {
            continue;
        }
        const auto equals = std::min(word.find('='), word.size());
        const std::string name = word.substr(prefix.size(), equals - prefix.size());
        const std::string value = word.substr(std::min(equals + 1, word.size()));
        bool valid = false;
        if (!assign(name, value, settings, valid))
        {
            error = "osgdb_oiio: unknown option '" + word +
                    "'; 'osgconv --format exr' lists the options";
            return false;
        }
        if (!valid)
        {
            error = "osgdb_oiio: bad value in option '" + word +
                    "': " + describeSettings().at(prefix + name);
            return false;
        }
    }
    return true;
}

const std::map<std::string, std::string>& describeSettings()
{
    static const std::map<std::string, std::string> descriptions = {
        {"oiio.subimage", "=N: part, page, layer or frame to read, from 0"},
        {"oiio.format", "=NAME: format of a stream, e.g. openexr (default: found out when reading, "
                        "by the image's file name when writing)"},
        {"oiio.maxMegabytes", "=N: refuse pictures that are larger once decoded, 1 to 4095 (2047)"},
        {"oiio.quality", "=N: quality of lossy encoders, 1 to 100"},
        {"oiio.compression", "=NAME: e.g. zip, piz, dwaa (exr), lzw (tif)"},
        {"oiio.type",
         "=uint8|uint16|half|float: pixel type to read as or to write (default: as it is)"}};
    return descriptions;
}

} // namespace osgKitsOiio
