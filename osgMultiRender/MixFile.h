// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <string>

namespace osgMultiRender
{

class MixedScene;

/// Reads a mix: JSON, in which `//` and `/* */` are comments.
///
///     {
///       "renderings": [
///         { "name": "phong", "range": [0, 0, 4, 6], "uniforms": { "gloss": 60 } },
///         { "file": "sketch/paper.frag", "range": [4, 6] }
///       ],
///       "points": [[0, 0, 1], [8, 0, 1]],
///       "mode": "polyline",
///       "base": "phong"
///     }
///
/// A rendering is a built-in one (`name`), a file beside the mix (`file`), or one in full (`name`,
/// `vertex`, `fragment`: a text or several; `defines`, `textures`, `attributes`, `outputs`). Of a
/// range's four distances the last two may be missing: infinite, as is "inf". All else is as
/// mixOptions() has it. Renderings are added to those that are there. Returns false and fills
/// `error` with one line, naming file and line or place; then nothing has been changed. `fileName`
/// says where files lie; empty: on OSG's data path.
OSGMULTIRENDER_EXPORT bool applyMix(MixedScene& scene, const std::string& text,
                                    const std::string& fileName, std::string& error);

/// A file of at most 16 MiB, likewise.
OSGMULTIRENDER_EXPORT bool readMixFile(MixedScene& scene, const std::string& fileName,
                                       std::string& error);

/// All of a scene but its subgraph, for applyMix().
OSGMULTIRENDER_EXPORT std::string formatMix(const MixedScene& scene);

} // namespace osgMultiRender
