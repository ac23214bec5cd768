// SPDX-License-Identifier: MIT
#include <osgLabels/MapLabels.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

#include <osgMultiRender/Option.h>

// MapLabels in files of the old .osg format, one line a label: x, y, z, priority, text, style and
// feature.
//
//     osgLabels::MapLabels {
//       label 0.5 0 12.25 1 "Capitol Building" "" "capitol"
//       …

namespace
{

using osgLabels::MapLabel;
using osgLabels::MapLabels;

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    auto& node = static_cast<MapLabels&>(object);
    std::vector<MapLabel> labels = node.getLabels();
    const std::size_t before = labels.size();
    while (in[0].matchWord("label") && in[7].getStr())
    {
        MapLabel label;
        double* const numbers[] = {&label.anchor.x(), &label.anchor.y(), &label.anchor.z(),
                                   &label.priority};
        for (int i = 0; i < 4; ++i)
            if (!osgMultiRender::parseNumber(std::string(in[1 + i].getStr()), *numbers[i]))
                return before != labels.size();
        label.text = in[5].getStr();
        label.style = in[6].getStr();
        label.feature = in[7].getStr();
        labels.push_back(std::move(label));
        in += 8;
    }
    if (before == labels.size())
        return false;
    node.setLabels(std::move(labels));
    return true;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    for (const MapLabel& label : static_cast<const MapLabels&>(object).getLabels())
    {
        out.indent() << "label";
        for (const double number :
             {label.anchor.x(), label.anchor.y(), label.anchor.z(), label.priority})
            out << ' ' << osgMultiRender::formatNumber(number);
        for (const std::string& text : {label.text, label.style, label.feature})
            out << ' ' << out.wrapString(text);
        out << "\n";
    }
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(MapLabels)
(new osgLabels::MapLabels, "osgLabels::MapLabels", "Object Node osgLabels::MapLabels",
 readLocalData, writeLocalData);
