// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MixedArrays.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace osgPagedTexture
{

namespace
{

/// One vertex counts as it is: mixed with nothing, also where others are not finite.
int wholeIndex(const MixedVertex& vertex)
{
    for (int i = 0; i < 3; ++i)
        if (vertex.weights[i] == 1.0)
            return i;
    return -1;
}

int heaviest(const MixedVertex& vertex)
{
    int found = 0;
    for (int i = 1; i < 3; ++i)
        if (vertex.weights[i] > vertex.weights[found])
            found = i;
    return found;
}

template <class Array> class Mixer
{
public:
    using Value = typename Array::value_type;

    Mixer(const Array& from, Array& to) : _from(from), _to(to) {}

    void add(const MixedVertex& vertex)
    {
        const int whole = wholeIndex(vertex);
        _to.push_back(whole >= 0 ? at(vertex, whole) : mix(vertex));
    }

private:
    const Value& at(const MixedVertex& vertex, int i) const
    {
        return _from[std::min<std::size_t>(vertex.indices[std::size_t(i)], _from.size() - 1)];
    }

    Value mix(const MixedVertex& vertex) const
    {
        if constexpr (std::is_floating_point_v<Value>)
            return Value(mixNumbers(vertex, [](const Value& v) { return double(v); }));
        else if constexpr (std::is_class_v<Value>)
            return mixVector(vertex);
        else
            return at(vertex, heaviest(vertex));
    }

    Value mixVector(const MixedVertex& vertex) const
    {
        using Number = typename Value::value_type;
        constexpr bool isColor = std::is_same_v<Value, osg::Vec4ub>;
        if constexpr (std::is_floating_point_v<Number> || isColor)
        {
            Value mixed;
            for (int component = 0; component < int(Value::num_components); ++component)
            {
                double sum =
                    mixNumbers(vertex, [&](const Value& v) { return double(v[component]); });
                if (isColor)
                    sum = std::floor(sum + 0.5);
                mixed[component] = Number(sum);
            }
            return mixed;
        }
        return at(vertex, heaviest(vertex));
    }

    template <class Read> double mixNumbers(const MixedVertex& vertex, const Read& read) const
    {
        double sum = 0.0;
        for (int i = 0; i < 3; ++i)
            if (vertex.weights[i] != 0.0)
                sum += vertex.weights[i] * read(at(vertex, i));
        return sum;
    }

    const Array& _from;
    Array& _to;
};

/// Makes the new array of an old one.
class ArrayMixer : public osg::ConstArrayVisitor
{
public:
    ArrayMixer(osg::Array& to, const std::vector<MixedVertex>& vertices)
        : _to(to), _vertices(vertices)
    {
    }

    using osg::ConstArrayVisitor::apply;
    void apply(const osg::ByteArray& a) override { mix(a); }
    void apply(const osg::ShortArray& a) override { mix(a); }
    void apply(const osg::IntArray& a) override { mix(a); }
    void apply(const osg::UByteArray& a) override { mix(a); }
    void apply(const osg::UShortArray& a) override { mix(a); }
    void apply(const osg::UIntArray& a) override { mix(a); }
    void apply(const osg::FloatArray& a) override { mix(a); }
    void apply(const osg::DoubleArray& a) override { mix(a); }
    void apply(const osg::Vec2Array& a) override { mix(a); }
    void apply(const osg::Vec3Array& a) override { mix(a); }
    void apply(const osg::Vec4Array& a) override { mix(a); }
    void apply(const osg::Vec2dArray& a) override { mix(a); }
    void apply(const osg::Vec3dArray& a) override { mix(a); }
    void apply(const osg::Vec4dArray& a) override { mix(a); }
    void apply(const osg::Vec2bArray& a) override { mix(a); }
    void apply(const osg::Vec3bArray& a) override { mix(a); }
    void apply(const osg::Vec4bArray& a) override { mix(a); }
    void apply(const osg::Vec2sArray& a) override { mix(a); }
    void apply(const osg::Vec3sArray& a) override { mix(a); }
    void apply(const osg::Vec4sArray& a) override { mix(a); }
    void apply(const osg::Vec4ubArray& a) override { mix(a); }

    bool known = false;

private:
    template <class Array> void mix(const Array& from)
    {
        auto& to = static_cast<Array&>(_to);
        to.clear();
        to.reserve(_vertices.size());
        Mixer<Array> mixer(from, to);
        for (const MixedVertex& vertex : _vertices)
            mixer.add(vertex);
        known = true;
    }

    osg::Array& _to;
    const std::vector<MixedVertex>& _vertices;
};

/// Null: the array is of a type without values for mixing.
osg::ref_ptr<osg::Array> mixedArray(const osg::Array& array,
                                    const std::vector<MixedVertex>& vertices)
{
    osg::ref_ptr<osg::Array> mixed = static_cast<osg::Array*>(array.cloneType());
    ArrayMixer mixer(*mixed, vertices);
    array.accept(mixer);
    if (!mixer.known)
        return nullptr;
    mixed->setBinding(array.getBinding());
    mixed->setNormalize(array.getNormalize());
    mixed->setPreserveDataType(array.getPreserveDataType());
    mixed->setName(array.getName());
    return mixed;
}

void normalize(osg::Array* normals, const std::vector<MixedVertex>& vertices)
{
    auto* vectors = dynamic_cast<osg::Vec3Array*>(normals);
    for (std::size_t i = 0; vectors && i < vectors->size(); ++i)
        if (wholeIndex(vertices[i]) < 0)
            (*vectors)[i].normalize();
}

} // namespace

void replaceVertices(osg::Geometry& geometry, const std::vector<MixedVertex>& vertices)
{
    const auto replaced = [&](osg::Array* array) -> osg::ref_ptr<osg::Array>
    {
        if (!array || array->getNumElements() == 0 ||
            array->getBinding() != osg::Array::BIND_PER_VERTEX)
            return array;
        return mixedArray(*array, vertices);
    };
    geometry.setVertexArray(replaced(geometry.getVertexArray()).get());
    const osg::ref_ptr<osg::Array> normals = replaced(geometry.getNormalArray());
    if (normals != geometry.getNormalArray())
        normalize(normals, vertices);
    geometry.setNormalArray(normals);
    geometry.setColorArray(replaced(geometry.getColorArray()).get());
    geometry.setSecondaryColorArray(replaced(geometry.getSecondaryColorArray()).get());
    geometry.setFogCoordArray(replaced(geometry.getFogCoordArray()).get());
    for (unsigned int i = 0; i < geometry.getNumTexCoordArrays(); ++i)
        geometry.setTexCoordArray(i, replaced(geometry.getTexCoordArray(i)).get());
    for (unsigned int i = 0; i < geometry.getNumVertexAttribArrays(); ++i)
        geometry.setVertexAttribArray(i, replaced(geometry.getVertexAttribArray(i)).get());
}

} // namespace osgPagedTexture
