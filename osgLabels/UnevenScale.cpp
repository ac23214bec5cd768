// SPDX-License-Identifier: MIT
#include <osgLabels/UnevenScale.h>

#include <osg/Geometry>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

osg::Matrixd linearOf(osg::Matrixd m)
{
    m.setTrans(0.0, 0.0, 0.0);
    m(0, 3) = m(1, 3) = m(2, 3) = 0.0;
    m(3, 3) = 1.0;
    return m;
}

osg::Matrixd transposed(const osg::Matrixd& m)
{
    osg::Matrixd result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            result(i, j) = m(j, i);
    return result;
}

double determinantOf(const osg::Matrixd& m)
{
    const osg::Vec3d x(m(0, 0), m(0, 1), m(0, 2)), y(m(1, 0), m(1, 1), m(1, 2)),
        z(m(2, 0), m(2, 1), m(2, 2));
    return x * (y ^ z);
}

/// The rotation or reflection that is nearest to a matrix, by Newton's iteration: it doubles the
/// digits each time once it is near, and takes one turn for each factor of 2 before.
osg::Matrixd rotationOf(osg::Matrixd m)
{
    for (int turn = 0; turn < 40; ++turn)
    {
        const osg::Matrixd inverse = transposed(osg::Matrixd::inverse(m));
        double change = 0.0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
            {
                const double next = 0.5 * (m(i, j) + inverse(i, j));
                change = std::max(change, std::abs(next - m(i, j)));
                m(i, j) = next;
            }
        if (change < 1e-14)
            break;
    }
    return m;
}

} // namespace

std::optional<osg::Matrixd> unevenScaleOf(const osg::Matrixd& matrix)
{
    osg::Matrixd linear = linearOf(matrix);
    const double factor = std::cbrt(std::abs(determinantOf(linear)));
    if (!std::isfinite(factor) || factor <= 0.0)
        return {};
    linear = linear * osg::Matrixd::scale(1.0 / factor, 1.0 / factor, 1.0 / factor);
    double largest = 0.0, off = 0.0;
    const osg::Matrixd squared = linear * transposed(linear);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
        {
            largest = std::max(largest, std::abs(squared(i, j)));
            off = std::max(off, std::abs(squared(i, j) - double(i == j)));
        }
    // At determinant 1, what is flattened by 10,000 to 1 is 10^(4/3) long at least.
    if (!(off > 2e-6) || !(largest < 1e5))
        return {};
    osg::Matrixd scale = linear * transposed(rotationOf(linear));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j)
            scale(i, j) = scale(j, i) = 0.5 * (scale(i, j) + scale(j, i));
    return scale;
}

std::uint32_t UnevenScales::hold(const osg::Drawable& drawable, const osg::Matrixd& matrix)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry || !dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()))
        return 0;
    const auto scale = unevenScaleOf(matrix);
    if (!scale)
        return 0;
    Key key{};
    for (int i = 0, at = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j, ++at) // what differs by rounding is the same
            key[std::size_t(at)] = float(std::round((*scale)(i, j) * 1e6) * 1e-6);
    std::uint32_t& number = _numbers[key];
    if (!number)
    {
        if (_free.empty())
        {
            _all.emplace_back();
            _free.push_back(static_cast<std::uint32_t>(_all.size()));
        }
        number = _free.back();
        _free.pop_back();
        _all[number - 1] = {std::make_shared<const osg::Matrixd>(*scale), key, 0};
    }
    ++_all[number - 1].holders;
    return number;
}

void UnevenScales::release(std::uint32_t number)
{
    if (!number || --_all[number - 1].holders)
        return;
    _numbers.erase(_all[number - 1].key);
    _all[number - 1] = {};
    _free.push_back(number);
}

} // namespace osgLabels
