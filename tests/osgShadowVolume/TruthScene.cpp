// SPDX-License-Identifier: MIT
#include "TruthScene.h"

#include <osg/Billboard>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/LightSource>
#include <osg/NodeVisitor>
#include <osg/PolygonMode>
#include <osg/TriangleFunctor>

#include <algorithm>
#include <cmath>
#include <map>

namespace truth
{

namespace
{

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Exact;
#else
using Exact = long double;
#endif

bool isFinite(const osg::Vec3f& v)
{
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

struct TriangleSink
{
    std::vector<Triangle>* triangles = nullptr;
    unsigned int frame = 0;
    Culled culled = Culled::NONE;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c)
    {
        if (isFinite(a) && isFinite(b) && isFinite(c))
            triangles->push_back({{a, b, c}, frame, culled});
    }
};

Culled culledBy(const osg::NodePath& path, const osg::StateSet* last)
{
    bool enabled = false;
    osg::CullFace::Mode mode = osg::CullFace::BACK;
    bool clockwise = false;
    const auto apply = [&](const osg::StateSet* stateSet)
    {
        if (!stateSet)
            return;
        const auto value = stateSet->getMode(GL_CULL_FACE);
        if (!(value & osg::StateAttribute::INHERIT))
            enabled = value & osg::StateAttribute::ON;
        if (const auto* face = dynamic_cast<const osg::CullFace*>(
                stateSet->getAttribute(osg::StateAttribute::CULLFACE)))
            mode = face->getMode();
        if (const auto* front = dynamic_cast<const osg::FrontFace*>(
                stateSet->getAttribute(osg::StateAttribute::FRONTFACE)))
            clockwise = front->getMode() == osg::FrontFace::CLOCKWISE;
    };
    for (const osg::Node* node : path)
        apply(node->getStateSet());
    apply(last);
    if (!enabled)
        return Culled::NONE;
    if (mode == osg::CullFace::FRONT_AND_BACK)
        return Culled::BOTH;
    return (mode == osg::CullFace::BACK) != clockwise ? Culled::BACK : Culled::FRONT;
}

int handednessOf(const osg::Matrixd& m)
{
    const osg::Vec3d x(m(0, 0), m(0, 1), m(0, 2)), y(m(1, 0), m(1, 1), m(1, 2)),
        z(m(2, 0), m(2, 1), m(2, 2));
    const double determinant = (x ^ y) * z;
    return determinant > 0.0 ? 1 : determinant < 0.0 ? -1 : 0;
}

/// Polygons that are drawn as lines or points cast nothing.
bool isWireframe(const osg::NodePath& path, const osg::StateSet* own)
{
    const osg::PolygonMode* mode = nullptr;
    const auto look = [&mode](const osg::StateSet* stateSet)
    {
        if (const auto* attribute =
                stateSet ? stateSet->getAttribute(osg::StateAttribute::POLYGONMODE) : nullptr)
            mode = static_cast<const osg::PolygonMode*>(attribute);
    };
    for (const osg::Node* node : path)
        look(node->getStateSet());
    look(own);
    return mode && mode->getMode(osg::PolygonMode::FRONT) != osg::PolygonMode::FILL;
}

class Collector : public osg::NodeVisitor
{
public:
    Collector(Scene& scene, const osg::Matrixd& view)
        : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), _scene(scene),
          _eyeToWorld(osg::Matrixd::inverse(view))
    {
    }

    void apply(osg::LightSource& source) override
    {
        if (const osg::Light* light = source.getLight())
        {
            const bool absolute = source.getReferenceFrame() == osg::LightSource::ABSOLUTE_RF;
            const Light found =
                makeLight(*light, absolute ? _eyeToWorld : osg::computeLocalToWorld(getNodePath()));
            // Of equal numbers the last one counts.
            for (Light& known : _scene.lights)
            {
                if (known.number == found.number)
                {
                    known = found;
                    return traverse(source);
                }
            }
            _scene.lights.push_back(found);
        }
        traverse(source);
    }

    void apply(osg::Billboard&) override {}

