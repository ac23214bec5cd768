// SPDX-License-Identifier: MIT
// A second GL context beside the current one. Not installed.
#pragma once

#include <memory>

namespace osgPagedTexture
{

/// A context without a picture that shares textures with another one, for a thread of its own.
///
/// EGL alone has it: there all contexts of a process share one screen of the driver. Under GLX each
/// connection to the X server has one of its own, and a texture must not outlive that of its maker.
class SharedContext
{
public:
    /// Shares with the calling thread's context; null where that is none of EGL.
    static std::unique_ptr<SharedContext> create();
    ~SharedContext();

    /// In the thread that will use it, where it comes into being: drivers take milliseconds.
    /// Returns whether it can.
    bool makeCurrent();

    /// In that thread again, before the end of both.
    void release();

private:
    struct Egl;
    SharedContext();

    std::unique_ptr<Egl> _egl;
};

} // namespace osgPagedTexture
