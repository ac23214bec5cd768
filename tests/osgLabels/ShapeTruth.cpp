// SPDX-License-Identifier: MIT
#include "ShapeTruth.h"

#include <osgLabels/DrawableFit.h>

#include <osg/ShapeDrawable>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

const char Text[] = "Pump P-1047/B @&%";
constexpr double Degree = 3.14159265358979 / 180.0, FieldOfView = 30.0;
/// Segments around, so that the mesh is nowhere a hundredth of a pixel off its shape.
constexpr float Detail = 30.0f;

osg::Vec3d toOsg(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

osg::ref_ptr<osg::Shape> makeShape(const std::string& name)
{
    if (name == "box")
        return new osg::Box(osg::Vec3(), 4.0f, 1.2f, 1.0f);
    if (name == "cylinder")
        return new osg::Cylinder(osg::Vec3(), 0.8f, 2.0f);
    if (name == "sphere")
        return new osg::Sphere(osg::Vec3(), 1.0f);
    if (name == "cone")
        return new osg::Cone(osg::Vec3(), 1.0f, 2.0f);
    throw std::runtime_error("ShapeTruth: no shape '" + name + "'");
}

/// Turned about an axis of length 1.
glm::dvec3 turn(const glm::dvec3& v, const glm::dvec3& axis, double degrees)
{
    return glm::angleAxis(degrees * Degree, axis) * v;
}

/// Nearest place of a ray in front of it where the quadratic is 0 and `isOn`.
template <typename IsOn> double solve(double a, double b, double c, const IsOn& isOn)
{
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0 || a == 0.0)
        return -1.0;
    const double root = std::sqrt(discriminant);
    const double first = (-b - root) / a, second = (-b + root) / a;
    for (const double t : {std::min(first, second), std::max(first, second)})
        if (t > 0.0 && isOn(t))
            return t;
    return -1.0;
}

} // namespace

struct ShapeTruth::Eye
{
    glm::dvec3 eye, forward, right, up;
    double perPixel; ///< Change of a ray, of length 1 along `forward`.
};

ShapeTruth::ShapeTruth(const std::string& name) : _node(new osg::Geode)
{
    const osg::ref_ptr<osg::ShapeDrawable> drawable = new osg::ShapeDrawable(makeShape(name));
    const osg::ref_ptr<osg::TessellationHints> hints = new osg::TessellationHints;
    hints->setDetailRatio(Detail);
    drawable->setTessellationHints(hints);
    drawable->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f));
    drawable->setUseDisplayList(false);
    drawable->setUseVertexBufferObjects(true);
    drawable->build();
    _node->addDrawable(drawable);
    _node->setName(Text);
    _record = osgLabels::fitDrawable(*drawable).record(1);
    std::string error;
    const auto face = osgLabels::FontFace::openOrDefault("", error);
    if (!face)
        throw std::runtime_error(error);
    _glyphs = std::make_shared<osgLabels::GlyphSet>(face);
    _codes = _glyphs->codesOf(Text);
    _truth = std::make_unique<CoverageTruth>(*_glyphs);
    _width = static_cast<float>(_codes.size()) * _glyphs->getCellAdvance();
    findText();
}

