// SPDX-License-Identifier: MIT
#include <osgLabels/ChunkMesh.h>

#include <algorithm>
#include <tuple>

namespace osgLabels
{

namespace
{

bool isPerVertex(const osg::Array& array, std::size_t vertices)
{
    return array.getBinding() == osg::Array::BIND_PER_VERTEX && array.getNumElements() >= vertices;
}

bool isUsual(const osg::Array& array, std::size_t vertices)
{
    return isPerVertex(array, vertices) ||
           (array.getBinding() == osg::Array::BIND_OVERALL && array.getNumElements() > 0);
}

bool isSurface(const osg::PrimitiveSet& set, std::size_t vertices)
{
    switch (set.getMode())
    {
    case GL_TRIANGLES:
    case GL_TRIANGLE_STRIP:
    case GL_TRIANGLE_FAN:
    case GL_QUADS:
    case GL_QUAD_STRIP:
    case GL_POLYGON:
        break;
    default:
        return false;
    }
    switch (set.getType())
    {
    case osg::PrimitiveSet::DrawArraysPrimitiveType:
    case osg::PrimitiveSet::DrawArrayLengthsPrimitiveType:
    case osg::PrimitiveSet::DrawElementsUBytePrimitiveType:
    case osg::PrimitiveSet::DrawElementsUShortPrimitiveType:
    case osg::PrimitiveSet::DrawElementsUIntPrimitiveType:
        break;
    default:
        return false;
    }
    if (set.getNumInstances() || set.getDataVariance() == osg::Object::DYNAMIC)
        return false;
    for (unsigned int i = 0; i < set.getNumIndices(); ++i)
        if (set.index(i) >= vertices)
            return false;
    return true;
}

template <typename To> void append(osg::Array& to, const osg::Array& from, std::size_t count)
{
    const auto& source = static_cast<const To&>(from);
    auto& target = static_cast<To&>(to);
    target.insert(target.end(), source.begin(),
                  source.begin() + static_cast<std::ptrdiff_t>(count));
}

osg::ref_ptr<osg::Array> makeTexCoords(unsigned int components)
{
    if (components == 2)
        return new osg::Vec2Array(osg::Array::BIND_PER_VERTEX);
    if (components == 3)
        return new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    return new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
}

osg::ref_ptr<osg::PrimitiveSet> makeElements(GLenum mode, const std::vector<std::uint32_t>& indices,
                                             std::size_t vertices)
{
    if (vertices > 65536)
        return new osg::DrawElementsUInt(mode, indices.begin(), indices.end());
    osg::ref_ptr<osg::DrawElementsUShort> elements = new osg::DrawElementsUShort(mode);
    elements->reserve(indices.size());
    for (const std::uint32_t index : indices)
        elements->push_back(static_cast<GLushort>(index));
    return elements;
}

} // namespace

bool MeshLayout::operator<(const MeshLayout& other) const
{
    return std::tie(hasNormals, colors, texCoords) <
           std::tie(other.hasNormals, other.colors, other.texCoords);
}

std::optional<MeshLayout> MeshLayout::of(const osg::Geometry& geometry)
{
    const auto* vertices = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    if (!vertices || vertices->empty() || geometry.containsDeprecatedData())
        return std::nullopt;
    const std::size_t count = vertices->size();
    osg::Geometry::ArrayList arrays;
    geometry.getArrayList(arrays);
    std::size_t known = 1;
    MeshLayout layout;
    if (const osg::Array* normals = geometry.getNormalArray())
    {
        if (normals->getType() != osg::Array::Vec3ArrayType || !isUsual(*normals, count))
            return std::nullopt;
        layout.hasNormals = true;
        ++known;
    }
    if (const osg::Array* colors = geometry.getColorArray())
    {
        const bool isFloats = colors->getType() == osg::Array::Vec4ArrayType;
        if ((!isFloats && colors->getType() != osg::Array::Vec4ubArrayType) ||
            !isUsual(*colors, count))
            return std::nullopt;
        layout.colors = isFloats ? FLOATS : BYTES;
        ++known;
    }
    for (unsigned int unit = 0; unit < geometry.getNumTexCoordArrays(); ++unit)
        if (const osg::Array* coords = geometry.getTexCoordArray(unit))
        {
            const bool isFloat = coords->getType() == osg::Array::Vec2ArrayType ||
                                 coords->getType() == osg::Array::Vec3ArrayType ||
                                 coords->getType() == osg::Array::Vec4ArrayType;
            if (unit >= Units || !isFloat || !isPerVertex(*coords, count))
                return std::nullopt;
            layout.texCoords[unit] = static_cast<std::uint8_t>(coords->getDataSize());
            ++known;
        }
    for (const auto& array : arrays)
        if (array->getDataVariance() == osg::Object::DYNAMIC)
            return std::nullopt;
    if (arrays.size() != known) // secondary colours, fog coordinates, attributes
        return std::nullopt;
    for (unsigned int i = 0; i < geometry.getNumPrimitiveSets(); ++i)
        if (!isSurface(*geometry.getPrimitiveSet(i), count))
            return std::nullopt;
    return layout;
}

bool ChunkMesh::isOne(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* objects =
        geometry ? geometry->getVertexAttribArray(ObjectAttribute) : nullptr;
    return objects && objects->getName() == ObjectsName;
}

ChunkMesh::ChunkMesh(const MeshLayout& layout) : _layout(layout)
{
    if (layout.colors == MeshLayout::BYTES)
    {
        _colors = new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX);
        _colors->setNormalize(true);
    }
    else if (layout.colors == MeshLayout::FLOATS)
        _colors = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
    for (std::size_t unit = 0; unit < MeshLayout::Units; ++unit)
        if (layout.texCoords[unit])
            _texCoords[unit] = makeTexCoords(layout.texCoords[unit]);
}

