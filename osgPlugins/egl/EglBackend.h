// SPDX-License-Identifier: MIT
#pragma once

#include "EglDevice.h"

#include <mutex>

namespace osgEgl
{

/// Pbuffer surfaces of the picked EGL device.
///
/// The device is opened with the first surface, not with the plugin: osgviewer reads -O after -e.
class EglBackend final : public osgHeadless::Backend
{
public:
    const char* getName() const override { return "EGL"; }
    const char* getPluginName() const override { return "osgdb_egl"; }
    const osgHeadless::Limits* getLimits(std::string& error) override;
    std::unique_ptr<osgHeadless::Surface> createSurface(const osg::GraphicsContext::Traits& traits,
                                                        osgHeadless::Surface* shared,
                                                        std::string& error) override;
    std::function<void()> rememberCurrent() override;

private:
    std::mutex _mutex; // guards the opening
    Device _device;
};

} // namespace osgEgl
