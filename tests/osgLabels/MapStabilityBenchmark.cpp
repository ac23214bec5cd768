// SPDX-License-Identifier: MIT
// How often map labels come and go along the recorded path over the town, 640x480, 10 frames a
// second, with and without a past (hysteresis and holding times).
#include "MapFlight.h"

#include <support/FrameTimer.h>

#include <cstdio>

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    BenchmarkOptions options;
    double seconds = 30.0;
    arguments.read("--seconds", seconds);
    if (!options.read(arguments))
        return 1;
    if (!cityPictures::viewer().isValid())
    {
        std::fprintf(stderr, "%s\n", cityPictures::viewer().getError().c_str());
        return 1;
    }
    const City town = cityPictures::makeTown();
    Table table({"labels", "speed", "frames", "shown", "flips", "flips_per_label_and_second",
                 "most_of_one_in_a_second"});
    for (const double speed : {1.0, 0.25})
        for (const char* test : {"anchor", "share"})
            for (const bool hasPast : {true, false})
            {
                MapFlight flight(town, std::string("maptest=") + test, hasPast);
                const MapFlight::Flips flips = flight.fly(6.0, seconds, speed);
                table.add(std::string(test) + (hasPast ? " with a past" : " without"),
                          {speed, double(flips.frames), flips.shown, double(flips.count),
                           flips.perLabelAndSecond, double(flips.most)});
            }
    return table.report(options.csv);
}
