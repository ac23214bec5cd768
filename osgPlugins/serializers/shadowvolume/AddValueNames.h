// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/EnumNames.h>

#include <osgDB/ObjectWrapper>
#include <osgDB/Serializer>

/// Adds a property of named values, which files say in capitals.
template <class Class, class Enum, std::size_t N>
void addValueNames(osgDB::ObjectWrapper& wrapper, const char* property,
                   const osgShadowVolume::ValueNames<Enum, N>& names, Enum byDefault,
                   Enum (Class::*get)() const, void (Class::*set)(Enum))
{
    using Serializer = osgDB::EnumSerializer<Class, Enum, void>;
    osg::ref_ptr<Serializer> serializer = new Serializer(property, byDefault, get, set);
    for (const auto& [name, value] : names)
        serializer->add(osgShadowVolume::inCapitals(name).c_str(), value);
    wrapper.addSerializer(serializer.get(), osgDB::BaseSerializer::RW_ENUM);
}
