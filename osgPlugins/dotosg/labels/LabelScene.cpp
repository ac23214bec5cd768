// SPDX-License-Identifier: MIT
#include <osgLabels/LabelScene.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

// The LabelScene in files of the old .osg format, where its settings are what the pseudo-loader
// takes in parentheses:
//
//     osgLabels::LabelScene {
//       settings "size='0.3',ink='#ff0000'"
//       shown TRUE
//       …

namespace
{

using osgLabels::LabelScene;

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    auto& scene = static_cast<LabelScene&>(object);
    bool advanced = false;
    if (in[0].matchWord("settings") && in[1].getStr())
    {
        scene.setSettingsText(in[1].getStr());
        in += 2;
        advanced = true;
    }
    if (in[0].matchWord("shown") && in[1].getStr())
    {
        scene.setShown(!in[1].matchWord("FALSE"));
        in += 2;
        advanced = true;
    }
    return advanced;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const LabelScene&>(object);
    out.indent() << "settings " << out.wrapString(scene.getSettingsText()) << "\n";
    out.indent() << "shown " << (scene.isShown() ? "TRUE" : "FALSE") << "\n";
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(LabelScene)
(new osgLabels::LabelScene, "osgLabels::LabelScene", "Object Node osgLabels::LabelScene Group",
 readLocalData, writeLocalData);
