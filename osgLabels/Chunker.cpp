// SPDX-License-Identifier: MIT
#include <osgLabels/Chunker.h>

#include <osgLabels/Chunkable.h>

#include <osg/Material>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace osgLabels
{

namespace
{

bool isInvertible(const osg::Matrixd& m)
{
    const osg::Vec3d x(m(0, 0), m(0, 1), m(0, 2)), y(m(1, 0), m(1, 1), m(1, 2)),
        z(m(2, 0), m(2, 1), m(2, 2));
    const double volume = std::abs((x ^ y) * z);
    return volume > 1e-9 * x.length() * y.length() * z.length(); // false for NaN, too
}

} // namespace

bool Chunker::Key::operator<(const Key& other) const
{
    return state != other.state ? state < other.state : layout < other.layout;
}

Chunker::Chunker(ObjectOf objectOf) : _objectOf(std::move(objectOf)) {}

Chunks Chunker::chunk(osg::Group& group)
{
    _result = {};
    _result.node = new osg::Group;
    _result.node->setName("chunks");
    _path = {&group};
    _matrices = {osg::Matrixd()};
    for (unsigned int i = 0; i < group.getNumChildren(); ++i)
        if (const auto left = copy(*group.getChild(i)))
            _result.node->addChild(left);
    for (const Bucket& bucket : _buckets)
    {
        const Key& key = bucket.key;
        // One group a StateSet, so that each has its say on the next as before. The last one is
        // that of the Geometries.
        osg::Group* parent = _result.node;
        for (std::size_t i = 0; i + 1 < key.state.size(); ++i)
        {
            osg::ref_ptr<osg::Group> child = new osg::Group;
            child->setStateSet(key.state[i]);
            parent->addChild(child);
            parent = child;
        }
        Order order(bucket.items.size());
        std::iota(order.begin(), order.end(), 0u);
        split(order.begin(), order.end(), bucket, *parent);
    }
    _byKey.clear();
    _buckets.clear();
    _canonical.clear();
    _made.clear();
    return std::move(_result);
}

bool Chunker::leaveOut(const std::string& why)
{
    ++_result.leftOut[why];
    return false;
}

osg::StateSet* Chunker::canonical(osg::StateSet& stateSet)
{
    return _canonical.emplace(&stateSet, &stateSet).first->second;
}

osg::StateSet* Chunker::canonicalOfColored(osg::StateSet& stateSet)
{
    // The colours of the vertices take the place of what the Material says: one for all then.
    const auto* pair = stateSet.getAttributePair(osg::StateAttribute::MATERIAL);
    const auto* material = pair ? static_cast<const osg::Material*>(pair->first.get()) : nullptr;
    if (!material || (material->getColorMode() != osg::Material::DIFFUSE &&
                      material->getColorMode() != osg::Material::AMBIENT_AND_DIFFUSE))
        return canonical(stateSet);
    osg::ref_ptr<osg::Material> same = osg::clone(material, osg::CopyOp::SHALLOW_COPY);
    const osg::Vec4 white(1.0f, 1.0f, 1.0f, 1.0f);
    same->setDiffuse(osg::Material::FRONT_AND_BACK, white);
    if (material->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE)
        same->setAmbient(osg::Material::FRONT_AND_BACK, white);
    osg::ref_ptr<osg::StateSet> made = osg::clone(&stateSet, osg::CopyOp::SHALLOW_COPY);
    made->setAttribute(same, pair->second);
    osg::StateSet* found = canonical(*made);
    if (found == made)
        _made.push_back(made);
    return found;
}

bool Chunker::enter(osg::Node& node)
{
    if (const char* why = whyNotChunked(node))
        return leaveOut(why);
    osg::Matrixd matrix = _matrices.back();
    if (osg::Transform* transform = node.asTransform())
        transform->computeLocalToWorldMatrix(matrix, nullptr);
    _matrices.push_back(matrix);
    _path.push_back(&node);
    if (node.getStateSet())
        _state.push_back(canonical(*node.getStateSet()));
    return true;
}

void Chunker::leave(osg::Node& node)
{
    _matrices.pop_back();
    _path.pop_back();
    if (node.getStateSet())
        _state.pop_back();
}

osg::ref_ptr<osg::Node> Chunker::copy(osg::Node& node)
{
    if (node.asDrawable())
        ++_result.drawables;
    if (!enter(node))
        return &node;
    osg::ref_ptr<osg::Node> left = &node;
    if (osg::Drawable* drawable = node.asDrawable())
    {
        if (gather(*drawable))
            left = nullptr;
    }
    else
        left = copyGroup(*node.asGroup());
    leave(node);
    return left;
}

osg::ref_ptr<osg::Node> Chunker::copyGroup(osg::Group& group)
{
    std::vector<osg::ref_ptr<osg::Node>> left;
    bool isSame = true;
    for (unsigned int i = 0; i < group.getNumChildren(); ++i)
    {
        const auto child = copy(*group.getChild(i));
        isSame = isSame && child == group.getChild(i);
        if (child)
            left.push_back(child);
    }
    if (isSame)
        return &group;
    if (left.empty())
        return nullptr;
    osg::ref_ptr<osg::Group> copied = osg::clone(&group, osg::CopyOp::SHALLOW_COPY);
    copied->removeChildren(0, copied->getNumChildren());
    for (const auto& child : left)
        copied->addChild(child);
    return copied;
}

Chunker::Items& Chunker::bucketOf(const Key& key)
{
    const auto [found, isNew] = _byKey.emplace(key, _buckets.size());
    if (isNew)
        _buckets.push_back({key, {}});
    return _buckets[found->second].items;
}

bool Chunker::gather(osg::Drawable& drawable)
{
    const osg::Geometry& geometry = *drawable.asGeometry();
    const osg::Array* vertices = geometry.getVertexArray();
    if (vertices && vertices->getNumElements() > _small)
        return leaveOut("large");
    const auto layout = MeshLayout::of(geometry);
    if (!layout)
        return leaveOut("other arrays or primitives than of surfaces");
    // A Geometry without a StateSet ends its chain, too.
    StateChain state = _state;
    if (!drawable.getStateSet())
        state.push_back(nullptr);
    else if (layout->colors != MeshLayout::NONE)
        state.back() = canonicalOfColored(*drawable.getStateSet());
    const osg::Matrixd& matrix = _matrices.back();
    if (!isInvertible(matrix))
        return leaveOut("singular matrices");
    const std::uint32_t object = _objectOf(_path);
    bucketOf({state, *layout})
        .push_back(
            {&geometry, matrix, osg::Vec3d(geometry.getBoundingBox().center()) * matrix, object});
    ++_result.gathered;
    return true;
}

void Chunker::split(Order::iterator begin, Order::iterator end, const Bucket& bucket,
                    osg::Group& parent)
{
    std::size_t vertices = 0;
    osg::BoundingBoxd box;
    for (auto i = begin; i != end; ++i)
    {
        vertices += bucket.items[*i].geometry->getVertexArray()->getNumElements();
        box.expandBy(bucket.items[*i].center);
    }
    if (vertices <= _chunkVertices || end - begin < 2)
        return build(begin, end, bucket, parent);
    const osg::Vec3d size = box._max - box._min;
    const int axis =
        size.x() >= size.y() ? (size.x() >= size.z() ? 0 : 2) : (size.y() >= size.z() ? 1 : 2);
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end,
                     [&](std::uint32_t a, std::uint32_t b)
                     { return bucket.items[a].center[axis] < bucket.items[b].center[axis]; });
    split(begin, middle, bucket, parent);
    split(middle, end, bucket, parent);
}

void Chunker::build(Order::iterator begin, Order::iterator end, const Bucket& bucket,
                    osg::Group& parent)
{
    const Key& key = bucket.key;
    std::sort(begin, end); // surfaces in one plane keep their order
    osg::BoundingBoxd box;
    for (auto i = begin; i != end; ++i)
        box.expandBy(bucket.items[*i].center);
    // Single precision is about this point: as exact as the Drawables' own coordinates were.
    const osg::Vec3d origin = box.center();
    ChunkMesh mesh(key.layout);
    for (auto i = begin; i != end; ++i)
    {
        const Item& item = bucket.items[*i];
        const osg::Matrixd toChunk = item.matrix * osg::Matrixd::translate(-origin);
        mesh.add(*item.geometry, toChunk, item.object);
        if (item.object)
            _result.objects.push_back({item.object, item.geometry, toChunk});
    }
    const osg::ref_ptr<osg::Geometry> geometry = mesh.finish();
    geometry->setStateSet(key.state.back());
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::translate(origin));
    place->setDataVariance(osg::Object::STATIC);
    place->addChild(geometry);
    parent.addChild(place);
    ++_result.chunks;
    _result.vertices += geometry->getVertexArray()->getNumElements();
}

} // namespace osgLabels
