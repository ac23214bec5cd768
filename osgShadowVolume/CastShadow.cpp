// SPDX-License-Identifier: MIT
#include <osgShadowVolume/CastShadow.h>

#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <string>

namespace osgShadowVolume
{

namespace
{

/// Whether the value is one that says no.
bool isNo(const osg::ValueObject& value)
{
    const auto is = [&](auto no)
    {
        const auto* typed = dynamic_cast<const osg::TemplateValueObject<decltype(no)>*>(&value);
        return typed && typed->getValue() == no;
    };
    return is(false) || is(0) || is(0u) || is(0.0f) || is(0.0) || is(std::string("0")) ||
           is(std::string("false"));
}

} // namespace

bool saysNoShadow(const osg::Object& object)
{
    const osg::UserDataContainer* data = object.getUserDataContainer();
    if (!data)
        return false;
    const auto* value = dynamic_cast<const osg::ValueObject*>(data->getUserObject("castShadow"));
    if (value && isNo(*value))
        return true;
    for (unsigned int i = 0; i != data->getNumDescriptions(); ++i)
        if (data->getDescriptions()[i] == "castShadow=0")
            return true;
    return false;
}

} // namespace osgShadowVolume
