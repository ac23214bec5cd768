// SPDX-License-Identifier: MIT
#include <osgLabels/MapQuads.h>

namespace osgLabels
{

namespace
{

osg::ref_ptr<osg::Geometry> makeShape(GLenum mode, unsigned int corners)
{
    const osg::Vec3 places[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    osg::ref_ptr<osg::Geometry> shape = new osg::Geometry;
    shape->setVertexArray(new osg::Vec3Array(corners, places));
    shape->addPrimitiveSet(new osg::DrawArrays(mode, 0, GLsizei(corners)));
    shape->setUseDisplayList(false);
    shape->setUseVertexBufferObjects(true);
    return shape;
}

} // namespace

MapQuads::~MapQuads() = default;

void MapQuads::draw(osg::RenderInfo& renderInfo, const osg::Geometry& shape)
{
    shape.draw(renderInfo);
    // osg::State tells arrays apart by their address: one that comes to lie where this one was
    // must not be taken for it.
    renderInfo.getState()->disableAllVertexArrays();
}

void MapQuads::set(osg::State& state, const std::vector<Words>& labels,
                   const std::vector<std::uint32_t>& order)
{
    static_assert(sizeof(Words) == 48, "three texels");
    constexpr std::size_t texel = 16;
    if (!_labels)
    {
        _labels = new BufferTexture(_contextID, 4, BufferTexture::needsPages(state));
        _quad = makeShape(GL_TRIANGLE_STRIP, 4);
        _point = makeShape(GL_POINTS, 1);
    }
    _quad->getPrimitiveSet(0)->setNumInstances(int(order.size()));
    _point->getPrimitiveSet(0)->setNumInstances(int(labels.size()));
    const std::size_t bytes = labels.size() * sizeof(Words);
    std::vector<std::uint32_t> padded = order;
    padded.resize((order.size() + 3) / 4 * 4);
    _orderAt = unsigned(bytes / texel);
    _labels->resize(state, bytes + padded.size() * sizeof(padded[0]));
    _labels->write(state, 0, labels.data(), bytes);
    if (!padded.empty())
        _labels->write(state, bytes, padded.data(), padded.size() * sizeof(padded[0]));
}

} // namespace osgLabels
