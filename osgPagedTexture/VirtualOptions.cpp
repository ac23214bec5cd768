// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualOptions.h>

#include <osgPagedTexture/OptionText.h>

namespace osgPagedTexture
{

namespace
{

VirtualOption storeOption()
{
    return {"store", "<file or folder>",
            "The tile store that all textures in unit 0 show; a relative path is looked for as "
            "the model is",
            [](VirtualSettings& settings, const std::string& text) -> std::string
            {
                settings.store = text;
                return {};
            },
            [](const VirtualSettings& settings) { return settings.store; }};
}

} // namespace

const std::vector<VirtualOption>& virtualOptions()
{
    using S = VirtualSettings;
    static const std::vector<VirtualOption> options = {
        storeOption(),
        number("gpu", &S::gpuMegabytes, 0.0, 1048576.0, "MiB of pages on the GPU"),
        number("cpu", &S::cpuMegabytes, 0.0, 1048576.0, "MiB of pages in memory"),
        number("upload", &S::uploadMilliseconds, 0.01, 1000.0,
               "Milliseconds of a frame that uploads may take, those of paged textures included"),
        threadsOption<S>(),
        compressionOption<S>("Texels on the GPU: BC1, or BC7 where there is alpha; BC7; not "
                             "compressed"),
        qualityOption<S>(),
        number("aniso", &S::anisotropy, 0u, 16u,
               "Taps along the longer side of a pixel's footprint; 0: as each texture says"),
        number("feedback", &S::feedback, 1u, 64u,
               "Pixels of a side that one pixel of the feedback stands for"),
        number("fade", &S::fadeSeconds, 0.0, 10.0, "Seconds in which a new page fades in"),
        flag("wait", &S::wait,
             "Frames wait for the pages that they need: for pictures, not for moving about"),
        flag("watch", &S::watch, "Stores that change are read again"),
        flag("freeze", &S::freeze, "No page comes or goes"),
        choice<VirtualShow>("show", &S::show,
                            {{"picture", VirtualShow::Picture},
                             {"levels", VirtualShow::Levels},
                             {"pages", VirtualShow::Pages}},
                            "The textures, a colour for the level of each pixel, or the borders "
                            "of pages over them"),
        flag("graph", &S::graph, "Says once a second what pages do"),
        flag("keys", &S::keys, "Answers to keys in osgviewer"),
    };
    return options;
}

bool setVirtualOption(VirtualSettings& settings, const std::string& name, const std::string& value,
                      std::string& error)
{
    return osgMultiRender::setOption(virtualOptions(), settings, name, value, error);
}

std::string formatVirtualOptions(const VirtualSettings& settings)
{
    return osgMultiRender::formatOptions(virtualOptions(), settings);
}

std::vector<std::string> parseVirtualOptions(VirtualSettings& settings, const std::string& text)
{
    return osgMultiRender::parseOptions(virtualOptions(), settings, text);
}

} // namespace osgPagedTexture