void ChunkMesh::add(const osg::Geometry& geometry, const osg::Matrixd& localToChunk,
                    std::uint32_t object)
{
    const auto& vertices = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    const auto first = static_cast<std::uint32_t>(_vertices->size());
    for (const osg::Vec3& vertex : vertices)
        _vertices->push_back(osg::Vec3(osg::Vec3d(vertex) * localToChunk));
    _objects->resize(first + vertices.size(), object);
    if (_layout.hasNormals)
    {
        // Not normalized: what GL does to their length it does to them as before.
        const osg::Matrixd inverse = osg::Matrixd::inverse(localToChunk);
        const auto& normals = static_cast<const osg::Vec3Array&>(*geometry.getNormalArray());
        const bool isOne = normals.getBinding() == osg::Array::BIND_OVERALL;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            _normals->push_back(
                osg::Vec3(osg::Matrixd::transform3x3(inverse, osg::Vec3d(normals[isOne ? 0 : i]))));
    }
    if (_layout.colors != MeshLayout::NONE)
        addColors(geometry.getColorArray(), vertices.size());
    for (unsigned int unit = 0; unit < MeshLayout::Units; ++unit)
        if (_layout.texCoords[unit] == 2)
            append<osg::Vec2Array>(*_texCoords[unit], *geometry.getTexCoordArray(unit),
                                   vertices.size());
        else if (_layout.texCoords[unit] == 3)
            append<osg::Vec3Array>(*_texCoords[unit], *geometry.getTexCoordArray(unit),
                                   vertices.size());
        else if (_layout.texCoords[unit] == 4)
            append<osg::Vec4Array>(*_texCoords[unit], *geometry.getTexCoordArray(unit),
                                   vertices.size());
    for (unsigned int i = 0; i < geometry.getNumPrimitiveSets(); ++i)
        addIndices(*geometry.getPrimitiveSet(i), first);
}

