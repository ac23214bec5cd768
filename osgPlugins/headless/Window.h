// SPDX-License-Identifier: MIT
#pragma once

#include "Capture.h"
#include "Surface.h"

#include <osgViewer/GraphicsWindow>

#include <mutex>
#include <optional>

namespace osgHeadless
{

/// A window that no one sees: a surface seen as OSG's GraphicsWindow, or as its pixel buffer.
///
/// Events come only from the program (getEventQueue()). A window, unlike a pixel buffer, takes part
/// in OSG_HEADLESS_CAPTURE.
class Window : public osgViewer::GraphicsWindow
{
public:
    /// Takes the surface; writes what the framebuffer really has back to `traits`.
    Window(osg::GraphicsContext::Traits& traits, Backend& backend,
           std::unique_ptr<Surface> surface);

    const char* libraryName() const override { return "osgHeadless"; }
    const char* className() const override { return "Window"; }

    Surface* getSurface() const { return _surface.get(); }

    bool valid() const override { return _surface != nullptr; }
    bool realizeImplementation() override;
    bool isRealizedImplementation() const override { return _realized; }
    void closeImplementation() override;
    bool makeCurrentImplementation() override;
    bool makeContextCurrentImplementation(osg::GraphicsContext* source) override;
    bool releaseContextImplementation() override;
    void bindPBufferToTextureImplementation(GLenum buffer) override;
    void swapBuffersImplementation() override;
    void runOperations() override;

    bool checkEvents() override;
    bool setWindowRectangleImplementation(int x, int y, int width, int height) override;
    bool setWindowDecorationImplementation(bool) override { return true; }
    void setWindowName(const std::string& name) override;
    void setCursor(MouseCursor) override {}
    void setSyncToVBlank(bool) override {}
    void grabFocus() override {}
    void grabFocusIfPointerInWindow() override {}
    void raiseWindow() override {}

protected:
    ~Window() override;

private:
    void drawToFramebufferObject();
    void applySize();

    struct Size
    {
        int width, height;
    };

    Backend& _backend;
    std::unique_ptr<Surface> _surface;
    std::unique_ptr<Capture> _capture;
    std::mutex _sizeMutex;
    std::optional<Size> _wantedSize; // set by any thread, applied where the context is current
    Size _size;                      // of the surface; the traits may run ahead of it
    bool _realized = false;
    bool _extensionsComplete = false;
};

} // namespace osgHeadless
