// SPDX-License-Identifier: MIT
#include "Arguments.h"

#include <osg/ArgumentParser>
#include <osgDB/Registry>
#include <osgViewer/Viewer>

#include <cstdio>
#include <iostream>

namespace osgrender
{

namespace
{

constexpr char Text[] =
    R"(osgrender [switches] model... -o picture: renders models without a display.
osgrender [switches] @script...: one render a line, all in one process.

Models are what osgviewer reads, with pseudo-loader suffixes ('model.iv.(shadows=off).shadowvolume').
Exit status: 0 done, 1 a render, a file or a comparison failed, 2 wrong switches.

Pictures
  -o FILE              picture to write; the extension chooses the format, several -o write several.
                       %d or %03d stands for the frame number (from 0); without it the last frame is
                       written. EXR and HDR hold float pixels, also above 1; folders are made
  --size WxH           picture size in pixels (default 800x600); --window x y w h does the same
  --samples N          samples a pixel (default: OSG_MULTI_SAMPLES, else none)
  --float              float pixels in TIFF too
  --title TEXT         caption in the --html page

Camera
  --camera home[;turn:DEG;lift:DEG;zoom:FACTOR;fov:DEG]
                       osgviewer's first view (the default), turned to the right, lifted, nearer
  --camera eye:X,Y,Z[;center:X,Y,Z;up:X,Y,Z;fov:DEG]
                       world coordinates; center is the scene's centre, up is 0,0,1 where left out;
                       fov is vertical
  --camera-path FILE   OSG's .path, as osgviewer's z key saves it; also -p. Stays at its end
  --speed FACTOR       of the camera path (default 1)

Time
  --frames N           frames to render (default 1)
  --time SECONDS       simulation time of the first frame (default 0)
  --frame-time SECONDS from one frame to the next (default 0.04, 25 frames a second)
  --paging-limit SEC   longest wait for paged tiles before the first frame (default 30)

Results
  --stats FILE         JSON: times, passes, draw calls, programs, textures, GL errors, kits' plans
  --timing N           draw the last frame N more times for the times (default 10 with --stats or
                       --html, else 0)
  --list-plan          print what the kits drew, folded and dropped, and why
  --reference FILE     compare the last frame's red, green and blue with this picture
  --tolerance T,S,L    a pixel is off over T in a channel; share S of them may be; none over L
                       (default 2/255,0.1%,8/255)
  --difference FILE    write the difference picture, white at L (without this switch it is written
                       beside the picture as NAME.difference.png when the comparison fails)

Labels
  --pick X,Y           print identifier, text and nodes of the labelled object ('model.iv.labels') at
                       this pixel of the last frame, from the lower left corner; opaque surfaces
                       count. Repeatable, a picture need not be written

Light measuring: direct illuminance in lux with shadows, by rays; reflected light does not count.
Lights state candela=N or lumen=N, directional ones lux=N, as user value, description or part of
their name; a node states metresPerUnit=N. Without -o and the like nothing is drawn.
  --probe X,Y,Z[,NX,NY,NZ]
                       print lux at a point of world coordinates for a surface with this normal
                       (default 0,0,1, horizontal illuminance), and each light's share. Repeatable
  --probe-grid corner:X,Y,Z;u:X,Y,Z;v:X,Y,Z[;n:NxM][;normal:X,Y,Z]
                       print minimum, mean, maximum and uniformity (minimum by mean) over a plane
                       with N points along u and M along v, at the centres of equal cells (default
                       as many as EN 12464-1 asks for; normal: u x v, turned upwards). Repeatable
  --probe-csv FILE     every point of every grid
  --metres-per-unit M  instead of what the scene states
  --candela N          of point and spot lights that state no intensity
  --lux N              of directional lights that state none

Process
  --backend B          auto, egl or osmesa (default auto: EGL where it works)
  @FILE                script: # begins a comment, '...' and "..." hold words together, a backslash
                       at the end joins lines, ${NAME} is a definition or an environment variable.
                       Switches beside it are put before those of each line
  -D NAME=VALUE        definition for ${NAME}
  --html FILE          gallery page of a script's renders
  --list-keys          list the keys that the kits' scenes answer to in osgviewer
  --help               this

An empty model renders the background, with a warning. --screen is accepted and has no effect:
there is no screen.

osgviewer's switches, taken as well:
)";

} // namespace

void printHelp()
{
    std::fputs(Text, stdout);
    std::fflush(stdout);
    char name[] = "osgrender";
    char* argv[] = {name, nullptr};
    int argc = 1;
    osg::ArgumentParser parser(&argc, argv);
    osgViewer::Viewer viewer(parser);
    osg::ApplicationUsage& usage = *parser.getApplicationUsage();
    usage.addCommandLineOption("--image <filename>", "Load an image and render it on a quad");
    usage.addCommandLineOption("--dem <filename>", "Load an image and render it on a HeightField");
    osg::ApplicationUsage::UsageMap options = usage.getCommandLineOptions();
    for (const char* own : {"--samples <num>", "--screen <num>", "--window <x y w h>",
                            "--borderless-window <x y w h>", "-h or --help"})
        options.erase(own);
    usage.write(std::cout, options);
}

bool printKeys()
{
    // A kit enters its keys when its library is loaded; osgviewer's own are not there.
    for (const char* kit : {"shadowvolume", "labels"})
        osgDB::Registry::instance()->getReaderWriterForExtension(kit);
    const auto& bindings = osg::ApplicationUsage::instance()->getKeyboardMouseBindings();
    for (const auto& [key, help] : bindings)
        std::printf("%s  %s\n", key.c_str(), help.c_str());
    return !bindings.empty();
}

} // namespace osgrender
