// SPDX-License-Identifier: MIT
#include <support/TemporaryFolder.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace support
{

TemporaryFolder::TemporaryFolder()
{
    // mkdtemp() puts letters of its own for six X at the end.
    const std::string name = "osgkits." + std::string(6, 'X');
    std::string pattern = (std::filesystem::temp_directory_path() / name).string();
    if (!mkdtemp(pattern.data()))
        throw std::runtime_error("no folder can be made for " + pattern);
    _path = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(_path, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const
{
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
}

} // namespace support
