// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualScene.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

namespace
{

using osgPagedTexture::VirtualScene;

bool checkSettings(const VirtualScene& scene)
{
    return !scene.getSettingsText().empty();
}

bool readSettings(osgDB::InputStream& in, VirtualScene& scene)
{
    std::string text;
    in.readWrappedString(text);
    scene.setSettingsText(text);
    return true;
}

bool writeSettings(osgDB::OutputStream& out, const VirtualScene& scene)
{
    out.writeWrappedString(scene.getSettingsText());
    out << std::endl;
    return true;
}

} // namespace

REGISTER_OBJECT_WRAPPER(osgPagedTexture_VirtualScene, new osgPagedTexture::VirtualScene,
                        osgPagedTexture::VirtualScene,
                        "osg::Object osg::Node osg::Group osgPagedTexture::VirtualScene")
{
    ADD_USER_SERIALIZER(Settings);
}
