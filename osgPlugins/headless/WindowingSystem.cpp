// SPDX-License-Identifier: MIT
#include "WindowingSystem.h"

#include "ExitStatus.h"
#include "Report.h"
#include "Window.h"

#include <osgDB/Registry>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace osgHeadless
{

namespace
{

std::string toText(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

bool fits(const osg::GraphicsContext::Traits& traits, const Limits& limits, std::string& error)
{
    const std::string size = toText(traits.width, traits.height);
    if (traits.width <= 0 || traits.height <= 0)
    {
        error = "a window of " + size + " has no pixels; ask for 1x1 or more (--window x y w h)";
    }
    else if (traits.width > limits.maxWidth || traits.height > limits.maxHeight)
    {
        error = "a window of " + size + " is larger than " +
                toText(limits.maxWidth, limits.maxHeight) + ", the limit of " + limits.renderer +
                "; ask for a smaller one (--window x y w h)";
    }
    else if (traits.samples > limits.maxSamples)
    {
        error = std::to_string(traits.samples) + " samples are more than the " +
                std::to_string(limits.maxSamples) + " of " + limits.renderer +
                "; ask for fewer (--samples)";
    }
    return error.empty();
}

} // namespace

WindowingSystem::WindowingSystem(Backend& backend) : _backend(backend)
{
    setName(backend.getName());
    const char* value = std::getenv("OSG_HEADLESS_SCREEN");
    std::istringstream list(value ? value : "");
    for (std::string item; std::getline(list, item, ',');)
    {
        Screen screen;
        char times = 0;
        std::istringstream text(item);
        if (!(text >> screen.width >> times >> screen.height) || times != 'x' ||
            !(text >> std::ws).eof() || screen.width <= 0 || screen.height <= 0)
        {
            _screenError = "OSG_HEADLESS_SCREEN='" + std::string(value) +
                           "' is not a list of sizes; write for example 1920x1080,800x600";
            break;
        }
        _screens.push_back(screen);
    }
    if (_screens.empty())
    {
        _screens.emplace_back();
    }
}

unsigned int WindowingSystem::getNumScreens(const osg::GraphicsContext::ScreenIdentifier&)
{
    return static_cast<unsigned int>(_screens.size());
}

void WindowingSystem::getScreenSettings(const osg::GraphicsContext::ScreenIdentifier& identifier,
                                        osg::GraphicsContext::ScreenSettings& settings)
{
    const size_t number = std::max(identifier.screenNum, 0);
    const Screen& screen = _screens[std::min(number, _screens.size() - 1)];
    settings.width = screen.width;
    settings.height = screen.height;
    settings.refreshRate = 60.0;
    settings.colorDepth = 24;
}

void WindowingSystem::enumerateScreenSettings(const osg::GraphicsContext::ScreenIdentifier& screen,
                                              osg::GraphicsContext::ScreenSettingsList& list)
{
    list.resize(1);
    getScreenSettings(screen, list.front());
}

osg::GraphicsContext* WindowingSystem::createGraphicsContext(osg::GraphicsContext::Traits* traits)
{
    if (!traits || (traits->pbuffer && traits->target))
    {
        return nullptr;
    }
    std::string error;
    osg::ref_ptr<osg::GraphicsContext> context = create(*traits, error);
    if (!context)
    {
        reportOnce(_backend, error);
        if (!traits->pbuffer && !Capture::getRequestedFile().empty())
        {
            exitWithFailure();
        }
    }
    return context.release();
}

osg::ref_ptr<osg::GraphicsContext> WindowingSystem::create(osg::GraphicsContext::Traits& traits,
                                                           std::string& error)
{
    const auto* shared = dynamic_cast<Window*>(traits.sharedContext.get());
    if (!_screenError.empty())
    {
        error = _screenError;
        return nullptr;
    }
    if (traits.screenNum >= static_cast<int>(_screens.size()))
    {
        error = "there is no screen " + std::to_string(traits.screenNum) + ", only " +
                std::to_string(_screens.size()) + "; name a lower one (--screen) or add one " +
                "(OSG_HEADLESS_SCREEN=1280x720,1280x720)";
        return nullptr;
    }
    if (traits.sharedContext.valid() && (!shared || !shared->getSurface()))
    {
        error = "a context of another windowing system, or a closed one, can't be shared; share "
                "with an open window of " +
                getName();
        return nullptr;
    }
    const Limits* limits = _backend.getLimits(error);
    if (!limits || !fits(traits, *limits, error))
    {
        return nullptr;
    }
    auto surface = _backend.createSurface(traits, shared ? shared->getSurface() : nullptr, error);
    if (!surface)
    {
        return nullptr;
    }
    keepLibraryMapped();
    return new Window(traits, _backend, std::move(surface));
}

Registration::Registration(Backend& backend)
    : _system(new WindowingSystem(backend)), _coin(new CoinContext(backend))
{
    osgDB::Registry::instance()->addReaderWriter(_coin);
    auto& list = osg::GraphicsContext::getWindowingSystemInterfaces()->getInterfaces();
    list.insert(list.begin(), _system);
}

Registration::~Registration()
{
    // Both are null when OSG's own singletons went first.
    if (auto* registry = osgDB::Registry::instance())
    {
        registry->removeReaderWriter(_coin);
    }
    if (const auto& systems = osg::GraphicsContext::getWindowingSystemInterfaces(); systems.valid())
    {
        systems->removeWindowingSystemInterface(_system);
    }
}

} // namespace osgHeadless
