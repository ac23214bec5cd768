// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualKeys.h>

#include <osgPagedTexture/VirtualScene.h>

#include <osgMultiRender/KeyEvents.h>

#include <osg/Notify>

#include <string>

namespace osgPagedTexture
{

namespace
{

[[maybe_unused]] const bool isInUsage = osgMultiRender::addToUsage(virtualKeys());

/// One thing instead of the picture, or the picture again.
std::string toggle(VirtualSettings& settings, VirtualShow show, const char* word)
{
    const bool shows = settings.show == show;
    settings.show = shows ? VirtualShow::Picture : show;
    return shows ? "show=picture" : std::string("show=") + word;
}

void answer(char key, VirtualScene& scene)
{
    VirtualSettings settings = scene.getSettings();
    std::string said;
    switch (key)
    {
    case 'u':
        scene.update();
        said = "stores are brought up to date with their photographs";
        break;
    case 'C':
        said = toggle(settings, VirtualShow::Levels, "levels");
        break;
    case 'T':
        said = toggle(settings, VirtualShow::Pages, "pages");
        break;
    case '#':
        settings.graph = !settings.graph;
        said = settings.graph ? "graph=on" : "graph=off";
        break;
    default:
        settings.freeze = !settings.freeze;
        said = settings.freeze ? "freeze=on" : "freeze=off";
        break;
    }
    scene.setSettings(settings);
    OSG_NOTICE << "osgPagedTexture: " << said << std::endl;
}

} // namespace

const std::vector<PagedKey>& virtualKeys()
{
    static const std::vector<PagedKey> keys = {
        {'u',
         "Virtual textures: stores are brought up to date with their photographs and read again"},
        {'C', "Virtual textures: the picture, or a colour for the level of each pixel"},
        {'T', "Virtual textures: the picture, or borders of pages over it"},
        {'=', "Virtual textures: no page comes or goes, or they do again"},
        {'#', "Virtual textures: says once a second what pages do, or not"},
    };
    return keys;
}

void answerKeys(VirtualScene& scene, osgGA::EventVisitor& visitor)
{
    osgMultiRender::answerPressed(visitor, virtualKeys(),
                                  [&](char key, const osgGA::GUIEventAdapter&)
                                  { answer(key, scene); });
}

} // namespace osgPagedTexture
