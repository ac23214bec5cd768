// SPDX-License-Identifier: MIT
// Any bytes as a table of map labels: labels at finite places, and warnings of one line that name
// the file, 21 at most.
#include "fuzz/Require.h"

#include <osgLabels/MapLabelFile.h>

#include <cmath>
#include <cstdint>
#include <sstream>

using namespace osgLabels;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::istringstream in(std::string(data, data + size));
    std::vector<std::string> warnings;
    for (const MapLabel& label : readMapLabels(in, "fuzz.csv", warnings))
    {
        require(std::isfinite(label.anchor.x()) && std::isfinite(label.anchor.y()) &&
                    std::isfinite(label.anchor.z()) && std::isfinite(label.priority),
                "places and priorities are finite");
    }
    require(warnings.size() <= 21, "warnings are counted after 20");
    for (const std::string& warning : warnings)
    {
        require(warning.rfind("fuzz.csv", 0) == 0, "a warning names the file");
        require(warning.find('\n') == std::string::npos, "a warning is one line");
    }
    return 0;
}
