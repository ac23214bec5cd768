// SPDX-License-Identifier: MIT
#include "AddValueNames.h"

#include <osgShadowVolume/SceneOptions.h>

#include <osg/Notify>
#include <osgDB/InputStream>
#include <osgDB/OutputStream>

namespace
{

using osgShadowVolume::ShadowedScene;

/// Files may hold any number: what no setting allows becomes the default.
class RangeCheck : public osgDB::FinishedObjectReadCallback
{
public:
    void objectRead(osgDB::InputStream&, osg::Object& object) override
    {
        auto& scene = static_cast<ShadowedScene&>(object);
        const osg::ref_ptr<ShadowedScene> defaults = new ShadowedScene;
        for (const osgShadowVolume::SceneOption& option : osgShadowVolume::sceneOptions())
        {
            const std::string text = option.format(scene), cause = option.parse(scene, text);
            if (cause.empty())
                continue;
            OSG_WARN << "osgShadowVolume::ShadowedScene: " << option.name << " in a file: " << cause
                     << "; the default counts" << std::endl;
            option.parse(scene, option.format(*defaults));
        }
    }
};

} // namespace

REGISTER_OBJECT_WRAPPER(osgShadowVolume_ShadowedScene, new osgShadowVolume::ShadowedScene,
                        osgShadowVolume::ShadowedScene,
                        "osg::Object osg::Node osg::Group osgShadowVolume::LitScene "
                        "osgShadowVolume::ShadowedScene")
{
    using namespace osgShadowVolume;
    const ShadowSettings defaults;
    addValueNames(*wrapper, "Shadows", ShadowsNames, defaults.shadows, &MyClass::getShadows,
                  &MyClass::setShadows);
    addValueNames(*wrapper, "Technique", TechniqueNames, defaults.technique, &MyClass::getTechnique,
                  &MyClass::setTechnique);
    addValueNames(*wrapper, "TransparentCasters", TransparentCastersNames,
                  defaults.transparentCasters, &MyClass::getTransparentCasters,
                  &MyClass::setTransparentCasters);
    ADD_BOOL_SERIALIZER(HeadlightShadow, defaults.headlightShadow);
    ADD_UINT_SERIALIZER(TransparentLayers, defaults.transparentLayers);
    ADD_UINT_SERIALIZER(MapSize, defaults.mapSize);
    ADD_UINT_SERIALIZER(MapSamples, defaults.mapSamples);
    ADD_UINT_SERIALIZER(MapMegabytes, defaults.mapMegabytes);
    addValueNames(*wrapper, "Show", ShowNames, defaults.show, &MyClass::getShow, &MyClass::setShow);
    ADD_INT_SERIALIZER(LightShown, defaults.lightShown);
    ADD_BOOL_SERIALIZER(Mirrors, defaults.mirrors);
    ADD_UINT_SERIALIZER(MaxMirrors, defaults.maxMirrors);
    ADD_BOOL_SERIALIZER(Keys, defaults.keys);
    ADD_DOUBLE_SERIALIZER(MetresPerUnit, defaults.metresPerUnit);
    ADD_DOUBLE_SERIALIZER(IlluminanceMaximum, defaults.illuminanceMaximum);
    ADD_DOUBLE_SERIALIZER(Candela, defaults.candela);
    ADD_DOUBLE_SERIALIZER(Lux, defaults.lux);
    wrapper->addFinishedObjectReadCallback(new RangeCheck);
}
