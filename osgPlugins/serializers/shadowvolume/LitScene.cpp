// SPDX-License-Identifier: MIT
#include "AddValueNames.h"

#include <osgDB/InputStream>
#include <osgDB/OutputStream>

REGISTER_OBJECT_WRAPPER(osgShadowVolume_LitScene, new osgShadowVolume::LitScene,
                        osgShadowVolume::LitScene,
                        "osg::Object osg::Node osg::Group osgShadowVolume::LitScene")
{
    addValueNames(*wrapper, "Lighting", osgShadowVolume::LightingNames, MyClass::Lighting::PIXEL,
                  &MyClass::getLighting, &MyClass::setLighting);
    addValueNames(*wrapper, "LightScope", osgShadowVolume::LightScopeNames,
                  MyClass::LightScope::MODES, &MyClass::getLightScope, &MyClass::setLightScope);
    ADD_DOUBLE_SERIALIZER(LightTolerance, 0.5 / 255.0);
}
