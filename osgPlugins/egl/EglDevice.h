// SPDX-License-Identifier: MIT
#pragma once

#include <osgPlugins/headless/Surface.h>

#include <EGL/egl.h>

#include <vector>

namespace osgEgl
{

/// The display of one device, initialized, and what its driver can give.
struct Device
{
    EGLDisplay display = EGL_NO_DISPLAY;
    osgHeadless::Limits limits;
};

/// The device that the user picks: the environment variable OSG_EGL_DEVICE, or "egl.device=" in
/// OSG's option string (-O), which wins.
///
/// "auto", or nothing: the first hardware device that gives OpenGL, else surfaceless Mesa. A
/// number: that one of EGL's devices. "surfaceless": Mesa without a device.
std::string getDeviceChoice();

/// Opens the device that `choice` names. Returns false and fills `error` with cause and remedy when
/// there is none.
bool openDevice(const std::string& choice, Device& device, std::string& error);

/// The config with 8 bits a colour and alpha, depth 24, stencil 8 and the fewest samples that are
/// at least `samples`; null when there is none.
EGLConfig chooseConfig(EGLDisplay display, unsigned int samples);

/// The name of an EGL error, for messages.
std::string getErrorName(EGLint code);

} // namespace osgEgl
