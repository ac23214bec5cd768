// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualScene.h>
#include <osgPagedTexture/VirtualTexture.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

// The VirtualScene in files of the old .osg format, where its settings are what the pseudo-loader
// takes in parentheses, and the textures that it shows:
//
//     osgPagedTexture::VirtualScene {
//       settings "gpu='64',upload='1'"
//       …
//     osgPagedTexture::VirtualTexture {
//       store "atlas.tiles"
//       …

namespace
{

using osgPagedTexture::VirtualScene;
using osgPagedTexture::VirtualTexture;

bool readSettings(osg::Object& object, osgDB::Input& in)
{
    if (!in[0].matchWord("settings") || !in[1].getStr())
        return false;
    static_cast<VirtualScene&>(object).setSettingsText(in[1].getStr());
    in += 2;
    return true;
}

bool writeSettings(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const VirtualScene&>(object);
    out.indent() << "settings " << out.wrapString(scene.getSettingsText()) << "\n";
    return true;
}

bool readStore(osg::Object& object, osgDB::Input& in)
{
    if (!in[0].matchWord("store") || !in[1].getStr())
        return false;
    auto& texture = static_cast<VirtualTexture&>(object);
    texture.setStore(in[1].getStr());
    texture.find(in.getOptions()); // Beside the file that names it.
    in += 2;
    return true;
}

bool writeStore(const osg::Object& object, osgDB::Output& out)
{
    const auto& texture = static_cast<const VirtualTexture&>(object);
    out.indent() << "store " << out.wrapString(texture.getStore()) << "\n";
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(VirtualScene)
(new osgPagedTexture::VirtualScene, "osgPagedTexture::VirtualScene",
 "Object Node osgPagedTexture::VirtualScene Group", readSettings, writeSettings);

REGISTER_DOTOSGWRAPPER(VirtualTexture)
(new osgPagedTexture::VirtualTexture, "osgPagedTexture::VirtualTexture",
 "Object StateAttribute osgPagedTexture::VirtualTexture TextureBase", readStore, writeStore);
