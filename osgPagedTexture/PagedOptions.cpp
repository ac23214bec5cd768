// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedOptions.h>

#include <osgPagedTexture/OptionText.h>

namespace osgPagedTexture
{

namespace
{

PagedOption cacheOption()
{
    return {"cache", "default|off|<folder>",
            "Where encoded textures are kept, so that a second start decodes nothing",
            [](PagedSettings& settings, const std::string& text) -> std::string
            {
                if (text.empty())
                    return "a folder needs a name; 'off' keeps nothing";
                settings.cache = text;
                return {};
            },
            [](const PagedSettings& settings) { return settings.cache; }};
}

} // namespace

const std::vector<PagedOption>& pagedOptions()
{
    using S = PagedSettings;
    static const std::vector<PagedOption> options = {
        number("gpu", &S::gpuMegabytes, 0.0, 1048576.0, "MiB of textures on the GPU"),
        number("cpu", &S::cpuMegabytes, 0.0, 1048576.0,
               "MiB of pictures and encoded textures on their way to it"),
        number("upload", &S::uploadMilliseconds, 0.01, 1000.0,
               "Milliseconds of a frame that uploads may take"),
        number("preview", &S::previewSide, 1u, 1024u, "Texels of a side of what is shown first"),
        number("prefetch", &S::prefetchSeconds, 0.0, 60.0,
               "Seconds that the motion of the eye is looked ahead"),
        threadsOption<S>(),
        compressionOption<S>("Texels on the GPU: BC1, BC3, BC4 and BC5; BC7 where GL has it; not "
                             "compressed"),
        qualityOption<S>(),
        cacheOption(),
        number("cachesize", &S::cacheMegabytes, 0.0, 1048576.0 * 64.0, "MiB of that folder"),
        flag("wait", &S::wait,
             "Frames wait for the textures that they need: for pictures, not for moving about"),
        flag("reload", &S::reload, "Image files that change are read again"),
        flag("degraded", &S::degraded, "What can be read of damaged image files is shown"),
        flag("freeze", &S::freeze, "No texture comes or goes"),
        choice<PagedShow>("show", &S::show,
                          {{"picture", PagedShow::Picture}, {"levels", PagedShow::Levels}},
                          "The textures, or a colour for how fine each of them is"),
        flag("graph", &S::graph, "Shows times of uploads and memory over the picture"),
        flag("keys", &S::keys, "Answers to keys in osgviewer"),
    };
    return options;
}

bool setPagedOption(PagedSettings& settings, const std::string& name, const std::string& value,
                    std::string& error)
{
    return osgMultiRender::setOption(pagedOptions(), settings, name, value, error);
}

std::string formatPagedOptions(const PagedSettings& settings)
{
    return osgMultiRender::formatOptions(pagedOptions(), settings);
}

std::vector<std::string> parsePagedOptions(PagedSettings& settings, const std::string& text)
{
    return osgMultiRender::parseOptions(pagedOptions(), settings, text);
}

} // namespace osgPagedTexture
