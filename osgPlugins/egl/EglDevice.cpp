// SPDX-License-Identifier: MIT
#include "EglDevice.h"

#include <osg/GL>
#include <osg/Notify>
#include <osgDB/Registry>

#include <EGL/eglext.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>

namespace osgEgl
{

namespace
{

bool hasWord(const char* list, const std::string& word)
{
    std::istringstream words(list ? list : "");
    return std::find(std::istream_iterator<std::string>(words), {}, word) !=
           std::istream_iterator<std::string>();
}

template <class Function> Function lookUp(const char* name)
{
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDeviceEXT> listDevices()
{
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto query = lookUp<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (!query || !hasWord(client, "EGL_EXT_platform_device") ||
        !(hasWord(client, "EGL_EXT_device_enumeration") ||
          hasWord(client, "EGL_EXT_device_base")) ||
        !query(0, nullptr, &count) || count <= 0)
    {
        return {};
    }
    std::vector<EGLDeviceEXT> devices(count);
    query(count, devices.data(), &count);
    devices.resize(count);
    return devices;
}

bool isSoftware(EGLDeviceEXT device)
{
    const auto query = lookUp<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    return query && hasWord(query(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

// Makes a context once: the viewport's limit and the renderer's name come only from GL.
bool askGl(EGLDisplay display, osgHeadless::Limits& limits)
{
    const EGLConfig config = chooseConfig(display, 0);
    if (!config)
    {
        return false;
    }
    const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    const bool current = surface && context && eglMakeCurrent(display, surface, surface, context);
    if (current)
    {
        GLint viewport[2] = {0, 0};
        glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
        // EGL_MAX_PBUFFER_WIDTH is no limit: Mesa says 4096 and gives any size up to this one.
        limits.maxWidth = viewport[0];
        limits.maxHeight = viewport[1];
        const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        limits.renderer = name ? name : "";
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    if (context)
    {
        eglDestroyContext(display, context);
    }
    if (surface)
    {
        eglDestroySurface(display, surface);
    }
    while (EGLConfig more = chooseConfig(display, limits.maxSamples + 1))
    {
        EGLint samples = 0;
        eglGetConfigAttrib(display, more, EGL_SAMPLES, &samples);
        limits.maxSamples = samples;
    }
    return current && limits.maxWidth > 0;
}

bool openPlatform(EGLenum platform, void* native, Device& device)
{
    const auto get = lookUp<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    const EGLDisplay display = get ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
    if (!display || !eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
    {
        return false;
    }
    Device opened;
    opened.display = display;
    if (!askGl(display, opened.limits))
    {
        // The display is not terminated: the program may use the same one, and EGL does not count.
        return false;
    }
    device = opened;
    return true;
}

bool openSurfaceless(Device& device)
{
    return hasWord(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS),
                   "EGL_MESA_platform_surfaceless") &&
           openPlatform(EGL_PLATFORM_SURFACELESS_MESA, nullptr, device);
}

bool openFirst(const std::vector<EGLDeviceEXT>& devices, bool software, Device& device)
{
    return std::any_of(devices.begin(), devices.end(),
                       [&](EGLDeviceEXT each) {
                           return isSoftware(each) == software &&
                                  openPlatform(EGL_PLATFORM_DEVICE_EXT, each, device);
                       });
}

std::string describe(const std::vector<EGLDeviceEXT>& devices)
{
    std::string text;
    for (size_t i = 0; i < devices.size(); ++i)
    {
        text += (i ? ", " : "") + std::to_string(i) + (isSoftware(devices[i]) ? " (software)" : "");
    }
    return devices.empty() ? "EGL lists no device" : "EGL lists the devices " + text;
}

} // namespace

std::string getDeviceChoice()
{
    const auto* options = osgDB::Registry::instance()->getOptions();
    std::istringstream words(options ? options->getOptionString() : "");
    const std::string key = "egl.device=";
    for (std::string word; words >> word;)
    {
        if (word.compare(0, key.size(), key) == 0)
        {
            return word.substr(key.size());
        }
    }
    const char* value = std::getenv("OSG_EGL_DEVICE");
    return value && *value ? value : "auto";
}

bool openDevice(const std::string& choice, Device& device, std::string& error)
{
    const auto devices = listDevices();
    bool open = false;
    if (choice == "auto")
    {
        open = openFirst(devices, false, device) || openSurfaceless(device) ||
               openFirst(devices, true, device);
        error = "no EGL device gives OpenGL (" + describe(devices) +
                "); install a GPU driver or Mesa's libegl-mesa0 and libgl1-mesa-dri";
    }
    else if (choice == "surfaceless")
    {
        open = openSurfaceless(device);
        error = "surfaceless EGL is not there; install Mesa's libegl-mesa0 and libgl1-mesa-dri, or "
                "pick a device (OSG_EGL_DEVICE=0)";
    }
    else
    {
        const bool number = !choice.empty() && choice.size() <= 4 &&
                            choice.find_first_not_of("0123456789") == std::string::npos;
        const size_t index = number ? std::stoul(choice) : devices.size();
        open =
            index < devices.size() && openPlatform(EGL_PLATFORM_DEVICE_EXT, devices[index], device);
        error = "device '" + choice + "' " +
                (index < devices.size() ? "gives no OpenGL" : "does not exist") + " (" +
                describe(devices) +
                "); set OSG_EGL_DEVICE or -O egl.device= to one of them, auto or surfaceless";
    }
    if (open)
    {
        error.clear();
        OSG_INFO << "osgdb_egl: device " << choice << ", " << device.limits.renderer << std::endl;
    }
    return open;
}

EGLConfig chooseConfig(EGLDisplay display, unsigned int samples)
{
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_PBUFFER_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_ALPHA_SIZE,
                             8,
                             EGL_DEPTH_SIZE,
                             24,
                             EGL_STENCIL_SIZE,
                             8,
                             EGL_SAMPLES,
                             static_cast<EGLint>(samples),
                             EGL_NONE};
    EGLint count = 0;
    eglChooseConfig(display, wanted, nullptr, 0, &count);
    std::vector<EGLConfig> configs(std::max(count, 0));
    eglChooseConfig(display, wanted, configs.data(), count, &count);
    configs.resize(std::max(count, 0));
    // EGL sorts deeper colours first and then by samples; 10 and 16 bits a colour are not wanted.
    const auto exact = std::find_if(configs.begin(), configs.end(),
                                    [display](EGLConfig config)
                                    {
                                        EGLint red = 0, depth = 0;
                                        eglGetConfigAttrib(display, config, EGL_RED_SIZE, &red);
                                        eglGetConfigAttrib(display, config, EGL_DEPTH_SIZE, &depth);
                                        return red == 8 && depth == 24;
                                    });
    return exact != configs.end() ? *exact : nullptr;
}

std::string getErrorName(EGLint code)
{
    switch (code)
    {
    case EGL_SUCCESS:
        return "EGL_SUCCESS";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC, out of memory";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
        return "EGL_BAD_CONTEXT";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_CONTEXT_LOST:
        return "EGL_CONTEXT_LOST";
    default:
        break;
    }
    std::ostringstream text;
    text << "EGL error 0x" << std::hex << code;
    return text.str();
}

} // namespace osgEgl
