// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedScene.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

namespace
{

using osgPagedTexture::PagedScene;

bool checkSettings(const PagedScene& scene)
{
    return !scene.getSettingsText().empty();
}

bool readSettings(osgDB::InputStream& in, PagedScene& scene)
{
    std::string text;
    in.readWrappedString(text);
    scene.setSettingsText(text);
    return true;
}

bool writeSettings(osgDB::OutputStream& out, const PagedScene& scene)
{
    out.writeWrappedString(scene.getSettingsText());
    out << std::endl;
    return true;
}

} // namespace

REGISTER_OBJECT_WRAPPER(osgPagedTexture_PagedScene, new osgPagedTexture::PagedScene,
                        osgPagedTexture::PagedScene,
                        "osg::Object osg::Node osg::Group osgPagedTexture::PagedScene")
{
    ADD_USER_SERIALIZER(Settings);
}
