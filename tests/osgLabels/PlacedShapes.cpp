// SPDX-License-Identifier: MIT
#include "PlacedShapes.h"

std::vector<PlacedShape> placedShapes()
{
    using namespace shapemesh;
    const double whole = 2.0 * 3.14159265358979;
    return {{"box", box({1.0, 0.7, 0.5}, false), 4.0f},
            {"beam", box({4.0, 0.4, 0.3}, false), 5.0f},
            {"column", box({0.3, 0.3, 3.0}, false), 6.0f},
            {"plate", box({2.0, 1.2, 0.02}, false), 12.0f},
            {"quad", quad(1.0, 0.5, 1), 5.0f},
            {"pipe", frustum(0.4, 0.4, 4.0, 32, 1, FanCapped), 6.0f},
            {"tank", frustum(1.5, 1.5, 1.2, 48, 1, FanCapped), 6.0f},
            {"drum", frustum(1.5, 1.5, 0.3, 48, 1, FanCapped), 6.0f},
            {"sphere", sphere(1.0, 48, 24), 5.0f},
            {"dish", dish(1.0, 0.5, 48, 12, FanCapped), 5.0f},
            {"hemisphere", dish(1.0, 1.0, 48, 12, FanCapped), 5.0f},
            {"cone", frustum(1.0, 0.0, 1.2, 48, 12, FanCapped), 4.0f},
            {"reducer", frustum(1.0, 0.6, 0.8, 48, 4, FanCapped), 5.0f},
            {"flat cone", frustum(0.2, 1.5, 0.2, 48, 4, FanCapped), 5.0f},
            {"washer", frustum(1.0, 1.5, 0.02, 48, 1, Open), 8.0f},
            {"spire", frustum(0.5, 0.1, 4.0, 32, 8, FanCapped), 5.0f},
            {"pyramid", pyramid({1.0, 1.0, 0.8}, true), 4.0f},
            {"elbow", torus(1.5, 0.5, 1.5707963, 16, 24, FanCapped), 5.0f},
            {"torus", torus(1.5, 0.4, whole, 64, 24, Open), 6.0f},
            {"profile",
             extrusion({{-0.5, -0.6},
                        {0.5, -0.6},
                        {0.5, -0.5},
                        {0.05, -0.5},
                        {0.05, 0.5},
                        {0.5, 0.5},
                        {0.5, 0.6},
                        {-0.5, 0.6},
                        {-0.5, 0.5},
                        {-0.05, 0.5},
                        {-0.05, -0.5},
                        {-0.5, -0.5}},
                       3.0),
             5.0f}};
}

osg::ref_ptr<osg::Geometry> geometryOf(const ShapeMesh& mesh)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    for (const glm::vec3& v : mesh.vertices())
        vertices->push_back(osg::Vec3(v.x, v.y, v.z));
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(GL_TRIANGLES, mesh.indices.begin(), mesh.indices.end()));
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}
