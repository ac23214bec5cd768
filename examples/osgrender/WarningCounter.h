// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Notify>

#include <mutex>

namespace osgrender
{

/// Prints OSG's messages on standard error and counts the warnings. Callable from any thread.
class WarningCounter : public osg::NotifyHandler
{
public:
    void notify(osg::NotifySeverity severity, const char* message) override;

    /// Lines printed at WARN or worse since the last reset. Flushes what is pending first.
    unsigned int getWarnings();

    /// OpenGL errors that OSG itself reported, when OSG_GL_ERROR_CHECKING asks it to.
    unsigned int getGlErrors();

    void reset();

protected:
    ~WarningCounter() override = default;

private:
    std::mutex _mutex;
    bool _lineOpen = false;
    unsigned int _warnings = 0;
    unsigned int _glErrors = 0;
};

} // namespace osgrender
