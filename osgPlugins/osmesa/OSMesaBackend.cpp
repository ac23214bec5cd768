// SPDX-License-Identifier: MIT
#include "OSMesaBackend.h"

#include "OSMesaSurface.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

namespace osgOSMesa
{

namespace
{

// The name that the plugin was linked to, e.g. libOSMesa.so.8.
std::string getLibraryName()
{
    Dl_info info;
    if (!dladdr(reinterpret_cast<void*>(&OSMesaMakeCurrent), &info) || !info.dli_fname)
    {
        return "libOSMesa.so.8";
    }
    const std::string path = info.dli_fname;
    return path.substr(path.find_last_of('/') + 1);
}

bool askGl(osgHeadless::Limits& limits, std::string& error)
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = traits->height = 1;
    OSMesaSurface surface;
    if (!surface.create(*traits, nullptr))
    {
        error = "OSMesa makes no OpenGL context; install Mesa's libosmesa6";
        return false;
    }
    // What libosg calls, not what this plugin is linked to.
    using GetString = const GLubyte* (*)(GLenum);
    const auto getString = reinterpret_cast<GetString>(dlsym(RTLD_DEFAULT, "glGetString"));
    const GLubyte* renderer = getString ? getString(GL_RENDERER) : nullptr;
    if (!renderer)
    {
        error =
            "OpenGL calls go to another library than OSMesa; start the program with LD_PRELOAD=" +
            getLibraryName();
        return false;
    }
    limits.renderer = reinterpret_cast<const char*>(renderer);
    GLint viewport[2] = {0, 0}, width = 0, height = 0, samples = 0;
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    OSMesaGetIntegerv(OSMESA_MAX_WIDTH, &width);
    OSMesaGetIntegerv(OSMESA_MAX_HEIGHT, &height);
    glGetIntegerv(GL_MAX_SAMPLES, &samples);
    limits.maxWidth = std::min(width, viewport[0]);
    limits.maxHeight = std::min(height, viewport[1]);
    limits.maxSamples = std::max(samples, 0);
    return true;
}

} // namespace

const osgHeadless::Limits* OSMesaBackend::getLimits(std::string& error)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_asked)
    {
        const auto restore = rememberCurrent();
        _asked = askGl(_limits, error);
        // OSMesa registered its own clean-up with its first context, so this runs before it.
        std::atexit(&OSMesaSurface::forgetOSMesa);
        restore();
    }
    return _asked ? &_limits : nullptr;
}

std::unique_ptr<osgHeadless::Surface>
OSMesaBackend::createSurface(const osg::GraphicsContext::Traits& traits,
                             osgHeadless::Surface* shared, std::string& error)
{
    const auto restore = rememberCurrent();
    auto surface = std::make_unique<OSMesaSurface>();
    const bool created = surface->create(traits, static_cast<OSMesaSurface*>(shared));
    restore();
    if (!created)
    {
        error = "OSMesa makes no context of OpenGL " + traits.glContextVersion + " with " +
                std::to_string(traits.width) + "x" + std::to_string(traits.height) +
                " pixels and " + std::to_string(traits.samples) +
                " samples; ask for a smaller window, fewer samples or another version "
                "(--gl-version)";
        return nullptr;
    }
    return surface;
}

std::function<void()> OSMesaBackend::rememberCurrent()
{
    OSMesaSurface* current = OSMesaSurface::getCurrent();
    return [current]
    {
        if (current)
        {
            current->makeCurrent();
        }
        else if (OSMesaSurface* other = OSMesaSurface::getCurrent())
        {
            other->release();
        }
    };
}

} // namespace osgOSMesa
