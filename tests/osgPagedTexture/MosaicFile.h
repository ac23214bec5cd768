// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Writes a square PPM of `side` pixels out of cells, each a photograph that is installed, repeated
/// where it is smaller and shifted where it comes again. Returns how many photographs it has.
/// Throws std::runtime_error where none is installed.
int writeMosaic(const std::string& path, int side, int cellSide = 2048);
