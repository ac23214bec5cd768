// SPDX-License-Identifier: MIT
#include <osgLabels/LabelScene.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

namespace
{

using osgLabels::LabelScene;

bool checkSettings(const LabelScene& scene)
{
    return !scene.getSettingsText().empty();
}

bool readSettings(osgDB::InputStream& in, LabelScene& scene)
{
    std::string text;
    in.readWrappedString(text);
    scene.setSettingsText(text);
    return true;
}

bool writeSettings(osgDB::OutputStream& out, const LabelScene& scene)
{
    out.writeWrappedString(scene.getSettingsText());
    out << std::endl;
    return true;
}

/// ADD_BOOL_SERIALIZER asks for a getter of another name.
bool checkShown(const LabelScene& scene)
{
    return !scene.isShown();
}

bool readShown(osgDB::InputStream& in, LabelScene& scene)
{
    bool shown = true;
    in >> shown;
    scene.setShown(shown);
    return true;
}

bool writeShown(osgDB::OutputStream& out, const LabelScene& scene)
{
    out << scene.isShown() << std::endl;
    return true;
}

} // namespace

REGISTER_OBJECT_WRAPPER(osgLabels_LabelScene, new osgLabels::LabelScene, osgLabels::LabelScene,
                        "osg::Object osg::Node osg::Group osgLabels::LabelScene")
{
    ADD_USER_SERIALIZER(Settings);
    ADD_USER_SERIALIZER(Shown);
}
