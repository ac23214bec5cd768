// SPDX-License-Identifier: MIT
#pragma once

#include "Picture.h"
#include "Sources.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

struct PictureSettings
{
    double bytes = 0.0; ///< Of all JPEG files together; 0 for what comes of it.
    int quality = 90;
    std::string folder; ///< That the names of pictures start at.
};

/// What lies on the disk.
struct PictureTotals
{
    unsigned int jpegs = 0, pngs = 0;
    double bytes = 0.0;  ///< Of JPEG files.
    double pixels = 0.0; ///< Of JPEG files.
};

/// Chooses the sizes of the pictures and writes them, on all cores. `progress` is called from all
/// of them, one at a time. The folder of the pictures must exist.
///
/// With settings.bytes the large ones are written first; what they took more or less than
/// expected, the smaller ones make up for. The same arguments give the same files on any number of
/// cores. Throws std::runtime_error where a file cannot be written or `bytes` cannot be reached.
PictureTotals writePictures(std::vector<Picture>& pictures, const std::vector<Source>& sources,
                            const PictureSettings& settings,
                            const std::function<void(const PictureTotals&)>& progress);
