// SPDX-License-Identifier: MIT
#include <osgPagedTexture/OiioModule.h>

#include <filesystem>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace osgPagedTexture
{

namespace
{

struct Loaded
{
    const OiioFunctions* functions = nullptr;
    std::string cause;
};

#ifdef _WIN32

Loaded load()
{
    HMODULE module = LoadLibraryA("osgPagedTextureOiio.dll");
    const auto entry =
        module ? reinterpret_cast<OiioEntry>(GetProcAddress(module, "osgPagedTextureOiio"))
               : nullptr;
    return entry ? Loaded{entry(), {}} : Loaded{nullptr, "osgPagedTextureOiio.dll is missing"};
}

#else

/// The module lies beside this library.
Loaded load()
{
    Dl_info here;
    const bool known = dladdr(reinterpret_cast<void*>(&load), &here) != 0;
    const std::string path = (std::filesystem::path(known ? here.dli_fname : "").parent_path() /
                              "osgPagedTextureOiio.so")
                                 .string();
    // Never closed: OpenImageIO keeps threads.
    void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const auto entry =
        module ? reinterpret_cast<OiioEntry>(dlsym(module, "osgPagedTextureOiio")) : nullptr;
    if (entry)
    {
        return {entry(), {}};
    }
    const char* const cause = dlerror();
    return {nullptr, cause ? cause : path};
}

#endif

} // namespace

const OiioFunctions& oiioFunctions()
{
    static const Loaded loaded = load();
    if (!loaded.functions)
    {
        throw ImageError(ImageError::Kind::Unsupported,
                         "osgPagedTexture: formats other than JPEG and PPM cannot be read or "
                         "written, as a module is missing (" +
                             loaded.cause + "); install it anew");
    }
    return *loaded.functions;
}

} // namespace osgPagedTexture
