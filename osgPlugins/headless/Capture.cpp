// SPDX-License-Identifier: MIT
#include "Capture.h"

#include <osgPlugins/headless/Resolve.h>

#include <osg/GLExtensions>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <cstdlib>
#include <mutex>
#include <optional>
#include <set>

namespace osgHeadless
{

namespace
{

struct Numbers
{
    std::mutex mutex;
    std::set<unsigned int> used;
};

// Never destroyed: windows of static objects may close after this library's destructors ran.
Numbers& numbers()
{
    static auto* instance = new Numbers;
    return *instance;
}

unsigned int takeLowestNumber()
{
    std::lock_guard<std::mutex> lock(numbers().mutex);
    unsigned int number = 0;
    while (!numbers().used.insert(number).second)
    {
        ++number;
    }
    return number;
}

} // namespace

std::string Capture::getRequestedFile()
{
    const char* value = std::getenv("OSG_HEADLESS_CAPTURE");
    return value ? value : "";
}

std::string Capture::getFileName(const std::string& pattern, unsigned int number)
{
    const std::string text = std::to_string(number);
    const size_t percent = pattern.find('%');
    const size_t end = percent == std::string::npos
                           ? percent
                           : pattern.find_first_not_of("0123456789", percent + 1);
    if (end != std::string::npos && pattern[end] == 'd' && end - percent <= 3)
    {
        const size_t width = std::strtoul(pattern.c_str() + percent + 1, nullptr, 10);
        const std::string zeros(width > text.size() ? width - text.size() : 0, '0');
        return pattern.substr(0, percent) + zeros + text + pattern.substr(end + 1);
    }
    if (number == 0)
    {
        return pattern;
    }
    const std::string extension = osgDB::getFileExtensionIncludingDot(pattern);
    return pattern.substr(0, pattern.size() - extension.size()) + "_" + text + extension;
}

Capture::Capture(const std::string& pattern)
    : _number(takeLowestNumber()), _file(getFileName(pattern, _number))
{
}

Capture::~Capture()
{
    std::lock_guard<std::mutex> lock(numbers().mutex);
    numbers().used.erase(_number);
}

void Capture::take(osg::State& state, unsigned int framebuffer, GLenum buffer, int width,
                   int height)
{
    if (!_frame || _frame->s() != width || _frame->t() != height)
    {
        _frame = new osg::Image;
        _frame->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    }
    // A camera may leave its own framebuffer, pack buffer and pixel store behind.
    const auto* gl = state.get<osg::GLExtensions>();
    if (gl->isFrameBufferObjectSupported)
    {
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, 0);
    }
    if (gl->isPBOSupported)
    {
        gl->glBindBuffer(GL_PIXEL_PACK_BUFFER_ARB, 0);
    }
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glPixelStorei(GL_PACK_SKIP_ROWS, 0);
    glPixelStorei(GL_PACK_SKIP_PIXELS, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    GLint previousBuffer = GL_NONE;
    glGetIntegerv(GL_READ_BUFFER, &previousBuffer);
    glReadBuffer(buffer);
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    {
        std::optional<Resolve> resolve;
        if (samples > 0)
        {
            resolve.emplace(*gl, 0, width, height);
        }
        glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, _frame->data());
    }
    glReadBuffer(previousBuffer);
    if (framebuffer)
    {
        gl->glBindFramebuffer(GL_FRAMEBUFFER_EXT, framebuffer);
    }
}

bool Capture::write(std::string& error) const
{
    if (!_frame)
    {
        error = "no frame was drawn, so '" + _file +
                "' is not written; let the viewer draw (OSG_RUN_FRAME_COUNT of 1 or more)";
        return false;
    }
    const auto result = osgDB::Registry::instance()->writeImage(
        *_frame, _file, osgDB::Registry::instance()->getOptions());
    if (result.success())
    {
        return true;
    }
    const bool unknown = result.status() == osgDB::ReaderWriter::WriteResult::FILE_NOT_HANDLED ||
                         result.status() == osgDB::ReaderWriter::WriteResult::NOT_IMPLEMENTED;
    error = "cannot write '" + _file + "': " +
            (unknown ? "no plugin writes this type; use .png"
                     : "check that its folder exists and that you may write there") +
            (result.message().empty() ? "" : " (" + result.message() + ")");
    return false;
}

} // namespace osgHeadless
