// SPDX-License-Identifier: MIT
#include <osgShadowVolume/EyeLights.h>

#include <osgShadowVolume/CastShadow.h>

#include <glm/gtc/type_ptr.hpp>

namespace osgShadowVolume
{

namespace
{

glm::dvec3 unit(const osg::Vec3d& v)
{
    const double length = v.length();
    return length > 0.0 ? glm::make_vec3(v.ptr()) / length : glm::dvec3(0.0);
}

} // namespace

EyeLight toEye(const osg::Light& light, const osg::Matrix* matrix)
{
    EyeLight eye;
    eye.number = light.getLightNum();
    eye.name = light.getName();
    eye.isHeadlight = !matrix;
    eye.castsShadow = !saysNoShadow(light);
    eye.ambient = glm::make_vec3(light.getAmbient().ptr());
    eye.diffuse = glm::make_vec3(light.getDiffuse().ptr());
    eye.specular = glm::make_vec3(light.getSpecular().ptr());
    eye.constantAttenuation = light.getConstantAttenuation();
    eye.linearAttenuation = light.getLinearAttenuation();
    eye.quadraticAttenuation = light.getQuadraticAttenuation();
    const osg::Matrix identity;
    const osg::Matrix& m = matrix ? *matrix : identity;
    const osg::Vec4d position = osg::Vec4d(light.getPosition()) * m;
    const bool hasCone = light.getSpotCutoff() != 180.0f;
    if (light.getPosition().w() == 0.0f)
    {
        eye.type = hasCone ? EyeLight::DirectionalSpot : EyeLight::Directional;
        eye.position = unit(osg::Vec3d(position.x(), position.y(), position.z()));
    }
    else
    {
        eye.type = hasCone ? EyeLight::Spot : EyeLight::Point;
        eye.position = glm::make_vec3(position.ptr()) / position.w();
    }
    eye.spotDirection = unit(osg::Matrix::transform3x3(osg::Vec3d(light.getDirection()), m));
    eye.spotCutoffDegrees = light.getSpotCutoff();
    eye.spotExponent = light.getSpotExponent();
    return eye;
}

} // namespace osgShadowVolume
