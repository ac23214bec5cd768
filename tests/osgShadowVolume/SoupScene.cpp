// SPDX-License-Identifier: MIT
#include "SoupScene.h"

#include "MaskCheck.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <cmath>
#include <iomanip>
#include <random>
#include <sstream>

namespace
{

/// Draws the parts of a scene, one after the other, from one stream of numbers.
class SoupMaker
{
public:
    SoupMaker(SoupScene& soup, std::uint32_t seed) : _soup(soup), _engine(seed) {}

    void make()
    {
        makeMatrices();
        makePoints();
        const unsigned int count = below(4) ? 1 + below(60) : 1 + below(4);
        for (unsigned int i = 0; i < count; ++i)
            _soup.triangles.push_back(makeTriangle());
        makeLight();
        makeCamera();
    }

private:
    unsigned int below(unsigned int n) { return _engine() % n; }

    double uniform(double low, double high)
    {
        return low + (high - low) * (double(_engine()) / double(_engine.max()));
    }

    osg::Vec3d point(double size)
    {
        const double x = uniform(-size, size), y = uniform(-size, size);
        return {x, y, uniform(-size, size)};
    }

    osg::Vec3d direction()
    {
        for (;;)
        {
            osg::Vec3d d = point(1.0);
            if (d.length2() <= 1.0 && d.normalize() > 0.01)
                return d;
        }
    }

    void makeMatrices();
    void makePoints();
    SoupScene::Triangle makeTriangle();
    osg::Vec4 special();
    void makeLight();
    void makeCamera();

    const osg::Vec3& any() { return _points[below(static_cast<unsigned int>(_points.size()))]; }

    SoupScene& _soup;
    std::mt19937 _engine;
    std::vector<osg::Vec3> _points; ///< Few, so that triangles have common edges.
};

void SoupMaker::makeMatrices()
{
    const unsigned int count = 1 + below(3);
    for (unsigned int i = 0; i < count; ++i)
    {
        osg::Matrixd matrix;
        const unsigned int kind = below(5);
        if (kind == 2)
            matrix = osg::Matrixd::scale(uniform(0.2, 2.0), uniform(0.2, 2.0), uniform(0.2, 2.0));
        if (kind == 3)
            matrix = osg::Matrixd::scale(uniform(-2.0, -0.2), uniform(0.2, 2.0), 1.0);
        if (kind > 0)
            matrix = matrix * osg::Matrixd::rotate(uniform(0.0, 6.3), direction()) *
                     osg::Matrixd::translate(point(0.7));
        if (kind == 4) // sheared
            matrix = matrix * osg::Matrixd::scale(uniform(0.5, 1.5), uniform(-1.5, 1.5), 1.0);
        _soup.matrices.push_back(matrix);
    }
}

void SoupMaker::makePoints()
{
    const unsigned int count = 3 + below(30);
    const bool snapped = below(3) == 0; // many in common planes and on common lines
    for (unsigned int i = 0; i < count; ++i)
    {
        osg::Vec3d p = point(1.2);
        if (snapped)
            for (int k = 0; k < 3; ++k)
                p[k] = std::round(p[k] * 2.0) / 2.0;
        _points.emplace_back(p);
    }
}

SoupScene::Triangle SoupMaker::makeTriangle()
{
    SoupScene::Triangle t{{any(), any(), any()}, below(unsigned(_soup.matrices.size()))};
    const unsigned int kind = below(12);
    if (kind == 0) // a sliver
        t.corner[2] = t.corner[0] + (t.corner[1] - t.corner[0]) * float(uniform(0.0, 1.0)) +
                      osg::Vec3(point(std::pow(10.0, uniform(-7.0, -2.0))));
    if (kind == 1) // degenerate
        t.corner[2] = t.corner[below(2)];
    if (kind == 2 && !_soup.triangles.empty()) // a duplicate, perhaps the other way round
    {
        t = _soup.triangles[below(static_cast<unsigned int>(_soup.triangles.size()))];
        if (below(2))
            std::swap(t.corner[0], t.corner[1]);
    }
    if (kind == 3) // small
        for (osg::Vec3& corner : t.corner)
            corner = t.corner[0] + osg::Vec3(point(0.1));
    return t;
}

/// A point in the plane of a triangle, on an edge, or a corner of it.
osg::Vec4 SoupMaker::special()
{
    const auto& t = _soup.triangles[below(static_cast<unsigned int>(_soup.triangles.size()))];
    const unsigned int kind = below(3);
    osg::Vec3d p = t.corner[0];
    if (kind > 0)
        p += (t.corner[1] - t.corner[0]) * (kind == 1 ? 0.5 : uniform(-2.0, 2.0));
    if (kind > 1)
        p += (t.corner[2] - t.corner[0]) * uniform(-2.0, 2.0);
    return osg::Vec4(osg::Vec3(p * _soup.matrices[t.drawable]), 1.0f);
}

void SoupMaker::makeLight()
{
    const unsigned int kind = below(8);
    if (kind < 2)
        _soup.light = osg::Vec4(direction(), 0.0);
    else if (kind == 2)
        _soup.light = special();
    else
        _soup.light = osg::Vec4(osg::Vec3(point(kind < 5 ? 1.0 : 4.0)), 1.0f);
    if (kind > 5)
    {
        _soup.cutoffDegrees = float(uniform(10.0, 90.0));
        _soup.direction =
            osg::Vec3(point(0.8)) - osg::Vec3(_soup.light.x(), _soup.light.y(), _soup.light.z());
    }
}

void SoupMaker::makeCamera()
{
    const bool inside = below(4) == 0;
    const osg::Vec3d eye = inside ? point(1.0) : direction() * uniform(3.0, 8.0);
    const osg::Vec3d center = point(0.3);
    const osg::Matrixd view = osg::Matrixd::lookAt(eye, center, direction());
    // A near plane that cuts triangles and volumes, now and then.
    const double distance = (eye - center).length();
    double near = inside ? 0.02 : 0.3 * distance;
    if (below(4) == 0)
        near = std::max(0.02, distance - uniform(0.0, 1.0));
    const double far = distance + (below(6) ? 6.0 : uniform(0.2, 1.0));
    _soup.camera.view = view;
    if (below(6) == 0)
        _soup.camera.projection = osg::Matrixd::ortho(-2.0, 2.0, -1.5, 1.5, near, far + near);
    else
        _soup.camera.projection = osg::Matrixd::perspective(inside ? 80.0 : uniform(20.0, 50.0),
                                                            4.0 / 3.0, near, far + near);
}

osg::Vec3 normalOf(const SoupScene::Triangle& t)
{
    osg::Vec3d normal =
        osg::Vec3d(t.corner[1] - t.corner[0]) ^ osg::Vec3d(t.corner[2] - t.corner[0]);
    normal.normalize();
    return normal;
}

void print(std::ostream& out, const osg::Matrixd& m)
{
    for (int i = 0; i < 16; ++i)
        out << (i ? ", " : "{") << m(i / 4, i % 4);
    out << "}";
}

} // namespace

