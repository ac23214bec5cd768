// SPDX-License-Identifier: MIT
// What a MixedScene's frames draw with. Not installed.
#pragma once

#include <osgMultiRender/KeyPoints.h>
#include <osgMultiRender/Merger.h>
#include <osgMultiRender/MixWeights.h>
#include <osgMultiRender/Rendering.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace osgMultiRender
{

/// Values of uniforms by name, other than the rendering's own.
using MixUniforms = std::map<std::string, std::vector<double>>;

/// A rendering of a scene. Its place in the list is its number on the GPU.
struct MixSlot
{
    std::shared_ptr<const Rendering> rendering; ///< Null: removed.
    std::uint64_t id = 0;                       ///< Of this rendering, never given again.
    MixRange range;
    MixUniforms uniforms;
    std::shared_ptr<const MixSlot> before; ///< What it has replaced; shown while this one fails.
};

/// All settings of one frame; never changed once a frame has it.
struct MixSnapshot
{
    std::vector<MixSlot> slots;
    std::shared_ptr<const KeyPoints> points = std::make_shared<KeyPoints>();
    MixRules rules;
    bool isOfFrame = false;     ///< Renderings read the frame, in a second pass.
    bool ownLighting = false;   ///< Lights and materials of imports are their own.
    bool isTransparent = false; ///< What is missing shows what lies behind.
    bool prunes = true;
    unsigned int settleFrames = 10;
    std::size_t maxPrograms = 32;
    std::optional<MergeLimits> limits; ///< Below the context's.
    std::uint64_t mixRevision = 0;     ///< Changes with points, ranges and rules.
    std::uint64_t uniformRevision = 0; ///< Changes with values of uniforms.
};

} // namespace osgMultiRender
