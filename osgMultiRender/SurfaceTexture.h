// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/SurfaceKey.h>

namespace osgMultiRender
{

/// Fills surface.textures[unit] with what the fixed function does in a texture unit. Returns an
/// empty string, or what the surface functions do not cover.
std::string fillTexture(const SurfaceState& state, unsigned int unit, unsigned int contextID,
                        SurfaceKey& surface);

} // namespace osgMultiRender
