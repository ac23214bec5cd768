// SPDX-License-Identifier: MIT
#include <osgShadowVolume/SceneOptions.h>

#include <osg/Notify>
#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

// The ShadowedScene in files of the old .osg format: a line for each setting, as the pseudo-loader
// takes it.
//
//     osgShadowVolume::ShadowedScene {
//       shadows volumes
//       technique auto
//       …

namespace
{

using osgShadowVolume::SceneOption;
using osgShadowVolume::ShadowedScene;

/// Those of LitScene, which its own wrapper reads and writes.
bool isInherited(const SceneOption& option)
{
    return option.name == "lighting" || option.name == "lights" || option.name == "tolerance";
}

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    auto& scene = static_cast<ShadowedScene&>(object);
    bool advanced = false;
    for (const SceneOption& option : osgShadowVolume::sceneOptions())
    {
        if (isInherited(option) || !in[0].matchWord(option.name.c_str()) || !in[1].getStr())
            continue;
        const std::string cause = option.parse(scene, in[1].getStr());
        if (!cause.empty())
        {
            OSG_WARN << "osgShadowVolume::ShadowedScene: " << option.name << " " << in[1].getStr()
                     << ": " << cause << "; the default counts" << std::endl;
        }
        in += 2;
        advanced = true;
    }
    return advanced;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const ShadowedScene&>(object);
    for (const SceneOption& option : osgShadowVolume::sceneOptions())
        if (!isInherited(option))
            out.indent() << option.name << " " << option.format(scene) << "\n";
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(ShadowedScene)
(new osgShadowVolume::ShadowedScene, "osgShadowVolume::ShadowedScene",
 "Object Node osgShadowVolume::LitScene osgShadowVolume::ShadowedScene Group", readLocalData,
 writeLocalData);
