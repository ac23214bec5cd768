// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LitScene.h>

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

REGISTER_OBJECT_WRAPPER(osgShadowVolume_LitScene, new osgShadowVolume::LitScene,
                        osgShadowVolume::LitScene,
                        "osg::Object osg::Node osg::Group osgShadowVolume::LitScene")
{
    {
        using Serializer = osgDB::EnumSerializer<MyClass, MyClass::Lighting, void>;
        osg::ref_ptr<Serializer> serializer = new Serializer(
            "Lighting", MyClass::Lighting::PIXEL, &MyClass::getLighting, &MyClass::setLighting);
        serializer->add("OFF", MyClass::Lighting::OFF);
        serializer->add("VERTEX", MyClass::Lighting::VERTEX);
        serializer->add("PIXEL", MyClass::Lighting::PIXEL);
        wrapper->addSerializer(serializer.get(), osgDB::BaseSerializer::RW_ENUM);
    }
    {
        using Serializer = osgDB::EnumSerializer<MyClass, MyClass::LightScope, void>;
        osg::ref_ptr<Serializer> serializer =
            new Serializer("LightScope", MyClass::LightScope::MODES, &MyClass::getLightScope,
                           &MyClass::setLightScope);
        serializer->add("MODES", MyClass::LightScope::MODES);
        serializer->add("ALL", MyClass::LightScope::ALL);
        wrapper->addSerializer(serializer.get(), osgDB::BaseSerializer::RW_ENUM);
    }
    ADD_DOUBLE_SERIALIZER(LightTolerance, 0.5 / 255.0);
}
