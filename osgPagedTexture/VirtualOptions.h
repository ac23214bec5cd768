// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Option.h>
#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/VirtualSettings.h>

#include <string>
#include <vector>

namespace osgPagedTexture
{

/// One setting of a VirtualScene as text.
using VirtualOption = osgMultiRender::Option<VirtualSettings>;

/// All of them.
OSGPAGEDTEXTURE_EXPORT const std::vector<VirtualOption>& virtualOptions();

/// Sets one by its name. Returns false and fills `error` with one line that says what may be said.
OSGPAGEDTEXTURE_EXPORT bool setVirtualOption(VirtualSettings& settings, const std::string& name,
                                             const std::string& text, std::string& error);

/// All that differ from the defaults: "gpu='64',aniso='8'"; empty for none.
OSGPAGEDTEXTURE_EXPORT std::string formatVirtualOptions(const VirtualSettings& settings);

/// The reverse; settings that are not said keep their values. Returns a line for each that is
/// unknown or wrong, which does not count; where the text as a whole is broken none does.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> parseVirtualOptions(VirtualSettings& settings,
                                                                    const std::string& text);

} // namespace osgPagedTexture
