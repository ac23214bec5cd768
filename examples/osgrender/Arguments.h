// SPDX-License-Identifier: MIT
#pragma once

#include "CameraSetting.h"
#include "Compare.h"
#include "Pick.h"
#include "Probe.h"

#include <map>
#include <string>
#include <vector>

namespace osgrender
{

/// What draws: a headless windowing plugin.
enum class Backend
{
    Auto, ///< EGL where it works, else OSMesa.
    Egl,
    Osmesa
};

const char* toString(Backend backend);

/// One render, as the command line or a line of a script asks for it.
struct Arguments
{
    std::vector<std::string> outputs; ///< -o; "%03d" stands for the frame number.
    std::string title;                ///< Caption in the gallery page; empty: the model's name.
    int width = 800;                  ///< Pixels.
    int height = 600;
    int samples = -1; ///< Per pixel; -1: what OSG_MULTI_SAMPLES says, else none.
    bool floatPixels = false;
    CameraSetting camera;
    std::string cameraPath; ///< Instead of `camera`; empty: none.
    double pathSpeed = 1.0;

    int frames = 1;
    double startSeconds = 0.0; ///< Simulation time of the first frame.
    double frameSeconds = 0.04;
    int timingFrames = -1; ///< Repetitions of the last frame to time; -1: 10 if --stats or --html.
    double pagingSeconds = 30.0; ///< Longest wait for paged tiles.

    std::string stats; ///< JSON file; empty: none.
    bool listPlan = false;
    std::string reference; ///< Picture to compare the last frame with; empty: none.
    std::string difference;
    Tolerance tolerance;
    ProbeSetting probe;           ///< Illuminance to measure.
    std::vector<PickPoint> picks; ///< Pixels of the last frame whose labels are asked for.

    /// Whether anything that is asked for needs a frame to be drawn.
    bool drawsFrames() const
    {
        return !outputs.empty() || !stats.empty() || listPlan || !reference.empty() ||
               !picks.empty();
    }

    /// Models and osgviewer's own switches, for osgViewer::Viewer and the model readers.
    std::vector<std::string> viewerArguments;
};

/// What concerns the whole process.
struct ProcessArguments
{
    Backend backend = Backend::Auto;
    std::vector<std::string> scripts; ///< Without the '@'.
    std::map<std::string, std::string> definitions;
    std::string page; ///< HTML index of all renders; empty: none.
    bool help = false;
    bool listKeys = false;
    std::vector<std::string> rest; ///< The words that concern a render.
};

/// Takes the switches of the whole process out of `words`. Returns false and fills `error` when a
/// value is missing or wrong.
bool parseProcess(const std::vector<std::string>& words, ProcessArguments& arguments,
                  std::string& error);

/// Reads the switches of one render; later ones override earlier ones. Words that are not
/// osgrender's go to `viewerArguments` in their order.
bool parseRender(const std::vector<std::string>& words, Arguments& arguments, std::string& error);

/// Prints all switches, osgviewer's too.
void printHelp();

/// Prints the keys that the kits' scenes answer to in osgviewer. False where no kit is found.
bool printKeys();

} // namespace osgrender