ShapeTruth::Hit ShapeTruth::meet(const glm::dvec3& eye, const glm::dvec3& ray) const
{
    const glm::dquat rotation(_record.rotation);
    const glm::dvec3 o = rotation * (eye - glm::dvec3(_record.origin)), d = rotation * ray;
    const glm::dvec3 size(_record.size);
    const auto shape = static_cast<osgLabels::Shape>(_record.shape & osgLabels::ShapeMask);
    double nearest = std::numeric_limits<double>::max();
    glm::dvec3 normal(0.0);
    const auto take = [&](double t, const glm::dvec3& n)
    {
        if (t > 0.0 && t < nearest)
        {
            nearest = t;
            normal = n;
        }
    };
    if (shape == osgLabels::Shape::Box)
        for (int axis = 0; axis < 3; ++axis)
        {
            const double t = ((d[axis] > 0.0 ? -size[axis] : size[axis]) - o[axis]) / d[axis];
            const glm::dvec3 p = glm::abs(o + t * d), room = size * (1.0 + 1e-12);
            glm::dvec3 n(0.0);
            n[axis] = d[axis] > 0.0 ? -1.0 : 1.0;
            if (p.x <= room.x && p.y <= room.y && p.z <= room.z)
                take(t, n);
        }
    else if (shape == osgLabels::Shape::Sphere)
    {
        const double t = solve(glm::dot(d, d), glm::dot(o, d), glm::dot(o, o) - size.x * size.x,
                               [](double) { return true; });
        take(t, glm::normalize(o + t * d));
    }
    else
    {
        // The radius is middle + slope z.
        const double low = size.x, high = shape == osgLabels::Shape::Cylinder ? size.x : size.y;
        const double slope = (high - low) / (2.0 * size.z), middle = 0.5 * (low + high);
        const double r = middle + slope * o.z, change = slope * d.z;
        const double t = solve(d.x * d.x + d.y * d.y - change * change,
                               o.x * d.x + o.y * d.y - r * change, o.x * o.x + o.y * o.y - r * r,
                               [&](double at) { return std::abs(o.z + at * d.z) <= size.z; });
        const glm::dvec3 p = o + t * d;
        take(t, glm::normalize(glm::dvec3(p.x, p.y, -slope * std::hypot(p.x, p.y))));
        for (const double z : {-size.z, size.z})
        {
            const double s = (z - o.z) / d.z;
            const glm::dvec3 q = o + s * d;
            if (std::hypot(q.x, q.y) <= (z < 0.0 ? low : high))
                take(s, {0.0, 0.0, z < 0.0 ? -1.0 : 1.0});
        }
    }
    if (normal == glm::dvec3(0.0))
        return {};
    return {eye + nearest * ray, glm::inverse(rotation) * normal, true};
}

osgLabels::LabelPlace ShapeTruth::getPlace(const Eye& eye, const Hit& hit,
                                           const glm::dvec3& ray) const
{
    // A pixel to the side, on the plane that touches the surface.
    const double away = glm::dot(hit.point - eye.eye, hit.normal);
    const auto step = [&](const glm::dvec3& side)
    {
        const glm::dvec3 other = ray + eye.perPixel * side;
        return glm::vec3(other * (away / glm::dot(other, hit.normal)) - (hit.point - eye.eye));
    };
    osgLabels::PlacementView view;
    view.base = glm::vec3(eye.eye - glm::dvec3(_record.origin));
    view.eye = glm::vec4(view.base, 1.0f);
    view.up = {0.0f, 0.0f, 1.0f};
    view.screenUp = glm::vec3(eye.up);
    view.screenRight = glm::vec3(eye.right);
    return osgLabels::placeOn(_record, glm::vec3(hit.point - eye.eye), step(eye.right),
                              step(eye.up), view, _width);
}

void ShapeTruth::findText()
{
    // Places all over the shape, but for its flat ends, each seen along its normal.
    double least = std::numeric_limits<double>::max();
    constexpr int Places = 40000;
    for (int i = 0; i < Places; ++i)
    {
        const double z = 2.0 * (i + 0.5) / Places - 1.0, angle = 2.399963229728653 * i;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 from(r * std::cos(angle), r * std::sin(angle), z);
        const glm::dvec3 middle(_record.origin);
        const Hit hit = meet(middle + 100.0 * from, -from);
        if (!hit.isHit || std::abs(hit.normal.z) > 0.7)
            continue;
        Eye eye;
        eye.eye = hit.point + 10.0 * hit.normal;
        eye.forward = -hit.normal;
        eye.right = glm::normalize(glm::cross(eye.forward, glm::dvec3(0.0, 0.0, 1.0)));
        eye.up = glm::cross(eye.right, eye.forward);
        eye.perPixel = 1e-3;
        const osgLabels::LabelPlace at = getPlace(eye, hit, eye.forward);
        const double off = glm::distance(at.place, glm::vec2(0.5f * _width, 0.5f));
        if (!at.inside || off >= least)
            continue;
        least = off;
        _middle = hit.point;
        _normal = hit.normal;
        const glm::dvec2 gradient(at.footprint[0].x, at.footprint[1].x);
        _along = glm::normalize(gradient.x * eye.right + gradient.y * eye.up);
        _em = 10.0 * eye.perPixel / glm::length(gradient);
    }
    if (!(least < 0.5))
        throw std::runtime_error("ShapeTruth: no text is found on the shape");
}

