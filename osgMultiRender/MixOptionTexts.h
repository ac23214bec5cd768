// SPDX-License-Identifier: MIT
// Settings of a MixedScene that are more than a number or a word, from and to text. Not installed.
#pragma once

#include <osgMultiRender/MixedScene.h>

#include <string>

namespace osgMultiRender
{

// What parses returns "" or why the text is wrong, in one clause.

/// "phong:0,0,1,3;toon:1,3" adds to what is there.
std::string parseRenderings(MixedScene& scene, const std::string& text);
std::string formatRenderings(const MixedScene& scene);
/// "1,2,3;4,5,6".
std::string parsePoints(MixedScene& scene, const std::string& text);
std::string formatPoints(const MixedScene& scene);
/// A name, a number or "none".
std::string parseBase(MixedScene& scene, const std::string& text);
std::string formatBase(const MixedScene& scene);
/// "none", "transparent", "#rrggbb" or "#rrggbbaa".
std::string parseBackground(MixedScene& scene, const std::string& text);
std::string formatBackground(const MixedScene& scene);
/// "phong.gloss=60;1.tones=4".
std::string parseUniforms(MixedScene& scene, const std::string& text);
/// "": files hold them with their rendering.
std::string formatUniforms(const MixedScene& scene);
/// The name of a mix file.
std::string parseMix(MixedScene& scene, const std::string& text);

} // namespace osgMultiRender
