// SPDX-License-Identifier: MIT
#include <osgMultiRender/ScreenTriangle.h>

namespace osgMultiRender
{

osg::ref_ptr<osg::Geometry> makeScreenTriangle()
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::Vec3 corners[] = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
    geometry->setVertexArray(new osg::Vec3Array(3, corners));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}

} // namespace osgMultiRender
