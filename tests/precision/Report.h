// SPDX-License-Identifier: MIT
#pragma once

#include <precision/Measure.h>

#include <iosfwd>
#include <string>

namespace precision
{

// The CSV files have a head line and one line a (method, value) pair:
//   method     name of the method
//   knob       what the value is
//   value      of the knob
//   status     ok or failed
//   error      as the sweep defines it; empty where failed
//   median_ms  of the timed rounds, milliseconds; empty where failed, as are the next two
//   p10_ms     a tenth of the rounds took less
//   p90_ms     a tenth of the rounds took more
//   rounds     number of timed rounds
//   message    why it failed
// Lines before that begin with #: the sweep's title, the error's name, the machine, the renderer.

/// CPU model and number of cores; "unknown CPU" where the system does not say.
std::string describeMachine();

void writeCsv(std::ostream& out, const Sweep& sweep, const std::vector<Measurement>& measurements);

/// A gnuplot script that draws the diagram as an SVG file of that name: error and run time, or the
/// sweep's budget and the error, both logarithmic, a line a method, points labelled with the knob's
/// value, bars from p10 to p90. An error of 0 is drawn at a tenth of the smallest other one.
/// Failures stand as crosses at the top, each with its method and value.
void writePlot(std::ostream& out, const Sweep& sweep, const std::vector<Measurement>& measurements,
               const std::string& svgName);

void printTable(std::ostream& out, const Sweep& sweep,
                const std::vector<Measurement>& measurements);

} // namespace precision