SoupScene::SoupScene(std::uint32_t seed)
{
    SoupMaker(*this, seed).make();
}

osg::ref_ptr<osg::Group> SoupScene::createNode() const
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(truth::makeSource(0, light, direction, cutoffDegrees));
    for (unsigned int i = 0; i < matrices.size(); ++i)
    {
        osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
        for (const Triangle& triangle : triangles)
        {
            if (triangle.drawable != i)
                continue;
            vertices->insert(vertices->end(), triangle.corner, triangle.corner + 3);
            normals->insert(normals->end(), 3, normalOf(triangle));
        }
        if (vertices->empty())
            continue;
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(vertices);
        geometry->setNormalArray(normals);
        geometry->addPrimitiveSet(
            new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices->size())));
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(geometry);
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrices[i]);
        transform->addChild(geode);
        root->addChild(transform);
    }
    return root;
}

std::string SoupScene::describe() const
{
    std::ostringstream out;
    out << std::setprecision(17) << "light (" << light.x() << ", " << light.y() << ", " << light.z()
        << ", " << light.w() << ")";
    if (cutoffDegrees < 180.0f)
        out << " towards (" << direction.x() << ", " << direction.y() << ", " << direction.z()
            << "), cutoff " << cutoffDegrees;
    out << "\nview ";
    print(out, camera.view);
    out << "\nprojection ";
    print(out, camera.projection);
    for (unsigned int i = 0; i < matrices.size(); ++i)
    {
        out << "\nmatrix " << i << " ";
        print(out, matrices[i]);
    }
    for (const Triangle& t : triangles)
    {
        out << "\n" << t.drawable << ":";
        for (const osg::Vec3& c : t.corner)
            out << " (" << c.x() << ", " << c.y() << ", " << c.z() << ")";
    }
    return out.str();
}
