// SPDX-License-Identifier: MIT
#include <osgLabels/MapLabels.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

#include <osgMultiRender/Option.h>

namespace
{

using osgLabels::MapLabel;
using osgLabels::MapLabels;

bool checkLabels(const MapLabels& node)
{
    return !node.getLabels().empty();
}

bool writeLabels(osgDB::OutputStream& os, const MapLabels& node)
{
    os << static_cast<unsigned int>(node.getLabels().size()) << os.BEGIN_BRACKET << std::endl;
    for (const MapLabel& label : node.getLabels())
    {
        // Streams of text keep 6 digits.
        for (const double number :
             {label.anchor.x(), label.anchor.y(), label.anchor.z(), label.priority})
            if (os.isBinary())
                os << number;
            else
                os << osgMultiRender::formatNumber(number);
        os.writeWrappedString(label.text);
        os.writeWrappedString(label.style);
        os.writeWrappedString(label.feature);
        os << std::endl;
    }
    os << os.END_BRACKET << std::endl;
    return true;
}

bool readNumber(osgDB::InputStream& is, double& number)
{
    if (is.isBinary())
    {
        is >> number;
        return !is.getException();
    }
    std::string text;
    is >> text;
    return osgMultiRender::parseNumber(text, number);
}

bool readLabels(osgDB::InputStream& is, MapLabels& node)
{
    unsigned int count = 0;
    is >> count >> is.BEGIN_BRACKET;
    std::vector<MapLabel> labels;
    for (unsigned int i = 0; i < count; ++i)
    {
        MapLabel label;
        bool isRight = true;
        for (double* number :
             {&label.anchor.x(), &label.anchor.y(), &label.anchor.z(), &label.priority})
            isRight = isRight && readNumber(is, *number);
        is.readWrappedString(label.text);
        is.readWrappedString(label.style);
        is.readWrappedString(label.feature);
        if (!isRight || is.getException())
        {
            is.throwException("osgLabels::MapLabels: label " + std::to_string(i) + " of " +
                              std::to_string(count) + " is cut off or has a wrong number");
            return false;
        }
        labels.push_back(std::move(label));
    }
    is >> is.END_BRACKET;
    node.setLabels(std::move(labels));
    return true;
}

} // namespace

REGISTER_OBJECT_WRAPPER(osgLabels_MapLabels, new osgLabels::MapLabels, osgLabels::MapLabels,
                        "osg::Object osg::Node osgLabels::MapLabels")
{
    ADD_USER_SERIALIZER(Labels);
}
