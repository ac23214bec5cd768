// SPDX-License-Identifier: MIT
#pragma once

#include "Picture.h"

/// Pixels that a picture would have if nothing limited the bytes of all: sides of 512 to 8192, few
/// of the large ones.
double naturalPixels(const Picture& picture);

/// Gives it about so many pixels, in the shape of its surface; sides are 512 to 8192. Three of five
/// have powers of two, unless `exact`; the others an odd number of columns, most of rows too. PNG
/// files keep sizes of their own.
void setSize(Picture& picture, double pixels, bool exact = false);
