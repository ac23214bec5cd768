// SPDX-License-Identifier: MIT
#pragma once

#include "Subcommand.h"

#include <osgPagedTexture/ModelPhotos.h>

#include <string>

namespace tilestore
{

/// Lets OSG find the suite's plugins beside this program, in the build tree and installed, and
/// keeps its messages out of standard output.
void prepareOsg();

/// Reads a model and its photographs; says on standard error what of its textures is left out.
osgPagedTexture::ModelPhotos readModel(const std::string& path, bool withPlaces = false);

/// Throws std::runtime_error where a photograph is inside of the model and no file, which can be
/// edited and read again; it says what to do.
void requireFiles(const osgPagedTexture::ModelPhotos& model, const std::string& path);

/// What was left out, for JSON.
Json leftOf(const osgPagedTexture::ModelPhotos& model);

} // namespace tilestore
