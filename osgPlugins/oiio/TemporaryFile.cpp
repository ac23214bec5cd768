// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/TemporaryFile.h>

#include <OpenImageIO/filesystem.h>

namespace osgKitsOiio
{

TemporaryFile::TemporaryFile(const std::string& extension)
    : _name(OIIO::Filesystem::temp_directory_path() + "/" +
            OIIO::Filesystem::unique_path("osgdb_oiio-%%%%-%%%%-%%%%-%%%%"))
{
    if (!extension.empty())
    {
        _name += "." + extension;
    }
}

TemporaryFile::~TemporaryFile()
{
    if (OIIO::Filesystem::exists(_name))
    {
        OIIO::Filesystem::remove(_name);
    }
}

} // namespace osgKitsOiio
