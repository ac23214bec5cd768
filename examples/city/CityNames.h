// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Of street `index` of those that run along an axis, 0 for x and 1 for y.
std::string streetName(int axis, unsigned int index);

/// What the most important buildings are called, the first "Town Hall"; empty for the others.
std::string landmarkName(unsigned int index);
