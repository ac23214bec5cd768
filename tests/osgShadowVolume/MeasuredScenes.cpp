// SPDX-License-Identifier: MIT
#include "MeasuredScenes.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/ValueObject>

namespace measured
{

namespace
{

osg::ref_ptr<osg::LightSource> light(int number, const osg::Vec4& position,
                                     const std::string& description, osg::Node& scope)
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setLightNum(number);
    source->getLight()->setPosition(position);
    if (!description.empty())
        source->addDescription(description);
    scope.getOrCreateStateSet()->setMode(GL_LIGHT0 + static_cast<unsigned int>(number),
                                         osg::StateAttribute::ON);
    return source;
}

} // namespace

osg::ref_ptr<osg::Node> quad(const osg::Vec3& corner, const osg::Vec3& u, const osg::Vec3& v)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3& p : {corner, corner + u, corner + v, corner + u + v})
        vertices->push_back(p);
    osg::Vec3 normal = u ^ v;
    normal.normalize();
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(1, &normal);
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
    return geometry;
}

osg::ref_ptr<osg::Node> box(const osg::Vec3& low, const osg::Vec3& high)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    const osg::Vec3 d = high - low;
    const osg::Vec3 x(d.x(), 0.0f, 0.0f), y(0.0f, d.y(), 0.0f), z(0.0f, 0.0f, d.z());
    for (const auto& [u, v] : {std::make_pair(x, y), std::make_pair(y, z), std::make_pair(z, x)})
    {
        group->addChild(quad(high, -u, -v));
        group->addChild(quad(low, v, u));
    }
    return group;
}

osg::ref_ptr<osg::LightSource> pointLight(int number, const osg::Vec3& position,
                                          const std::string& description, osg::Node& scope)
{
    return light(number, osg::Vec4(position, 1.0f), description, scope);
}

osg::ref_ptr<osg::LightSource> spotLight(int number, const osg::Vec3& position, float cutoff,
                                         float exponent, const std::string& description,
                                         osg::Node& scope)
{
    osg::ref_ptr<osg::LightSource> source =
        light(number, osg::Vec4(position, 1.0f), description, scope);
    source->getLight()->setDirection(osg::Vec3(0.0f, 0.0f, -1.0f));
    source->getLight()->setSpotCutoff(cutoff);
    source->getLight()->setSpotExponent(exponent);
    return source;
}

osg::ref_ptr<osg::LightSource> sun(int number, const osg::Vec3& toLight,
                                   const std::string& description, osg::Node& scope)
{
    return light(number, osg::Vec4(toLight, 0.0f), description, scope);
}

osg::ref_ptr<osg::Group> classRoom(double metres)
{
    const float m = static_cast<float>(1.0 / metres);
    osg::ref_ptr<osg::Group> room = new osg::Group;
    room->setUserValue("metresPerUnit", metres);
    const osg::Vec3 x(8.0f * m, 0.0f, 0.0f), y(0.0f, 6.0f * m, 0.0f), z(0.0f, 0.0f, 3.0f * m);
    const osg::Vec3 far = x + y + z;
    for (const auto& [u, v] : {std::make_pair(x, y), std::make_pair(y, z), std::make_pair(z, x)})
    {
        room->addChild(quad(osg::Vec3(), u, v));
        room->addChild(quad(far, -v, -u));
    }
    room->addChild(box(osg::Vec3(3.2f, 2.6f, 0.72f) * m, osg::Vec3(4.8f, 3.4f, 0.75f) * m));
    room->addChild(pointLight(1, osg::Vec3(4.0f, 3.0f, 2.5f) * m, "candela=1000", *room));
    return room;
}

} // namespace measured
