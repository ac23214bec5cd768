// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/Registration.h>

extern "C" __attribute__((visibility("default"))) void osgdb_oiio() {}

static osgKitsOiio::Registration registration;
