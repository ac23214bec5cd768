// SPDX-License-Identifier: MIT
#pragma once

#include <osgPlugins/oiio/Settings.h>

#include <OpenImageIO/imageio.h>

#include <osgDB/ReaderWriter>

namespace osgKitsOiio
{

/// Opens and decodes a picture of one format (OpenImageIO's name). The proxy, where not null, holds
/// the file's bytes and name only serves the messages.
///
/// The picture has 1 to 4 channels of the file's own type and stands upright; of a mip-mapped file
/// it is the largest level, of a file with a smaller data window that window. Colours are as
/// stored: neither linearized nor multiplied by alpha. A volume gives an image with r() > 1.
osgDB::ReaderWriter::ReadResult decodeImage(const std::string& format, const std::string& name,
                                            OIIO::Filesystem::IOProxy* proxy,
                                            const Settings& settings);

} // namespace osgKitsOiio
