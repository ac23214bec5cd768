// SPDX-License-Identifier: MIT
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

/// A compatibility context without a surface, current on this thread; no OSG.
class PlainContext
{
public:
    PlainContext()
    {
        const auto getDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
            eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (!getDisplay)
        {
            return;
        }
        _display = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        const EGLint attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglInitialize(_display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
        {
            return;
        }
        eglChooseConfig(_display, attributes, &config, 1, &count);
        _context =
            eglCreateContext(_display, count ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
        _current = _context && eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, _context);
    }

    ~PlainContext()
    {
        if (_current)
        {
            eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(_display, _context);
        }
    }

    bool current() const { return _current; }

private:
    EGLDisplay _display = EGL_NO_DISPLAY;
    EGLContext _context = EGL_NO_CONTEXT;
    bool _current = false;
};

/// A test that draws in a PlainContext: skipped where there is none, failed where one is required.
class PlainGLTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        if (_context.current())
        {
            return;
        }
        if (std::getenv("OSGKITS_REQUIRE_GL"))
        {
            FAIL() << "no EGL context, and OSGKITS_REQUIRE_GL is set";
        }
        GTEST_SKIP() << "no surfaceless EGL context: nothing was drawn";
    }

    bool hasContext() const { return _context.current(); }

private:
    PlainContext _context;
};

/// A program made of texts; `log` holds what compiler and linker said.
class PlainProgram
{
public:
    PlainProgram() : _id(glCreateProgram()) {}
    ~PlainProgram() { glDeleteProgram(_id); }
    PlainProgram(const PlainProgram&) = delete;
    PlainProgram& operator=(const PlainProgram&) = delete;

    GLuint id() const { return _id; }
    const std::string& log() const { return _log; }

    bool add(GLenum stage, const std::string& text)
    {
        const GLuint shader = glCreateShader(stage);
        const char* bytes = text.data();
        const auto length = static_cast<GLint>(text.size());
        glShaderSource(shader, 1, &bytes, &length);
        glCompileShader(shader);
        GLint ok = 0, size = 0;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
        glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &size);
        std::string log(static_cast<std::size_t>(size) + 1, '\0');
        glGetShaderInfoLog(shader, size + 1, nullptr, &log[0]);
        _log += log.c_str();
        glAttachShader(_id, shader);
        glDeleteShader(shader);
        return ok;
    }

    bool link()
    {
        glLinkProgram(_id);
        GLint ok = 0, size = 0;
        glGetProgramiv(_id, GL_LINK_STATUS, &ok);
        glGetProgramiv(_id, GL_INFO_LOG_LENGTH, &size);
        std::string log(static_cast<std::size_t>(size) + 1, '\0');
        glGetProgramInfoLog(_id, size + 1, nullptr, &log[0]);
        _log += log.c_str();
        return ok;
    }

private:
    GLuint _id;
    std::string _log;
};

/// Colour targets and a depth buffer of 64 x 64 pixels, drawn to with a quad in clip coordinates.
class PlainTarget
{
public:
    static constexpr int Size = 64;

    PlainTarget(int count, bool integers) : _count(count), _integers(integers), _textures(count)
    {
        glGenFramebuffers(1, &_frame);
        glBindFramebuffer(GL_FRAMEBUFFER, _frame);
        glGenTextures(count, _textures.data());
        std::vector<GLenum> buffers;
        for (int i = 0; i < count; ++i)
        {
            glBindTexture(GL_TEXTURE_2D, _textures[i]);
            glTexStorage2D(GL_TEXTURE_2D, 1, integers ? GL_RGBA8UI : GL_RGBA8, Size, Size);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i, GL_TEXTURE_2D,
                                   _textures[i], 0);
            buffers.push_back(GL_COLOR_ATTACHMENT0 + i);
        }
        glGenRenderbuffers(1, &_depth);
        glBindRenderbuffer(GL_RENDERBUFFER, _depth);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, Size, Size);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, _depth);
        glDrawBuffers(count, buffers.data());
        glViewport(0, 0, Size, Size);
    }

    ~PlainTarget()
    {
        glDeleteFramebuffers(1, &_frame);
        glDeleteRenderbuffers(1, &_depth);
        glDeleteTextures(_count, _textures.data());
    }

    /// Draws the quad twice, at depth 0.5 and 0.75 with less-or-equal, so that a written depth
    /// shows; returns the bytes of all targets.
    std::vector<unsigned char> draw(const PlainProgram& program)
    {
        const GLuint zero[] = {0, 0, 0, 0};
        const GLfloat black[] = {0, 0, 0, 0};
        const GLfloat far = 1.0f;
        for (int i = 0; i < _count; ++i)
        {
            _integers ? glClearBufferuiv(GL_COLOR, i, zero) : glClearBufferfv(GL_COLOR, i, black);
        }
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glClearBufferfv(GL_DEPTH, 0, &far);
        glUseProgram(program.id());
        glColor4f(1.0f, 0.75f, 0.5f, 1.0f);
        quad(0.0f);
        glUseProgram(0);
        if (!_integers)
        {
            glColor4f(0.0f, 0.0f, 1.0f, 1.0f);
            quad(0.5f);
        }
        return read();
    }

private:
    static void quad(float z)
    {
        glBegin(GL_TRIANGLE_STRIP);
        for (int i = 0; i < 4; ++i)
        {
            const float x = i & 1 ? 1.0f : -1.0f, y = i & 2 ? 1.0f : -1.0f;
            glNormal3f(x * 0.3f, y * 0.3f, 0.9f);
            glMultiTexCoord2f(GL_TEXTURE0, x * 2.0f, y * 2.0f);
            glVertex3f(x, y, z);
        }
        glEnd();
    }

    std::vector<unsigned char> read()
    {
        const std::size_t bytes = static_cast<std::size_t>(Size) * Size * 4;
        std::vector<unsigned char> all(bytes * _textures.size());
        for (std::size_t i = 0; i < _textures.size(); ++i)
        {
            glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
            glReadPixels(0, 0, Size, Size, _integers ? GL_RGBA_INTEGER : GL_RGBA, GL_UNSIGNED_BYTE,
                         &all[i * bytes]);
        }
        return all;
    }

    int _count;
    bool _integers;
    std::vector<GLuint> _textures;
    GLuint _frame = 0, _depth = 0;
};
