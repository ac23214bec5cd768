// SPDX-License-Identifier: MIT
#pragma once

#include "Capture.h"
#include "Pick.h"
#include "Probe.h"

#include <osgMultiRender/Plan.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace osgrender
{

/// Times of several frames, in milliseconds.
struct Times
{
    std::vector<double> milliseconds;

    /// Nearest rank: `share` 0 is the smallest, 0.5 the median, 1 the largest. 0 without any time.
    double quantile(double share) const;
};

/// What one render was and cost.
struct Report
{
    std::string model;
    std::string backend;
    Renderer renderer;
    int width = 0, height = 0, samples = 0; ///< Samples as asked for.
    int frames = 0;
    std::string camera;           ///< Of the last frame, as --camera takes it.
    double loadMs = 0.0;          ///< Reading and optimizing the model.
    double firstFrameMs = 0.0;    ///< With all uploads and compilations.
    Times frame, cull, draw, gpu; ///< Of the timed frames; gpu is empty without timer queries.

    double passes = 0.0;
    double drawCalls = 0.0;
    double triangles = 0.0;
    double programsCompiled = 0.0, programsReused = 0.0;
    double textureBytes = 0.0;
    double coverage = 0.0; ///< Share of the pixels that are not the clear colour.
    unsigned int glErrors = 0;
    unsigned int warnings = 0;
    std::vector<osgMultiRender::Plan> plans;
    ProbeResult probes;
    std::vector<PickResult> picks;
    std::optional<std::string> comparison; ///< The finding of --reference.
};

nlohmann::json toJson(const Report& report);

/// Writes the report as JSON. Returns false and fills `error` when the file can't be written.
bool writeReport(const Report& report, const std::string& file, std::string& error);

/// The plans as text, or that the model has none.
std::string planText(const Report& report);

} // namespace osgrender
