// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <string>
#include <vector>

namespace osgMultiRender
{

/// A rendering that comes with the kit: a complete program of GLSL 1.20, as a user would bring it.
///
/// The texts are those of <name>.vert and <name>.frag in the folder osgMultiRender/renderings,
/// installed as share/osgKits/renderings; nothing of the kit knows more about them than about any
/// other pair of files. What uniforms are at first, and within which limits they make sense, a
/// comment behind each says: `uniform float gloss; // = 40 [1, 200]`.
///
/// Surfaces are lit by all lights that are on, of numbers 0 to 7: a `uniform int osg_EnabledLights`
/// has their bits, which MixedScene sets for each drawable. Image renderings (`isImage`) work on
/// texture unit 0 by its texture coordinates; their `imageSize`, where they have one, is the
/// image's size in texels, and 0 0 has them step by pixels of the screen.
struct BuiltInRendering
{
    std::string name;
    bool isImage = false;
    std::string vertex;
    std::string fragment;
};

/// All of them; surfaces first.
OSGMULTIRENDER_EXPORT const std::vector<BuiltInRendering>& getBuiltInRenderings();

/// Null for a name that none has.
OSGMULTIRENDER_EXPORT const BuiltInRendering* findBuiltInRendering(const std::string& name);

} // namespace osgMultiRender
