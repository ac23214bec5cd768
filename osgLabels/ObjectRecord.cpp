// SPDX-License-Identifier: MIT
#include <osgLabels/ObjectRecord.h>

static_assert(sizeof(osgLabels::ObjectRecord) == 4 * osgLabels::ObjectRecord::Words,
              "a record is three texels of four 32-bit integers");
