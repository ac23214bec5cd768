// SPDX-License-Identifier: MIT
#pragma once

#include <osgPlugins/headless/Surface.h>

#include <mutex>

namespace osgOSMesa
{

/// Surfaces of OSMesa, Mesa's software renderer without any window system.
///
/// libosg calls GL by symbol, so libOSMesa must come before libGL in the process: preloaded, or
/// linked first into the program. getLimits() finds the wrong order and names the remedy.
class OSMesaBackend final : public osgHeadless::Backend
{
public:
    const char* getName() const override { return "OSMesa"; }
    const char* getPluginName() const override { return "osgdb_osmesa"; }
    const osgHeadless::Limits* getLimits(std::string& error) override;
    std::unique_ptr<osgHeadless::Surface> createSurface(const osg::GraphicsContext::Traits& traits,
                                                        osgHeadless::Surface* shared,
                                                        std::string& error) override;
    std::function<void()> rememberCurrent() override;
    void completeExtensions(osg::State& state) override;

private:
    std::mutex _mutex; // guards the limits
    bool _asked = false;
    osgHeadless::Limits _limits;
};

} // namespace osgOSMesa
