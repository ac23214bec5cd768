// SPDX-License-Identifier: MIT
#include "RenderJob.h"

#include "Output.h"

#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgUtil/Optimizer>

#include <algorithm>
#include <cstdio>
#include <thread>

namespace osgrender
{

namespace
{

/// Longer than any frame: a draw thread that died must not hang the script.
constexpr double FrameLimitSeconds = 600.0;

double now()
{
    return osg::Timer::instance()->time_m();
}

/// A command line that osg::ArgumentParser can take words out of.
struct WordList
{
    explicit WordList(const std::vector<std::string>& from) : words(from)
    {
        words.insert(words.begin(), "osgrender");
        for (std::string& word : words)
            pointers.push_back(word.data());
        count = int(pointers.size());
        pointers.push_back(nullptr);
    }

    std::vector<std::string> words;
    std::vector<char*> pointers;
    int count;
};

bool isIdle(const osgDB::DatabasePager& pager)
{
    bool idle = !pager.getRequestsInProgress();
    for (unsigned int i = 0; i < pager.getNumDatabaseThreads(); ++i)
        idle = idle && !pager.getDatabaseThread(i)->getActive();
    return idle;
}

} // namespace

RenderJob::RenderJob(const Arguments& arguments, Backend backend, WarningCounter& counter)
    : _arguments(arguments), _counter(counter)
{
    _report.backend = toString(backend);
    _report.width = arguments.width;
    _report.height = arguments.height;
    _report.frames = arguments.frames;
}

RenderJob::~RenderJob() = default;

bool RenderJob::run(std::string& error)
{
    _counter.reset();
    const bool done = makeViewer(error) && loadModel(error) &&
                      (!_arguments.drawsFrames() || drawAll(error)) && measureLight(error);
    if (_capture)
        _report.glErrors = _capture->getGlErrors() + _counter.getGlErrors();
    // Closing the context belongs to the render: what it prints counts.
    _viewer.reset();
    _report.warnings = _counter.getWarnings();
    if (!done)
        return false;
    if (_arguments.listPlan)
        std::printf("%s:\n%s", _report.model.c_str(), planText(_report).c_str());
    const bool matches = compareWithReference(error);
    std::string writeError;
    if (!_arguments.stats.empty() && !writeReport(_report, _arguments.stats, writeError))
        error = error.empty() ? writeError : error + "; " + writeError;
    return matches && error.empty();
}

bool RenderJob::drawAll(std::string& error)
{
    return openWindow(error) && placeCamera(error) && waitForTiles(error) && drawFrames(error) &&
           pickLabels(error) && timeFrames(error);
}

bool RenderJob::measureLight(std::string& error)
{
    if (!_arguments.probe.isAsked())
        return true;
    if (!measure(*_model, _arguments.probe, _report.probes, error))
    {
        error = "'" + _report.model + "': " + error;
        return false;
    }
    std::printf("%s", probeText(_report.probes).c_str());
    return _arguments.probe.csv.empty() ||
           writeProbeCsv(_report.probes, _arguments.probe.csv, error);
}

bool RenderJob::makeViewer(std::string& error)
{
    osg::DisplaySettings* settings = osg::DisplaySettings::instance();
    settings->setDefaults();
    settings->readEnvironmentalVariables();
    if (_arguments.samples >= 0)
        settings->setNumMultiSamples(static_cast<unsigned int>(_arguments.samples));
    _report.samples = int(settings->getNumMultiSamples());
    osgDB::Registry::instance()->setOptions(nullptr);

    WordList words(_arguments.viewerArguments);
    osg::ArgumentParser parser(&words.count, words.pointers.data());
    _viewer = std::make_unique<osgViewer::Viewer>(parser);
    _usageError = !takeModels(parser, _names, error);
    if (_usageError)
        return false;
    _report.model = _names.text();
    // The picture is the same with any model; one thread gives times without waiting in them.
    if (_viewer->getThreadingModel() == osgViewer::ViewerBase::AutomaticSelection &&
        !std::getenv("OSG_THREADING"))
        _viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    return true;
}

bool RenderJob::loadModel(std::string& error)
{
    const double start = now();
    _model = readModels(_names, error);
    if (!_model)
        return false;
    osgUtil::Optimizer().optimize(_model);
    _report.loadMs = now() - start;
    _contents = examine(*_model);
    if (_contents.drawables == 0 && !_contents.paged)
        OSG_WARN << "osgrender: '" << _report.model
                 << "' holds nothing to draw, the picture is the background" << std::endl;
    return true;
}

bool RenderJob::openWindow(std::string& error)
{
    _viewer->setUpViewInWindow(0, 0, _arguments.width, _arguments.height);
    osg::Camera* camera = _viewer->getCamera();
    osg::GraphicsContext* context = camera->getGraphicsContext();
    if (!context || !context->valid())
    {
        error = "no " + _report.backend + " context of " + std::to_string(_arguments.width) + "x" +
                std::to_string(_arguments.height) + " with " + std::to_string(_report.samples) +
                " samples";
        return false;
    }
    // The errors are counted at the end of each frame instead, by Capture.
    if (!std::getenv("OSG_GL_ERROR_CHECKING"))
        context->getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS);