ShapeTruth::Eye ShapeTruth::getEye(const ShapeView& view) const
{
    const glm::dvec3 upright = glm::cross(_normal, _along);
    Eye eye;
    eye.perPixel = 2.0 * std::tan(0.5 * FieldOfView * Degree) / view.size;
    eye.forward = -turn(_normal, upright, view.tilt);
    // Not on a point that the pixels' grid has.
    const glm::dvec3 target = _middle + _em * (0.137 * _along + 0.071 * upright);
    eye.eye = target - eye.forward * (_em / (view.pixelsPerEm * eye.perPixel));
    eye.up = turn(upright, eye.forward, view.roll);
    eye.right = glm::cross(eye.forward, eye.up);
    eye.eye += _em / view.pixelsPerEm * (view.shift.x * eye.right + view.shift.y * eye.up);
    return eye;
}

support::CameraSpec ShapeTruth::getCamera(const ShapeView& view) const
{
    const Eye eye = getEye(view);
    const double far = glm::distance(eye.eye, _middle) + 10.0;
    return support::CameraSpec::perspective(toOsg(eye.eye), toOsg(eye.eye + eye.forward),
                                            toOsg(eye.up), FieldOfView, 1.0, 1e-3 * far, far);
}

osg::ref_ptr<osg::Image> ShapeTruth::makeTruth(const ShapeView& view) const
{
    const Eye eye = getEye(view);
    osg::ref_ptr<osg::Image> picture = new osg::Image;
    picture->allocateImage(view.size, view.size, 1, GL_RED, GL_FLOAT);
    /// 1 for ink, 0 for none, -1 beside texts.
    const auto sample = [&](double x, double y)
    {
        const double half = 0.5 * view.size;
        const glm::dvec3 ray =
            eye.forward + eye.perPixel * ((x - half) * eye.right + (y - half) * eye.up);
        const Hit hit = meet(eye.eye, ray);
        if (!hit.isHit)
            return -1;
        const osgLabels::LabelPlace at = getPlace(eye, hit, ray);
        return at.inside ? int(_truth->isInk(_codes, at.place)) : -1;
    };
    const auto isOnText = [&](int x, int y)
    {
        return sample(x, y) >= 0 && sample(x + 1.0, y) >= 0 && sample(x, y + 1.0) >= 0 &&
               sample(x + 1.0, y + 1.0) >= 0;
    };
    for (int y = 0; y < view.size; ++y)
        for (int x = 0; x < view.size; ++x)
        {
            const bool isCandidate = isOnText(x, y);
            int hits = 0;
            for (int i = 0; i < CoverageTruth::Samples && hits >= 0 && isCandidate; ++i)
            {
                const double turns = (i + 0.5) * 0.6180339887498949;
                const int ink =
                    sample(x + (i + 0.5) / CoverageTruth::Samples, y + turns - std::floor(turns));
                hits = ink < 0 ? -1 : hits + ink;
            }
            const bool isWhole = hits >= 0 && isCandidate;
            *reinterpret_cast<float*>(picture->data(x, y)) =
                isWhole ? static_cast<float>(hits) / CoverageTruth::Samples
                        : std::numeric_limits<float>::quiet_NaN();
        }
    return picture;
}

double getShapeError(const osg::Image& picture, const osg::Image& truth, int* pixels)
{
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < truth.t(); ++y)
        for (int x = 0; x < truth.s(); ++x)
        {
            const float expected = *reinterpret_cast<const float*>(truth.data(x, y));
            if (std::isnan(expected))
                continue;
            const double difference = 1.0 - picture.data(x, y)[0] / 255.0 - expected;
            sum += difference * difference;
            ++count;
        }
    if (pixels)
        *pixels = count;
    return count ? 100.0 * std::sqrt(sum / count) : -1.0;
}
