// SPDX-License-Identifier: MIT
#include "EglBackend.h"

#include <osgPlugins/headless/WindowingSystem.h>

namespace
{

// Never destroyed: windows and Coin may use it after this library's destructors ran.
osgEgl::EglBackend& backend()
{
    static auto* instance = new osgEgl::EglBackend;
    return *instance;
}

osgHeadless::Registration registration(backend());

} // namespace