    void apply(osg::Drawable& drawable) override
    {
        Frame frame;
        frame.toWorld = osg::computeLocalToWorld(getNodePath());
        frame.fromWorld = osg::Matrixd::inverse(frame.toWorld);
        frame.handedness = handednessOf(frame.toWorld);
        if (isWireframe(getNodePath(), drawable.getStateSet()))
            return;
        osg::TriangleFunctor<TriangleSink> sink;
        sink.triangles = &_scene.triangles;
        sink.frame = static_cast<unsigned int>(_scene.frames.size());
        sink.culled = culledBy(getNodePath(), drawable.getStateSet());
        _scene.frames.push_back(frame);
        drawable.accept(sink);
    }

private:
    Scene& _scene;
    osg::Matrixd _eyeToWorld;
};

} // namespace

Scene::Scene(osg::Node& node, const osg::Matrixd& view)
{
    Collector collector(*this, view);
    node.accept(collector);
}

Light makeLight(const osg::Light& light, const osg::Matrixd& toWorld)
{
    Light result;
    result.number = light.getLightNum();
    result.position = osg::Vec4d(light.getPosition()) * toWorld;
    if (light.getPosition().w() != 0.0f)
        result.position /= result.position.w();
    result.direction = osg::Matrixd::transform3x3(osg::Vec3d(light.getDirection()), toWorld);
    result.direction.normalize();
    if (light.getSpotCutoff() != 180.0f)
        result.cosCutoff = std::cos(osg::DegreesToRadians(double(light.getSpotCutoff())));
    return result;
}

int sideOf(const Triangle& triangle, const Frame& frame, const Light& light)
{
    const osg::Vec4d l = light.position * frame.fromWorld;
    Exact edge[3][3];
    for (int k = 0; k < 3; ++k)
    {
        const Exact a = triangle.local[0][k];
        edge[0][k] = triangle.local[1][k] - a;
        edge[1][k] = triangle.local[2][k] - a;
        edge[2][k] = l[k] - a * Exact(l.w());
    }
    Exact determinant = 0, size = 0;
    for (int k = 0; k < 3; ++k)
    {
        const int m = (k + 1) % 3, n = (k + 2) % 3;
        const Exact left = edge[2][k] * edge[0][m] * edge[1][n];
        const Exact right = edge[2][k] * edge[0][n] * edge[1][m];
        determinant += left - right;
        size += (left < 0 ? -left : left) + (right < 0 ? -right : right);
    }
    // The sum of the roundings of differences, products and sums of floats, 2^-24 each, and of the
    // light's own place, which casters know to 48 bits.
    Exact reach = 0;
    for (int k = 0; k < 3; ++k)
        reach = std::max({reach, Exact(std::abs(l[k])), Exact(std::abs(triangle.local[0][k]))});
    Exact area = 0;
    for (int k = 0; k < 3; ++k)
    {
        const int m = (k + 1) % 3, n = (k + 2) % 3;
        const Exact normal = edge[0][m] * edge[1][n] - edge[0][n] * edge[1][m];
        area += normal < 0 ? -normal : normal;
    }
    const Exact limit = 1e-6 * size + 1e-13 * reach * area;
    if (light.sideIfNear != -2 && determinant <= limit && -determinant <= limit)
        return light.sideIfNear * frame.handedness;
    const int local = determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
    return local * frame.handedness;
}

bool touches(const Triangle& triangle, const Frame& frame, const Light& light)
{
    if (light.position.w() == 0.0)
        return false;
    const osg::Vec4d l = light.position * frame.fromWorld;
    const osg::Vec3d p(l.x() / l.w(), l.y() / l.w(), l.z() / l.w());
    double reach = p.length();
    for (const osg::Vec3f& corner : triangle.local)
        reach = std::max(reach, double(corner.length()));
    const double limit = 1e-6 * reach;
    const osg::Vec3d a(triangle.local[0]), b(triangle.local[1]), c(triangle.local[2]);
    osg::Vec3d normal = (b - a) ^ (c - a);
    if (normal.normalize() > 0.0 && std::abs((p - a) * normal) <= limit &&
        ((b - a) ^ (p - a)) * normal >= 0.0 && ((c - b) ^ (p - b)) * normal >= 0.0 &&
        ((a - c) ^ (p - c)) * normal >= 0.0)
        return true;
    for (int k = 0; k < 3; ++k)
    {
        const osg::Vec3d from(triangle.local[k]),
            edge = osg::Vec3d(triangle.local[(k + 1) % 3]) - from;
        const double length2 = edge.length2();
        const double share =
            length2 > 0.0 ? std::clamp((p - from) * edge / length2, 0.0, 1.0) : 0.0;
        if ((p - from - edge * share).length() <= limit)
            return true;
    }
    return false;
}

} // namespace truth
