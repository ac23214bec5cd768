// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedScene.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

// The PagedScene in files of the old .osg format, where its settings are what the pseudo-loader
// takes in parentheses:
//
//     osgPagedTexture::PagedScene {
//       settings "gpu='64',upload='1'"
//       …

namespace
{

using osgPagedTexture::PagedScene;

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    if (!in[0].matchWord("settings") || !in[1].getStr())
        return false;
    static_cast<PagedScene&>(object).setSettingsText(in[1].getStr());
    in += 2;
    return true;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const PagedScene&>(object);
    out.indent() << "settings " << out.wrapString(scene.getSettingsText()) << "\n";
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(PagedScene)
(new osgPagedTexture::PagedScene, "osgPagedTexture::PagedScene",
 "Object Node osgPagedTexture::PagedScene Group", readLocalData, writeLocalData);
