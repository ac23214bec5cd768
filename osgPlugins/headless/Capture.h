// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>
#include <osg/State>

#include <string>

namespace osgHeadless
{

/// Keeps the last frame of a window and writes it as a picture, as OSG_HEADLESS_CAPTURE asks.
///
/// Windows are numbered from 0; a number is free again when its window closes. In the file name
/// "%d" or "%03d" stands for the number. Without it window 0 writes "file.png", window 1
/// "file_1.png". Pictures have 8-bit red, green and blue and no alpha, so they are opaque.
class Capture
{
public:
    /// The value of OSG_HEADLESS_CAPTURE; empty when no picture is asked for.
    static std::string getRequestedFile();

    /// The file of window `number`.
    static std::string getFileName(const std::string& pattern, unsigned int number);

    /// Takes the lowest free number.
    explicit Capture(const std::string& pattern);
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;
    ~Capture();

    /// Reads the finished frame from framebuffer 0. The context is current; the bound framebuffers
    /// become `framebuffer` again.
    void take(osg::State& state, unsigned int framebuffer, GLenum buffer, int width, int height);

    /// Writes the last frame. Returns false and fills `error` with cause and remedy on failure,
    /// which includes that there was no frame.
    bool write(std::string& error) const;

private:
    unsigned int _number;
    std::string _file;
    osg::ref_ptr<osg::Image> _frame;
};

} // namespace osgHeadless
