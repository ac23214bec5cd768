// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ArrayPoint.h>

namespace osgPagedTexture
{

namespace
{

template <class Array> glm::dvec3 flatPoint(const osg::Array& array, unsigned int index)
{
    const auto& v = static_cast<const Array&>(array)[index];
    return {v.x(), v.y(), 0.0};
}

template <class Array> glm::dvec3 spacePoint(const osg::Array& array, unsigned int index)
{
    const auto& v = static_cast<const Array&>(array)[index];
    return {v.x(), v.y(), v.z()};
}

} // namespace

glm::dvec3 pointOf(const osg::Array& array, unsigned int index)
{
    switch (array.getType())
    {
    case osg::Array::Vec3ArrayType:
        return spacePoint<osg::Vec3Array>(array, index);
    case osg::Array::Vec3dArrayType:
        return spacePoint<osg::Vec3dArray>(array, index);
    case osg::Array::Vec2ArrayType:
        return flatPoint<osg::Vec2Array>(array, index);
    case osg::Array::Vec2dArrayType:
        return flatPoint<osg::Vec2dArray>(array, index);
    default:
        return glm::dvec3(0.0);
    }
}

bool isReadable(const osg::Array* array, bool isPlace)
{
    if (!array)
        return false;
    const osg::Array::Type type = array->getType();
    return type == osg::Array::Vec3ArrayType || type == osg::Array::Vec3dArrayType ||
           (!isPlace && (type == osg::Array::Vec2ArrayType || type == osg::Array::Vec2dArrayType));
}

} // namespace osgPagedTexture
