// SPDX-License-Identifier: MIT
#include <osgLabels/MapQuads.h>

namespace osgLabels
{

MapQuads::~MapQuads() = default;

void MapQuads::set(osg::State& state, const std::vector<Words>& labels)
{
    static_assert(sizeof(Words) == 48, "three texels");
    if (!_labels)
    {
        _labels = new BufferTexture(_contextID, 4, BufferTexture::needsPages(state));
        const osg::Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
        _instances = new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        _quad = new osg::Geometry;
        _quad->setVertexArray(new osg::Vec3Array(4, corners));
        _quad->addPrimitiveSet(_instances);
        _quad->setUseDisplayList(false);
        _quad->setUseVertexBufferObjects(true);
    }
    _instances->setNumInstances(int(labels.size()));
    _labels->resize(state, labels.size() * sizeof(Words));
    _labels->write(state, 0, labels.data(), labels.size() * sizeof(Words));
}

} // namespace osgLabels
