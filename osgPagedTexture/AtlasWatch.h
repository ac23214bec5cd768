// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasLayout.h>

#include <memory>
#include <string>

namespace osgPagedTexture
{

/// Tells when the photographs of a layout may have changed, by looking at names, sizes and times
/// only. One thread.
class OSGPAGEDTEXTURE_EXPORT AtlasWatch
{
public:
    /// Watches the photographs of the layout and its photoFolder. What is there now is known.
    AtlasWatch(const AtlasLayout& layout, const std::string& folder);
    ~AtlasWatch();
    AtlasWatch(AtlasWatch&&) noexcept;

    /// Looks again. True where something is other than when this was last true, or at the
    /// beginning, and as at the look before: who writes has finished.
    bool look();

private:
    struct Content;
    std::unique_ptr<Content> _content;
};

} // namespace osgPagedTexture
