// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace osgKitsOiio
{

/// The name of a file in the system's folder for temporary files; removed with this object.
/// For the formats that OpenImageIO cannot read from or write to memory.
class TemporaryFile
{
public:
    /// Makes no file. The extension comes without its dot and may be empty.
    explicit TemporaryFile(const std::string& extension);

    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& getName() const { return _name; }

private:
    std::string _name;
};

} // namespace osgKitsOiio
