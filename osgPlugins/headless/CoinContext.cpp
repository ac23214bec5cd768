// SPDX-License-Identifier: MIT
#include "CoinContext.h"

#include "ExitStatus.h"
#include "Report.h"

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <dlfcn.h>
#include <link.h>

#include <mutex>
#include <vector>

namespace osgHeadless
{

namespace
{

// Coin's cc_glglue_offscreen_cb_functions. Declared here because the plugins neither need Coin's
// headers nor link to it.
struct CoinCallbacks
{
    void* (*create)(unsigned int width, unsigned int height);
    int (*makeCurrent)(void* context);
    void (*reinstatePrevious)(void* context);
    void (*destruct)(void* context);
};

struct OffscreenContext
{
    std::unique_ptr<Surface> surface;
    std::function<void()> reinstate;
};

Backend* coinBackend = nullptr;

void* createContext(unsigned int width, unsigned int height)
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = static_cast<int>(width);
    traits->height = static_cast<int>(height);
    std::string error;
    auto surface = coinBackend->getLimits(error)
                       ? coinBackend->createSurface(*traits, nullptr, error)
                       : nullptr;
    if (!surface)
    {
        reportOnce(*coinBackend, error);
        return nullptr;
    }
    return new OffscreenContext{std::move(surface), {}};
}

int makeContextCurrent(void* data)
{
    auto* context = static_cast<OffscreenContext*>(data);
    context->reinstate = coinBackend->rememberCurrent();
    return context->surface->makeCurrent();
}

void reinstatePreviousContext(void* data)
{
    auto* context = static_cast<OffscreenContext*>(data);
    if (context->reinstate)
    {
        context->reinstate();
    }
}

void destructContext(void* data)
{
    delete static_cast<OffscreenContext*>(data);
}

CoinCallbacks callbacks = {createContext, makeContextCurrent, reinstatePreviousContext,
                           destructContext};

using SetCallbacks = void (*)(CoinCallbacks*);

// Asks each loaded library, so that neither Coin's file name nor its version matters, nor whether
// the program or a plugin loaded it.
SetCallbacks findInLoadedLibraries()
{
    std::vector<std::string> names;
    dl_iterate_phdr(
        [](dl_phdr_info* info, size_t, void* data)
        {
            static_cast<std::vector<std::string>*>(data)->emplace_back(info->dlpi_name);
            return 0;
        },
        &names);
    for (const std::string& name : names)
    {
        void* library =
            name.empty() ? nullptr : dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NOLOAD);
        void* function =
            library ? dlsym(library, "cc_glglue_context_set_offscreen_cb_functions") : nullptr;
        if (library)
        {
            dlclose(library);
        }
        if (function)
        {
            return reinterpret_cast<SetCallbacks>(function);
        }
    }
    return nullptr;
}

bool hookCoin()
{
    static std::mutex mutex;
    static bool hooked = false;
    std::lock_guard<std::mutex> lock(mutex);
    if (hooked)
    {
        return true;
    }
    const SetCallbacks setCallbacks = findInLoadedLibraries();
    if (setCallbacks)
    {
        // Coin keeps the callbacks, and calls them in its own clean-up at exit.
        keepLibraryMapped();
        setCallbacks(&callbacks);
        hooked = true;
    }
    return hooked;
}

void prepareFor(const std::string& extension)
{
    auto* registry = osgDB::Registry::instance();
    const std::string library = registry->createLibraryNameForExtension("iv");
    if (registry->createLibraryNameForExtension(osgDB::convertToLowerCase(extension)) == library &&
        !hookCoin() && registry->loadLibrary(library) != osgDB::Registry::NOT_LOADED)
    {
        hookCoin();
    }
}

} // namespace

CoinContext::CoinContext(Backend& backend)
{
    coinBackend = &backend;
    // Where osgdb_iv came first it is also asked first.
    hookCoin();
}

bool CoinContext::acceptsExtension(const std::string& extension) const
{
    // The registry asks this on the way to a reader for a stream.
    prepareFor(extension);
    return false;
}

osgDB::ReaderWriter::ReadResult CoinContext::readObject(const std::string& file,
                                                        const Options*) const
{
    prepareFor(osgDB::getFileExtension(file));
    return ReadResult::FILE_NOT_HANDLED;
}

osgDB::ReaderWriter::ReadResult CoinContext::readNode(const std::string& file, const Options*) const
{
    prepareFor(osgDB::getFileExtension(file));
    return ReadResult::FILE_NOT_HANDLED;
}

} // namespace osgHeadless
