// SPDX-License-Identifier: MIT
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace osgKitsOiio
{

/// One line: who, which file, why. Line breaks in the reason become "; ".
inline std::string failure(const std::string& name, std::string reason)
{
    while (!reason.empty() && (reason.back() == '\n' || reason.back() == ' '))
    {
        reason.pop_back();
    }
    for (std::size_t at = reason.find('\n'); at != std::string::npos; at = reason.find('\n', at))
    {
        reason.replace(at, 1, "; ");
    }
    return "osgdb_oiio: '" + name + "': " + reason;
}

/// OpenImageIO's own message about a failed call on an ImageInput or ImageOutput. Also takes the
/// thread's global message, which OpenImageIO would otherwise print at exit as never retrieved.
template <class File> std::string takeError(File& file)
{
    const std::string global = OIIO::geterror();
    const std::string own = file.geterror();
    if (!own.empty())
    {
        return own;
    }
    return global.empty() ? "damaged or not of this format (OpenImageIO names no reason)" : global;
}

} // namespace osgKitsOiio
