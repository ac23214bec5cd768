// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PagedSettings.h>

#include <osgMultiRender/Option.h>

#include <string>
#include <vector>

namespace osgPagedTexture
{

/// One setting of a PagedScene as text.
using PagedOption = osgMultiRender::Option<PagedSettings>;

/// All of them.
OSGPAGEDTEXTURE_EXPORT const std::vector<PagedOption>& pagedOptions();

/// Sets one by its name. Returns false and fills `error` with one line that says what may be said.
OSGPAGEDTEXTURE_EXPORT bool setPagedOption(PagedSettings& settings, const std::string& name,
                                           const std::string& text, std::string& error);

/// All that differ from the defaults: "gpu='64',upload='1'"; empty for none.
OSGPAGEDTEXTURE_EXPORT std::string formatPagedOptions(const PagedSettings& settings);

/// The reverse; settings that are not said keep their values. Returns a line for each that is
/// unknown or wrong, which does not count; where the text as a whole is broken none does.
OSGPAGEDTEXTURE_EXPORT std::vector<std::string> parsePagedOptions(PagedSettings& settings,
                                                                  const std::string& text);

} // namespace osgPagedTexture
