// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixedScene.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

// The MixedScene in files of the old .osg format, with its mix as in mix files. The node that key
// points are attached to is not kept; .osgt, .osgb and .osgx have it.
//
//     osgMultiRender::MixedScene {
//       mix "{ … }"
//       …

namespace
{

using osgMultiRender::MixedScene;

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    auto& scene = static_cast<MixedScene&>(object);
    bool advanced = false;
    if (in[0].matchWord("mix") && in[1].getStr())
    {
        scene.setMixText(in[1].getStr());
        in += 2;
        advanced = true;
    }
    return advanced;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const MixedScene&>(object);
    out.indent() << "mix " << out.wrapString(scene.getMixText()) << "\n";
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(MixedScene)
(new osgMultiRender::MixedScene, "osgMultiRender::MixedScene",
 "Object Node osgMultiRender::MixedScene Group", readLocalData, writeLocalData);
