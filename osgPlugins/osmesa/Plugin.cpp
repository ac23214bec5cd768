// SPDX-License-Identifier: MIT
#include "OSMesaBackend.h"

#include <osgPlugins/headless/WindowingSystem.h>

namespace
{

// Never destroyed: windows and Coin may use it after this library's destructors ran.
osgOSMesa::OSMesaBackend& backend()
{
    static auto* instance = new osgOSMesa::OSMesaBackend;
    return *instance;
}

osgHeadless::Registration registration(backend());

} // namespace