    const auto isFloat = [this](const std::string& file) { return isFloatFile(file, _arguments); };
    const auto& outputs = _arguments.outputs;
    const bool floatPixels = std::any_of(outputs.begin(), outputs.end(), isFloat);
    _capture = new Capture(floatPixels);
    _capture->install(*camera, _report.samples);
    return true;
}

bool RenderJob::placeCamera(std::string& error)
{
    _viewer->setSceneData(_model);
    osg::Stats* stats = _viewer->getCamera()->getStats();
    stats->allocate(static_cast<unsigned int>(std::max(_arguments.timingFrames, 0) + 64));
    stats->collectStats("rendering", true);
    stats->collectStats("gpu", true);
    if (!_arguments.cameraPath.empty())
    {
        _path = readCameraPath(_arguments.cameraPath, error);
        return _path.valid();
    }
    return aim(*_viewer->getCamera(), *_model, _arguments.camera, error);
}

bool RenderJob::drawFrame(int index, bool wanted, std::string& error)
{
    const double elapsed = index * _arguments.frameSeconds;
    const double time = _arguments.startSeconds + elapsed;
    if (_path)
        follow(*_viewer->getCamera(), *_path, time * _arguments.pathSpeed);
    _capture->beginFrame(wanted);
    const double start = now();
    if (!_viewer->isRealized())
        _viewer->realize();
    _viewer->advance(time);
    _viewer->eventTraversal();
    // Shaders see this one as osg_FrameTime; the clock would give another picture each run.
    _viewer->getFrameStamp()->setReferenceTime(time);
    _viewer->updateTraversal();
    _viewer->renderingTraversals();
    if (_viewer->done() || !_capture->waitForFrame(FrameLimitSeconds))
    {
        error = "the frame was not drawn: the " + _report.backend + " context is gone";
        return false;
    }
    _lastFrameMs = now() - start;
    return true;
}