void ChunkMesh::addColors(const osg::Array* colors, std::size_t count)
{
    if (colors->getBinding() == osg::Array::BIND_PER_VERTEX)
    {
        if (_layout.colors == MeshLayout::FLOATS)
            append<osg::Vec4Array>(*_colors, *colors, count);
        else
            append<osg::Vec4ubArray>(*_colors, *colors, count);
    }
    else if (_layout.colors == MeshLayout::FLOATS)
    {
        auto& to = static_cast<osg::Vec4Array&>(*_colors);
        to.resize(to.size() + count, static_cast<const osg::Vec4Array&>(*colors)[0]);
    }
    else
    {
        auto& to = static_cast<osg::Vec4ubArray&>(*_colors);
        to.resize(to.size() + count, static_cast<const osg::Vec4ubArray&>(*colors)[0]);
    }
}

void ChunkMesh::addIndices(const osg::PrimitiveSet& set, std::uint32_t first)
{
    std::vector<std::uint32_t> indices(set.getNumIndices());
    for (unsigned int i = 0; i < indices.size(); ++i)
        indices[i] = first + set.index(i);
    if (set.getType() != osg::PrimitiveSet::DrawArrayLengthsPrimitiveType)
        return addPrimitives(set.getMode(), indices, 0, indices.size());
    std::size_t begin = 0;
    for (const GLint length : static_cast<const osg::DrawArrayLengths&>(set))
    {
        addPrimitives(set.getMode(), indices, begin, static_cast<std::size_t>(length));
        begin += static_cast<std::size_t>(length);
    }
}

void ChunkMesh::addPrimitives(GLenum mode, const std::vector<std::uint32_t>& indices,
                              std::size_t begin, std::size_t count)
{
    const std::uint32_t* v = indices.data() + begin;
    const auto triangle = [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        _triangles.insert(_triangles.end(), {a, b, c});
    };
    switch (mode)
    {
    case GL_TRIANGLES:
        _triangles.insert(_triangles.end(), v, v + count / 3 * 3);
        break;
    case GL_QUADS:
        _quads.insert(_quads.end(), v, v + count / 4 * 4);
        break;
    case GL_TRIANGLE_STRIP:
        for (std::size_t i = 2; i < count; ++i)
            if (i % 2)
                triangle(v[i - 1], v[i - 2], v[i]);
            else
                triangle(v[i - 2], v[i - 1], v[i]);
        break;
    case GL_TRIANGLE_FAN:
        for (std::size_t i = 2; i < count; ++i)
            triangle(v[0], v[i - 1], v[i]);
        break;
    case GL_POLYGON: // its first vertex is the one that counts
        for (std::size_t i = 2; i < count; ++i)
            triangle(v[i - 1], v[i], v[0]);
        break;
    case GL_QUAD_STRIP:
        for (std::size_t i = 3; i < count; i += 2)
            _quads.insert(_quads.end(), {v[i - 1], v[i - 3], v[i - 2], v[i]});
        break;
    }
}

osg::ref_ptr<osg::Geometry> ChunkMesh::finish()
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setDataVariance(osg::Object::STATIC);
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(_vertices);
    if (_layout.hasNormals)
        geometry->setNormalArray(_normals, osg::Array::BIND_PER_VERTEX);
    if (_colors)
        geometry->setColorArray(_colors, osg::Array::BIND_PER_VERTEX);
    for (unsigned int unit = 0; unit < MeshLayout::Units; ++unit)
        if (_texCoords[unit])
            geometry->setTexCoordArray(unit, _texCoords[unit], osg::Array::BIND_PER_VERTEX);
    _objects->setPreserveDataType(true);
    _objects->setName(ObjectsName);
    geometry->setVertexAttribArray(ObjectAttribute, _objects, osg::Array::BIND_PER_VERTEX);
    if (!_triangles.empty())
        geometry->addPrimitiveSet(makeElements(GL_TRIANGLES, _triangles, _vertices->size()));
    if (!_quads.empty())
        geometry->addPrimitiveSet(makeElements(GL_QUADS, _quads, _vertices->size()));
    return geometry;
}

} // namespace osgLabels
