// SPDX-License-Identifier: MIT
#pragma once

#include "CoinContext.h"
#include "Surface.h"

#include <vector>

namespace osgHeadless
{

/// The default screen is 1280x720; OSG_HEADLESS_SCREEN=WxH[,WxH…] gives other or several ones.
///
/// osgviewer opens a window on each screen unless --window or --screen names one.
class WindowingSystem : public osg::GraphicsContext::WindowingSystemInterface
{
public:
    explicit WindowingSystem(Backend& backend);

    unsigned int getNumScreens(const osg::GraphicsContext::ScreenIdentifier&) override;
    void getScreenSettings(const osg::GraphicsContext::ScreenIdentifier& screen,
                           osg::GraphicsContext::ScreenSettings& settings) override;
    void enumerateScreenSettings(const osg::GraphicsContext::ScreenIdentifier& screen,
                                 osg::GraphicsContext::ScreenSettingsList& list) override;

    /// Returns a Window, or null after one line with cause and remedy (each line once). Null
    /// without a line for a pixel buffer that is to be bound as texture: OSG then copies instead.
    /// With OSG_HEADLESS_CAPTURE set, a window (not a pixel buffer) that fails also makes the
    /// process end with EXIT_FAILURE, and windows that open after it write no picture.
    osg::GraphicsContext* createGraphicsContext(osg::GraphicsContext::Traits* traits) override;

protected:
    ~WindowingSystem() override = default;

private:
    osg::ref_ptr<osg::GraphicsContext> create(osg::GraphicsContext::Traits& traits,
                                              std::string& error);

    struct Screen
    {
        int width = 1280, height = 720;
    };

    Backend& _backend;
    std::vector<Screen> _screens;
    std::string _screenError; // of OSG_HEADLESS_SCREEN; the first window reports it
};

/// Puts a windowing system first in OSG's list, which is asked in order, and gives Coin contexts.
///
/// A plugin's static object: taken out again when the plugin is unloaded, or at exit before OSG's
/// own objects go.
class Registration
{
public:
    explicit Registration(Backend& backend);
    ~Registration();

private:
    osg::ref_ptr<WindowingSystem> _system;
    osg::ref_ptr<CoinContext> _coin;
};

} // namespace osgHeadless
