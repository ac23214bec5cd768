// SPDX-License-Identifier: MIT
#pragma once

#include <osgPlugins/oiio/Settings.h>

#include <OpenImageIO/imageio.h>

#include <osgDB/ReaderWriter>

namespace osgKitsOiio
{

/// Encodes an image in a format (OpenImageIO's name) to the file name, or to the proxy where that
/// is not null. Pixels keep their type where the format has it, else take its best one.
///
/// A format without alpha loses it, and one without luminance gets three equal channels.
/// Refused with a reason: volumes, compressed and packed pixels, images without pixels.
/// A new file that could not be finished is removed.
osgDB::ReaderWriter::WriteResult encodeImage(const osg::Image& image, const std::string& format,
                                             const std::string& name,
                                             OIIO::Filesystem::IOProxy* proxy,
                                             const Settings& settings);

} // namespace osgKitsOiio
