// SPDX-License-Identifier: MIT
#pragma once

#include <OpenImageIO/typedesc.h>

#include <cstdint>
#include <map>
#include <string>

namespace osgDB
{
class Options;
}

namespace osgKitsOiio
{

/// What a caller asked for in osgDB's option string, as words oiio.name=value.
struct Settings
{
    int subimage = 0;   ///< Part, page, layer or frame to read; 0 or more.
    std::string format; ///< Format of a stream, OpenImageIO's name; empty: find out.
    std::uint64_t maxBytes = 2047ull << 20; ///< A picture with more decoded bytes is refused.
    int quality = 0;         ///< Of lossy encoders, 1 to 100; 0: OpenImageIO's default.
    std::string compression; ///< As the format names it; empty: its default.
    OIIO::TypeDesc type =
        OIIO::TypeUnknown; ///< Pixel type to read as or to write; unknown: as it is.
};

/// Fills the settings from the options (which may be null) and returns true, or returns false
/// with one line in error that names the bad word. Words of other plugins are passed over.
bool parseSettings(const osgDB::Options* options, Settings& settings, std::string& error);

/// Each option with its description, for osgDB's listing of a plugin.
const std::map<std::string, std::string>& describeSettings();

} // namespace osgKitsOiio
