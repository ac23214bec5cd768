// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/Registration.h>

#define OSGKITS_QUOTED(text) #text
#define OSGKITS_TEXT(macro) OSGKITS_QUOTED(macro)

extern "C" __attribute__((visibility("default"))) void OSGKITS_MODULE() {}

static osgKitsOiio::Registration registration(OSGKITS_TEXT(OSGKITS_EXTENSION));
