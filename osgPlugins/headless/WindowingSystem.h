// SPDX-License-Identifier: MIT
#pragma once

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

    /// Returns a Window, or null after one line with cause and remedy. With OSG_HEADLESS_CAPTURE
    /// set, a window (not a pixel buffer) that fails also makes the process end with EXIT_FAILURE.
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

/// Puts a windowing system first in OSG's list while it lives: the list is asked in order.
class Registration
{
public:
    explicit Registration(Backend& backend);
    ~Registration();

private:
    osg::ref_ptr<WindowingSystem> _system;
};

} // namespace osgHeadless
