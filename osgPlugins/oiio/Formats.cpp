// SPDX-License-Identifier: MIT
#include <osgPlugins/oiio/Formats.h>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>

namespace osgKitsOiio
{

namespace
{

bool isTestFormat(const std::string& format)
{
    return format == "null" || format == "term";
}

std::vector<std::string> listAttribute(const char* name)
{
    return OIIO::Strutil::splits(OIIO::get_string_attribute(name), ",");
}

bool contains(const std::vector<std::string>& list, const std::string& value)
{
    return std::find(list.begin(), list.end(), value) != list.end();
}

} // namespace

ExtensionMap readableExtensions()
{
    const std::vector<std::string> readable = listAttribute("input_format_list");
    ExtensionMap extensions;
    // openexr:exr,sxr,mxr;tiff:tif,…
    for (const std::string& entry :
         OIIO::Strutil::splits(OIIO::get_string_attribute("extension_list"), ";"))
    {
        const std::string format = entry.substr(0, entry.find(':'));
        if (format.size() == entry.size() || isTestFormat(format) || !contains(readable, format))
        {
            continue;
        }
        for (const std::string& extension :
             OIIO::Strutil::splits(entry.substr(format.size() + 1), ","))
        {
            extensions.emplace(extension, format);
        }
        extensions.emplace(format, format);
    }
    return extensions;
}

ExtensionMap readableExtensions(const std::string& extension)
{
    ExtensionMap one;
    const ExtensionMap all = readableExtensions();
    if (const auto found = all.find(extension); found != all.end())
    {
        one.insert(*found);
    }
    return one;
}

std::string usualExtension(const std::string& format)
{
    const std::string list = ";" + std::string(OIIO::get_string_attribute("extension_list"));
    const auto found = list.find(";" + format + ":");
    if (found == std::string::npos)
    {
        return format;
    }
    const auto begin = found + format.size() + 2;
    return list.substr(begin, list.find_first_of(",;", begin) - begin);
}

bool isWritable(const std::string& format)
{
    return !isTestFormat(format) && contains(listAttribute("output_format_list"), format);
}

std::vector<std::string> formatsReadFromMemory()
{
    std::vector<std::string> formats;
    for (const std::string& format : listAttribute("input_format_list"))
    {
        // Targa files of version 1 have no signature: any bytes may pass for one.
        if (isTestFormat(format) || format == "targa")
        {
            continue;
        }
        const auto input = OIIO::ImageInput::create(format);
        if (input && input->supports("ioproxy"))
        {
            formats.push_back(format);
        }
    }
    return formats;
}

} // namespace osgKitsOiio
