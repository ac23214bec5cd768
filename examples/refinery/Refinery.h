// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/PrimitiveBatch.h>

#include <cstdint>
#include <functional>

/// What is made.
struct RefinerySettings
{
    unsigned int objects = 1000; ///< Exactly so many.
    std::uint32_t seed = 1;      ///< The same seed gives the same objects on every machine.
};

using AddPrimitive = std::function<void(const osgLabels::Primitive&)>;

/// A refinery: process units along pipe racks, tank farms, storage spheres. Metres, z is up, the
/// middle of the ground is about the origin. Each object has a tag of its own, pipes by spools; the
/// ground has none.
void makeRefinery(const RefinerySettings& settings, const AddPrimitive& add);

/// Quads of random sizes at random places, all facing -y, as in "Surface Labeling in Real Time
/// Visualization of Massive CAD Models": text covers all that is drawn.
void makeQuads(const RefinerySettings& settings, const AddPrimitive& add);
