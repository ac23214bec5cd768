// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Vec4ub>

/// What things look like, and where the rack of a plot is.
namespace plot
{

inline const osg::Vec4ub Steel(122, 130, 138, 255), Concrete(176, 172, 162, 255),
    Paving(142, 142, 134, 255), Yellow(232, 184, 32, 255), Galvanized(188, 194, 198, 255),
    Insulation(214, 214, 208, 255), White(236, 236, 230, 255), Green(52, 124, 84, 255),
    Blue(44, 96, 156, 255), Red(190, 44, 36, 255), Rust(150, 92, 62, 255);

struct Service
{
    const char* code;
    osg::Vec4ub color;
};
inline const Service Services[] = {{"HC", {182, 120, 60, 255}},  {"CW", {60, 128, 84, 255}},
                                   {"ST", {200, 200, 204, 255}}, {"FG", {212, 172, 48, 255}},
                                   {"N2", {120, 132, 148, 255}}, {"IA", {92, 140, 188, 255}},
                                   {"FW", {184, 56, 44, 255}},   {"HO", {136, 104, 84, 255}}};
inline constexpr int NumServices = sizeof Services / sizeof *Services;

inline constexpr double RackLow = 21.0, RackHigh = 27.0; ///< Of the rack, in y.
inline constexpr double LevelHeights[] = {4.6, 6.8};
inline constexpr double BayLength = 6.0;

} // namespace plot
