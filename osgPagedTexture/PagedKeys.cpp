// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedKeys.h>

#include <osgPagedTexture/PagedScene.h>

#include <osgMultiRender/KeyEvents.h>

#include <osg/Notify>

#include <string>

namespace osgPagedTexture
{

namespace
{

[[maybe_unused]] const bool isInUsage = osgMultiRender::addToUsage(pagedKeys());

void answer(char key, PagedScene& scene)
{
    PagedSettings settings = scene.getSettings();
    std::string said;
    if (key == 'H')
    {
        settings.graph = !settings.graph;
        said = settings.graph ? "graph=on" : "graph=off";
    }
    else if (key == 'W')
    {
        const bool shows = settings.show == PagedShow::Levels;
        settings.show = shows ? PagedShow::Picture : PagedShow::Levels;
        said = shows ? "show=picture" : "show=levels";
    }
    else
    {
        settings.freeze = !settings.freeze;
        said = settings.freeze ? "freeze=on" : "freeze=off";
    }
    scene.setSettings(settings);
    OSG_NOTICE << "osgPagedTexture: " << said << std::endl;
}

} // namespace

const std::vector<PagedKey>& pagedKeys()
{
    static const std::vector<PagedKey> keys = {
        {'H', "Paged textures: graph of uploads and memory, shown or not"},
        {'W', "Paged textures: the picture, or a colour for how fine each texture is"},
        {'F', "Paged textures: none comes or goes, or they do again"},
    };
    return keys;
}

void answerKeys(PagedScene& scene, osgGA::EventVisitor& visitor)
{
    osgMultiRender::answerPressed(
        visitor, pagedKeys(), [&](char key, const osgGA::GUIEventAdapter&) { answer(key, scene); });
}

} // namespace osgPagedTexture