bool RenderJob::waitForTiles(std::string& error)
{
    if (!_contents.paged)
        return true;
    osgDB::DatabasePager* pager = _viewer->getDatabasePager();
    const double end = now() + 1000.0 * _arguments.pagingSeconds;
    // Between taking a request and working on it, a pager thread looks idle: so twice.
    int idle = 0;
    while (idle < 2)
    {
        if (!drawFrame(0, false, error))
            return false;
        idle = isIdle(*pager) ? idle + 1 : 0;
        if (now() > end)
        {
            OSG_WARN << "osgrender: the pager was still loading after " << _arguments.pagingSeconds
                     << " s (--paging-limit), tiles may be missing" << std::endl;
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

bool RenderJob::drawFrames(std::string& error)
{
    const auto numbered = [](const std::string& output) { return hasFrameNumber(output); };
    const auto& outputs = _arguments.outputs;
    const bool all = std::any_of(outputs.begin(), outputs.end(), numbered);
    const unsigned int first = _viewer->getFrameStamp()->getFrameNumber() + 2;
    for (int i = 0; i < _arguments.frames; ++i)
    {
        const bool last = i + 1 == _arguments.frames;
        _viewer->getCamera()->getStats()->collectStats("scene", last);
        if (!drawFrame(i, all || last, error))
            return false;
        if (i == 0)
            _report.firstFrameMs = _lastFrameMs;
        if (i > 0 || last)
            _report.frame.milliseconds.push_back(_lastFrameMs);
        if (!_capture->getPicture() && (all || last))
        {
            error = "the frame could not be read back";
            return false;
        }
        if ((all || last) && !writeFrame(i, error))
            return false;
    }
    gatherStatistics();
    gatherTimes(_arguments.frames > 1 ? first : first - 1);
    measureCoverage();
    return true;
}

bool RenderJob::pickLabels(std::string& error)
{
    for (const PickPoint& point : _arguments.picks)
    {
        if (!askLabels(*_model, point, _arguments.width, _arguments.height, error) ||
            !drawFrame(_arguments.frames - 1, false, error))
            return false;
        const std::vector<PickResult> results = takeAnswers(*_model, point);
        _report.picks.insert(_report.picks.end(), results.begin(), results.end());
    }
    std::printf("%s", pickText(_report.picks).c_str());
    return true;
}

bool RenderJob::timeFrames(std::string& error)
{
    if (_arguments.timingFrames <= 0)
        return true;
    _viewer->getCamera()->getStats()->collectStats("scene", false);
    _report.frame = Times();
    const unsigned int first = _viewer->getFrameStamp()->getFrameNumber() + 1;
    for (int i = 0; i < _arguments.timingFrames; ++i)
    {
        if (!drawFrame(_arguments.frames - 1, false, error))
            return false;
        _report.frame.milliseconds.push_back(_lastFrameMs);
    }
    gatherTimes(first);
    return true;
}

bool RenderJob::writeFrame(int index, std::string& error)
{
    const bool last = index + 1 == _arguments.frames;
    for (const std::string& output : _arguments.outputs)
    {
        if ((last || hasFrameNumber(output)) &&
            !writePicture(*_capture->getPicture(), fileOfFrame(output, index),
                          isFloatFile(output, _arguments), error))
            return false;
    }
    return true;
}

bool RenderJob::compareWithReference(std::string& error)
{
    if (_arguments.reference.empty())
        return true;
    const osg::ref_ptr<osg::Image> reference = osgDB::readRefImageFile(_arguments.reference);
    if (!reference)
    {
        error = "reference '" + _arguments.reference + "' can't be read";
        return false;
    }
    const Comparison found = compare(*_capture->getPicture(), *reference, _arguments.tolerance);
    if (!found.sameSize)
    {
        error = "reference '" + _arguments.reference + "' is " + std::to_string(reference->s()) +
                "x" + std::to_string(reference->t()) + ", the picture " +
                std::to_string(_arguments.width) + "x" + std::to_string(_arguments.height);
        return false;
    }
    char finding[200];
    std::snprintf(
        finding, sizeof(finding),
        "%.4g %% of the pixels off by more than %.4g (allowed %.4g %%), the worst by %.4g "
        "(allowed %.4g) at x %d, y %d from the bottom left",
        100.0 * found.share, _arguments.tolerance.threshold, 100.0 * _arguments.tolerance.share,
        found.worst, _arguments.tolerance.limit, found.worstX, found.worstY);
    _report.comparison = finding;
    if (!found.within)
        error = "differs from '" + _arguments.reference + "': " + finding;
    if (found.within && _arguments.difference.empty())
        return true;
    std::string writeError;
    const std::string file = differenceFile(_arguments);
    if (!writePicture(*found.difference, file, false, writeError))
        error += (error.empty() ? "" : "; ") + writeError;
    else if (!found.within)
        error += "; difference picture: " + file;
    return found.within && writeError.empty();
}

} // namespace osgrender
