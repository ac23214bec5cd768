// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ImageFile.h>

namespace osgPagedTexture
{

ImageError::ImageError(Kind kind, const std::string& path, const std::string& causeAndRemedy)
    : std::runtime_error("'" + path + "': " + causeAndRemedy), _kind(kind)
{
}

} // namespace osgPagedTexture
