// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/ContentHash.h>

#include <cstdint>
#include <string>

namespace osgPagedTexture
{

struct FileHead
{
    std::string bytes; ///< The first ones, fewer than asked for where the file is shorter.
    std::uint64_t fileBytes = 0;
};

/// Reads the first `count` bytes of a regular file. Throws ImageError, also for an empty file.
FileHead readFileHead(const std::string& path, std::size_t count);

/// Reads a whole regular file. Throws ImageError, also where it shrinks meanwhile.
std::string readFileBytes(const std::string& path);

struct FileHash
{
    ContentHash content;
    std::uint64_t fileBytes = 0;
};

/// Hashes a regular file of any size, a MiB at a time. Throws ImageError as readFileBytes() does.
FileHash hashFile(const std::string& path);

} // namespace osgPagedTexture
