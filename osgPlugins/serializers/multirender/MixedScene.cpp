// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixedScene.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

namespace
{

using osgMultiRender::MixedScene;

bool checkMix(const MixedScene&)
{
    return true;
}

bool readMix(osgDB::InputStream& in, MixedScene& scene)
{
    std::string text;
    in.readWrappedString(text);
    scene.setMixText(text);
    return true;
}

bool writeMix(osgDB::OutputStream& out, const MixedScene& scene)
{
    out.writeWrappedString(scene.getMixText());
    out << std::endl;
    return true;
}

} // namespace

REGISTER_OBJECT_WRAPPER(osgMultiRender_MixedScene, new osgMultiRender::MixedScene,
                        osgMultiRender::MixedScene,
                        "osg::Object osg::Node osg::Group osgMultiRender::MixedScene")
{
    ADD_USER_SERIALIZER(Mix);
    ADD_OBJECT_SERIALIZER(KeyNode, osg::Node, nullptr);
}
