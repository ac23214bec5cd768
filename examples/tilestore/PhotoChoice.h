// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ModelPhotos.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tilestore
{

/// Numbers of the photographs that a user has named: by path, by file name, as the model or as `names` has them.
/// None named: all. Throws UsageError for one that the model does not show.
std::vector<std::size_t> choosePhotos(const std::vector<osgPagedTexture::Photo>& photos,
                                      const std::vector<std::string>& names,
                                      const std::vector<std::string>& wanted);

} // namespace tilestore
