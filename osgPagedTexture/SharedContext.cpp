// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SharedContext.h>

#include <cstdint>

#ifndef _WIN32
#include <dlfcn.h>
#endif

namespace osgPagedTexture
{

/// What is used of EGL, if the program has loaded it: a context of EGL is current only then.
struct SharedContext::Egl
{
    using Handle = void*;
    using Number = std::int32_t;
    static constexpr Number ConfigId = 0x3028, None = 0x3038;

    Handle (*getCurrentDisplay)() = nullptr;
    Handle (*getCurrentContext)() = nullptr;
    std::uint32_t (*queryApi)() = nullptr;
    std::uint32_t (*bindApi)(std::uint32_t) = nullptr;
    std::uint32_t (*queryContext)(Handle, Handle, Number, Number*) = nullptr;
    std::uint32_t (*chooseConfig)(Handle, const Number*, Handle*, Number, Number*) = nullptr;
    Handle (*createContext)(Handle, Handle, Handle, const Number*) = nullptr;
    std::uint32_t (*makeCurrent)(Handle, Handle, Handle, Handle) = nullptr;
    std::uint32_t (*destroyContext)(Handle, Handle) = nullptr;
    std::uint32_t (*releaseThread)() = nullptr;

    Handle display = nullptr;
    Handle config = nullptr;
    Handle current = nullptr; ///< With which textures are shared.
    Handle context = nullptr;
    std::uint32_t api = 0;

    bool load()
    {
#ifdef _WIN32
        return false;
#else
        void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
        if (!library)
            return false;
        const auto find = [library](auto& function, const char* name)
        {
            function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
            return function != nullptr;
        };
        const bool isWhole =
            find(getCurrentDisplay, "eglGetCurrentDisplay") &&
            find(getCurrentContext, "eglGetCurrentContext") && find(queryApi, "eglQueryAPI") &&
            find(bindApi, "eglBindAPI") && find(queryContext, "eglQueryContext") &&
            find(chooseConfig, "eglChooseConfig") && find(createContext, "eglCreateContext") &&
            find(makeCurrent, "eglMakeCurrent") && find(destroyContext, "eglDestroyContext") &&
            find(releaseThread, "eglReleaseThread");
        dlclose(library); // Whoever has the context current keeps it.
        return isWhole;
#endif
    }

    bool findCurrent()
    {
        current = getCurrentContext();
        display = getCurrentDisplay();
        api = queryApi();
        if (!current || !display)
            return false;
        Number id = 0, count = 0;
        queryContext(display, current, ConfigId, &id);
        const Number wish[] = {ConfigId, id, None};
        return !id || (chooseConfig(display, wish, &config, 1, &count) && count == 1);
    }

    bool share()
    {
        const Number nothing[] = {None};
        if (bindApi(api) && !context)
            context = createContext(display, config, current, nothing);
        return context != nullptr;
    }
};

SharedContext::SharedContext() : _egl(std::make_unique<Egl>()) {}

SharedContext::~SharedContext()
{
    if (_egl->context)
        _egl->destroyContext(_egl->display, _egl->context);
}

std::unique_ptr<SharedContext> SharedContext::create()
{
    std::unique_ptr<SharedContext> context(new SharedContext);
    return context->_egl->load() && context->_egl->findCurrent() ? std::move(context) : nullptr;
}

bool SharedContext::makeCurrent()
{
    return _egl->share() && _egl->makeCurrent(_egl->display, nullptr, nullptr, _egl->context);
}

void SharedContext::release()
{
    _egl->makeCurrent(_egl->display, nullptr, nullptr, nullptr);
    _egl->releaseThread();
}

} // namespace osgPagedTexture
