// SPDX-License-Identifier: MIT
// Stands in for PickLabels.cpp where osgLabels is not built.
#include "Pick.h"

namespace osgrender
{

bool askLabels(osg::Node&, const PickPoint&, int, int, std::string& error)
{
    error = "--pick needs osgLabels, which this osgrender was built without";
    return false;
}

std::vector<PickResult> takeAnswers(osg::Node&, const PickPoint&)
{
    return {};
}

} // namespace osgrender
