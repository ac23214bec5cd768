// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace support
{

/// A fresh folder that is removed, with all in it, at the end.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& getPath() const { return _path; }

    /// Absolute path of a file in it, which need not exist.
    std::string file(const std::string& name) const { return (_path / name).string(); }

    /// Writes a file into it and returns its path.
    std::string write(const std::string& name, const std::string& content) const;

private:
    std::filesystem::path _path;
};

} // namespace support
