// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PagedKeys.h>

#include <osgPagedTexture/PagedScene.h>

#include <osg/ApplicationUsage>
#include <osg/Notify>
#include <osgGA/EventVisitor>

#include <string>

namespace osgPagedTexture
{

namespace
{

using KeyEvent = osgGA::GUIEventAdapter;

[[maybe_unused]] const bool isInUsage = []
{
    for (const PagedKey& key : pagedKeys())
        osg::ApplicationUsage::instance()->addKeyboardMouseBinding(std::string(1, key.key),
                                                                   key.help);
    return true;
}();

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
    for (const osg::ref_ptr<osgGA::Event>& each : visitor.getEvents())
    {
        KeyEvent* event = each->asGUIEventAdapter();
        if (!event || event->getHandled() || event->getEventType() != KeyEvent::KEYDOWN)
            continue;
        for (const PagedKey& key : pagedKeys())
            if (event->getKey() == key.key)
            {
                answer(key.key, scene);
                event->setHandled(true);
                if (osgGA::GUIActionAdapter* viewer = visitor.getActionAdapter())
                    viewer->requestRedraw();
            }
    }
}

} // namespace osgPagedTexture
