// SPDX-License-Identifier: MIT
#include "Backend.h"

#include <osg/GraphicsContext>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace osgrender
{

namespace
{

constexpr char OsmesaLibrary[] = "libOSMesa.so.8";
constexpr char Restarted[] = "OSGRENDER_RESTARTED";

std::string programFolder()
{
    char path[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof(path));
    return length > 0 ? osgDB::getFilePath(std::string(path, std::size_t(length))) : std::string();
}

bool isOsmesaPreloaded()
{
    const char* preload = std::getenv("LD_PRELOAD");
    return preload && std::strstr(preload, "libOSMesa");
}

bool loadPlugin(const std::string& name, std::string& error)
{
    osgDB::Registry* registry = osgDB::Registry::instance();
    const std::string library = registry->createLibraryNameForExtension(name);
    if (registry->loadLibrary(library) != osgDB::Registry::NOT_LOADED)
        return true;
    error = "the plugin " + library +
            " can't be loaded; set OSG_LIBRARY_PATH to the folder that holds " +
            osgDB::getFilePath(library);
    return false;
}

/// Whether the loaded plugin makes contexts on this machine.
bool makesContexts()
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = traits->height = 16;
    traits->pbuffer = true;
    osg::ref_ptr<osg::GraphicsContext> context =
        osg::GraphicsContext::createGraphicsContext(traits.get());
    return context && context->valid();
}

/// Runs the same command again with OSMesa first in the symbol order. Returns only on failure.
void restartWithOsmesa(char** argv, std::string& error)
{
    if (std::getenv(Restarted))
    {
        error = std::string(OsmesaLibrary) + " could not be preloaded; install libosmesa6";
        return;
    }
    const char* preload = std::getenv("LD_PRELOAD");
    const std::string libraries =
        preload && *preload ? std::string(OsmesaLibrary) + ":" + preload : OsmesaLibrary;
    setenv("LD_PRELOAD", libraries.c_str(), 1);
    setenv(Restarted, "1", 1);
    execv("/proc/self/exe", argv);
    error = std::string("can't start again with ") + OsmesaLibrary + ": " + std::strerror(errno);
}

} // namespace

void addPluginFolders()
{
    const std::string folder = programFolder();
    if (folder.empty())
        return;
    osgDB::FilePathList& paths = osgDB::Registry::instance()->getLibraryFilePathList();
    for (const char* name : {"lib", OSGRENDER_LIBRARY_FOLDER})
        paths.push_back(osgDB::concatPaths(osgDB::getFilePath(folder), name));
}

Backend chooseBackend(Backend wanted, char** argv, std::string& error)
{
    if (isOsmesaPreloaded())
    {
        if (wanted == Backend::Egl)
            error = "--backend egl: libOSMesa is preloaded; unset LD_PRELOAD";
        else
            loadPlugin("osmesa", error);
        return Backend::Osmesa;
    }
    if (wanted == Backend::Osmesa)
    {
        restartWithOsmesa(argv, error);
        return Backend::Osmesa;
    }
    const bool works = loadPlugin("egl", error) && (wanted == Backend::Egl || makesContexts());
    if (!works && wanted == Backend::Auto)
    {
        error.clear();
        restartWithOsmesa(argv, error);
        return Backend::Osmesa;
    }
    return Backend::Egl;
}

} // namespace osgrender
