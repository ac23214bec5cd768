// SPDX-License-Identifier: MIT
#include "WarningCounter.h"

#include <cstdio>
#include <cstring>

namespace osgrender
{

void WarningCounter::notify(osg::NotifySeverity severity, const char* message)
{
    if (!message || !*message)
        return;
    const std::lock_guard<std::mutex> lock(_mutex);
    std::fputs(message, stderr);
    // OSG hands over what one severity wrote up to its flush: part of a line, or several.
    for (const char* c = message; *c; ++c)
    {
        if (!_lineOpen && severity <= osg::WARN)
            ++_warnings;
        _lineOpen = *c != '\n';
    }
    if (std::strstr(message, "detected OpenGL error"))
        ++_glErrors;
}

unsigned int WarningCounter::getWarnings()
{
    osg::notify(osg::ALWAYS).flush();
    const std::lock_guard<std::mutex> lock(_mutex);
    return _warnings;
}

unsigned int WarningCounter::getGlErrors()
{
    const std::lock_guard<std::mutex> lock(_mutex);
    return _glErrors;
}

void WarningCounter::reset()
{
    osg::notify(osg::ALWAYS).flush();
    const std::lock_guard<std::mutex> lock(_mutex);
    _warnings = 0;
    _glErrors = 0;
}

} // namespace osgrender
