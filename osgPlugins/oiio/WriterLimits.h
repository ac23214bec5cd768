// SPDX-License-Identifier: MIT
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

namespace osgKitsOiio
{

/// The numbers of channels to offer a format (OpenImageIO's name) for an image that has count of
/// them, best first.
std::vector<int> channelCounts(const std::string& format, int count, bool formatHasAlpha);

/// Changes a picture's spec where OpenImageIO 2.4 would write a damaged file, or lose values that
/// the format can keep.
void avoidLosses(const std::string& format, OIIO::ImageSpec& spec);

/// Why OpenImageIO cannot write an image of 1 to 4 channels as such a file although it would say
/// that it did; empty where it can.
std::string refusalOf(const std::string& format, const std::string& name, int width, int height,
                      int channels);

} // namespace osgKitsOiio
