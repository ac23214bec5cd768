// SPDX-License-Identifier: MIT
// Stands in for Measure.cpp where osgShadowVolume is not built.
#include "Probe.h"

namespace osgrender
{

bool measure(osg::Node&, const ProbeSetting&, ProbeResult&, std::string& error)
{
    error = "--probe and --probe-grid need osgShadowVolume, which this osgrender was built without";
    return false;
}

} // namespace osgrender
