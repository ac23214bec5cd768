// SPDX-License-Identifier: MIT
#include "GalleryPage.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/fstream>

#include <cstdio>

namespace osgrender
{

namespace
{

constexpr char Head[] = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>osgKits gallery</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 2em auto; max-width: 76em; padding: 0 1em; color: #222; }
article { display: flex; flex-wrap: wrap; gap: 1.5em; padding: 1.5em 0; border-top: 1px solid #ccc; }
img { width: 32em; max-width: 100%; height: auto; align-self: flex-start; }
div { flex: 1; min-width: 20em; }
h2 { margin: 0 0 .3em; font-size: 1.2em; }
code, pre { font: 12px/1.4 monospace; overflow-wrap: anywhere; white-space: pre-wrap; }
table { border-collapse: collapse; margin: .6em 0; }
td { padding: 0 1.2em 0 0; vertical-align: top; }
.failed { color: #a00; }
</style>
</head>
<body>
<h1>osgKits gallery</h1>
)html";

std::string escape(const std::string& text)
{
    std::string result;
    for (char c : text)
    {
        switch (c)
        {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

/// `file` as seen from the page's folder; a file elsewhere keeps its full path.
std::string relativeTo(const std::string& page, const std::string& file)
{
    const std::string folder = osgDB::getFilePath(osgDB::getRealPath(page)) + "/";
    const std::string path = osgDB::getRealPath(file);
    return path.compare(0, folder.size(), folder) == 0 ? path.substr(folder.size()) : path;
}

std::string row(const char* name, const std::string& value)
{
    return std::string("<tr><td>") + name + "</td><td>" + value + "</td></tr>\n";
}

std::string milliseconds(const Times& times)
{
    if (times.milliseconds.empty())
        return "not measured";
    char text[120];
    std::snprintf(text, sizeof(text), "median %.2f, p99 %.2f, min %.2f ms of %zu",
                  times.quantile(0.5), times.quantile(0.99), times.quantile(0.0),
                  times.milliseconds.size());
    return text;
}

std::string whole(double value)
{
    char text[40];
    std::snprintf(text, sizeof(text), "%.0f", value);
    return text;
}

std::string table(const Report& report)
{
    return "<table>\n" + row("frame", milliseconds(report.frame)) +
           row("cull", milliseconds(report.cull)) + row("draw", milliseconds(report.draw)) +
           row("GPU", milliseconds(report.gpu)) +
           row("passes, draw calls, triangles", whole(report.passes) + ", " +
                                                    whole(report.drawCalls) + ", " +
                                                    whole(report.triangles)) +
           row("programs compiled, reused",
               whole(report.programsCompiled) + ", " + whole(report.programsReused)) +
           row("textures", whole(report.textureBytes / 1024.0) + " KiB") +
           row("picture", std::to_string(report.width) + "x" + std::to_string(report.height) +
                              ", " + std::to_string(report.samples) + " samples") +
           row("GL errors, warnings",
               std::to_string(report.glErrors) + ", " + std::to_string(report.warnings)) +
           "</table>\n";
}

std::string article(const GalleryEntry& entry, const std::string& page)
{
    std::string html = "<article>\n";
    if (!entry.picture.empty())
    {
        const std::string source = escape(relativeTo(page, entry.picture));
        html += "<a href=\"" + source + "\"><img loading=\"lazy\" src=\"" + source + "\" alt=\"" +
                escape(entry.title) + "\"></a>\n";
    }
    html += "<div>\n<h2>" + escape(entry.title) + "</h2>\n<code>" + escape(entry.report.model) +
            "</code>\n";
    if (!entry.error.empty())
        return html + "<p class=\"failed\">" + escape(entry.place + ": " + entry.error) +
               "</p>\n</div>\n</article>\n";
    return html + table(entry.report) + "<details><summary>Plan</summary><pre>" +
           escape(planText(entry.report)) + "</pre></details>\n</div>\n</article>\n";
}

} // namespace

bool writeGalleryPage(const std::string& file, const std::vector<GalleryEntry>& entries,
                      std::string& error)
{
    const std::string folder = osgDB::getFilePath(file);
    if (!folder.empty())
        osgDB::makeDirectory(folder);
    osgDB::ofstream stream(file.c_str());
    stream << Head;
    if (!entries.empty())
    {
        const Renderer& renderer = entries.front().report.renderer;
        stream << "<p>" << entries.size() << " renders, " << escape(renderer.name) << ", OpenGL "
               << escape(renderer.version) << ".</p>\n";
    }
    for (const GalleryEntry& entry : entries)
        stream << article(entry, file);
    stream << "</body>\n</html>\n";
    stream.close();
    if (!stream)
        error = "can't write '" + file + "'";
    return error.empty();
}

} // namespace osgrender
