// SPDX-License-Identifier: MIT
#include "Arguments.h"
#include "Backend.h"
#include "GalleryPage.h"
#include "Output.h"
#include "Progress.h"
#include "RenderJob.h"
#include "Script.h"

#include <osg/Timer>
#include <osgDB/FileNameUtils>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace osgrender;

namespace
{

enum ExitStatus
{
    Done = 0,
    Failed = 1,
    WrongArguments = 2
};

int complain(const std::string& error, ExitStatus status)
{
    std::fprintf(stderr, "osgrender: %s\n", error.c_str());
    return status;
}

/// Timing frames are drawn where somebody reads the times.
void settleTiming(Arguments& arguments, bool page)
{
    if (arguments.timingFrames < 0)
        arguments.timingFrames = page || !arguments.stats.empty() ? 10 : 0;
}

std::string captionOf(const Arguments& arguments, const Report& report)
{
    return arguments.title.empty() ? osgDB::getSimpleFileName(report.model) : arguments.title;
}

/// The first output that a browser shows.
std::string browserPicture(const Arguments& arguments)
{
    for (const std::string& output : arguments.outputs)
    {
        const std::string extension = osgDB::getLowerCaseFileExtension(output);
        if (extension == "png" || extension == "jpg" || extension == "jpeg" || extension == "webp")
            return fileOfFrame(output, arguments.frames - 1);
    }
    return std::string();
}

int renderOne(const ProcessArguments& process, Backend backend, WarningCounter& counter)
{
    Arguments arguments;
    std::string error;
    if (!parseRender(process.rest, arguments, error))
        return complain(error, WrongArguments);
    settleTiming(arguments, false);
    RenderJob job(arguments, backend, counter);
    if (!job.run(error))
        return complain(error, job.isUsageError() ? WrongArguments : Failed);
    return Done;
}

/// Renders one line of a script; `entry.error` tells of a failure.
void renderLine(const ScriptLine& line, const ProcessArguments& process, Backend backend,
                WarningCounter& counter, GalleryEntry& entry)
{
    entry.place = entry.title = line.place;
    entry.error = line.error;
    std::vector<std::string> words = process.rest;
    words.insert(words.end(), line.words.begin(), line.words.end());
    ProcessArguments own;
    Arguments arguments;
    if (!entry.error.empty() || !parseProcess(words, own, entry.error))
        return;
    if (own.backend != Backend::Auto || !own.scripts.empty() || !own.definitions.empty() ||
        !own.page.empty() || own.help || own.listKeys)
    {
        entry.error = "--backend, --html, --help, --list-keys, -D and @script concern the whole "
                      "process, not a line";
        return;
    }
    if (!parseRender(own.rest, arguments, entry.error))
        return;
    settleTiming(arguments, !process.page.empty());
    RenderJob job(arguments, backend, counter);
    job.run(entry.error);
    entry.report = job.getReport();
    entry.title = captionOf(arguments, entry.report);
    if (entry.report.frame.milliseconds.size())
        entry.picture = browserPicture(arguments);
}

/// What -o names first, to be shown before the line is parsed.
std::string firstPicture(const ScriptLine& line)
{
    const auto found = std::find(line.words.begin(), line.words.end(), "-o");
    const bool named = found != line.words.end() && found + 1 != line.words.end();
    return named ? osgDB::getSimpleFileName(*(found + 1)) : std::string();
}

bool readScripts(const ProcessArguments& process, std::vector<ScriptLine>& lines,
                 std::string& error)
{
    for (const std::string& script : process.scripts)
    {
        if (!readScript(script, process.definitions, lines, error))
            return false;
    }
    return true;
}

int renderScripts(const ProcessArguments& process, Backend backend, WarningCounter& counter)
{
    std::string error;
    std::vector<ScriptLine> lines;
    if (!readScripts(process, lines, error))
        return complain(error, Failed);

    osg::Timer total;
    Progress progress(lines.size());
    std::vector<GalleryEntry> entries;
    std::vector<Failure> failures;
    for (const ScriptLine& line : lines)
    {
        osg::Timer timer;
        progress.begin(line.place + " " + firstPicture(line));
        GalleryEntry& entry = entries.emplace_back();
        renderLine(line, process, backend, counter, entry);
        if (!entry.error.empty())
            failures.push_back({entry.place, entry.error});
        progress.end(timer.time_s(), !entry.error.empty());
    }
    printFailures(failures, lines.size());
    if (!process.page.empty() && !writeGalleryPage(process.page, entries, error))
        complain(error, Failed);
    std::printf("osgrender: %zu renders, %zu failed, in %.1f s\n", lines.size(), failures.size(),
                total.time_s());
    return failures.empty() && error.empty() ? Done : Failed;
}

} // namespace

int main(int argc, char** argv)
{
    ProcessArguments process;
    std::string error;
    if (!parseProcess(std::vector<std::string>(argv + 1, argv + argc), process, error))
        return complain(error, WrongArguments);
    addPluginFolders();
    if (process.help)
    {
        printHelp();
        return Done;
    }
    if (process.listKeys)
        return printKeys() ? Done
                           : complain("--list-keys: neither osgdb_shadowvolume nor osgdb_labels is "
                                      "found; OSG_LIBRARY_PATH says where plugins are",
                                      Failed);
    if (argc < 2)
        return complain("no model given; osgrender --help lists all switches", WrongArguments);
    if (process.scripts.empty() && !process.page.empty())
        return complain("--html goes with @script", WrongArguments);

    // Readers tell of each file at NOTICE; a script is better off without.
    if (!std::getenv("OSG_NOTIFY_LEVEL") && !std::getenv("OSGNOTIFYLEVEL"))
        osg::setNotifyLevel(osg::WARN);
    osg::ref_ptr<WarningCounter> counter = new WarningCounter;
    osg::setNotifyHandler(counter.get());
    const Backend backend = chooseBackend(process.backend, argv, error);
    if (!error.empty())
        return complain(error, Failed);
    return process.scripts.empty() ? renderOne(process, backend, *counter)
                                   : renderScripts(process, backend, *counter);
}
