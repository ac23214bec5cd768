// SPDX-License-Identifier: MIT
#pragma once

#include "Arguments.h"
#include "Model.h"
#include "Report.h"
#include "WarningCounter.h"

#include <osgViewer/Viewer>

#include <memory>

namespace osgrender
{

/// One render: a viewer of its own, as osgviewer sets it up, from reading the model to the files.
///
/// OSG's global settings (DisplaySettings, the readers' options) are set back first, so that
/// renders of one process don't see each other.
class RenderJob
{
public:
    RenderJob(const Arguments& arguments, Backend backend, WarningCounter& counter);
    ~RenderJob();

    /// Renders and writes. Returns false and fills `error` with one line when anything failed.
    bool run(std::string& error);

    /// True when run() failed on what was typed, not on rendering.
    bool isUsageError() const { return _usageError; }

    /// Of the last run; what was reached before a failure.
    const Report& getReport() const { return _report; }

private:
    bool makeViewer(std::string& error);
    bool openWindow(std::string& error);
    bool loadModel(std::string& error);
    bool placeCamera(std::string& error);
    bool drawFrame(int index, bool wanted, std::string& error);
    bool waitForTiles(std::string& error);
    bool drawFrames(std::string& error);
    bool pickLabels(std::string& error);
    bool timeFrames(std::string& error);
    bool writeFrame(int index, std::string& error);
    bool compareWithReference(std::string& error);
    bool drawAll(std::string& error);
    bool measureLight(std::string& error);
    void gatherStatistics();
    void gatherTimes(unsigned int firstFrame);
    void measureCoverage();

    Arguments _arguments;
    WarningCounter& _counter;
    std::unique_ptr<osgViewer::Viewer> _viewer;
    ModelNames _names;
    osg::ref_ptr<osg::Node> _model;
    ModelContents _contents;
    osg::ref_ptr<osg::AnimationPath> _path;
    osg::ref_ptr<Capture> _capture;
    double _lastFrameMs = 0.0;
    bool _usageError = false;
    Report _report;
};

} // namespace osgrender
