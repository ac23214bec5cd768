// SPDX-License-Identifier: MIT
#pragma once

#include "Arguments.h"

#include <osg/Image>

#include <string>

namespace osgrender
{

/// Why a -o name is no usable pattern, else "". It holds at most one %d or %0<digits>d; %% is a %.
std::string checkPattern(const std::string& pattern);

/// The file of a frame: "a%03d.png" and 7 give "a007.png".
std::string fileOfFrame(const std::string& pattern, int frame);

/// Whether the file names change from frame to frame.
bool hasFrameNumber(const std::string& pattern);

/// Checks that each output has a plugin that writes it and that something is asked for at all.
bool checkOutputs(const Arguments& arguments, std::string& error);

/// Whether an output is written with float pixels: EXR and HDR always, TIFF with --float.
bool isFloatFile(const std::string& file, const Arguments& arguments);

/// Writes the picture, making its folder. Float pixels are clamped and rounded for files of 8 bits.
bool writePicture(const osg::Image& picture, const std::string& file, bool asFloat,
                  std::string& error);

/// Where the difference picture goes when --difference does not say it: beside the last output, or
/// into the current folder, as <name>.difference.png.
std::string differenceFile(const Arguments& arguments);

} // namespace osgrender
