// SPDX-License-Identifier: MIT
#include "FeatureSubject.h"

#include <osg/LightSource>

#include <cmath>

namespace feature
{

namespace
{

/// A grid of points over (s, t) in the unit square, drawn as one strip of triangles a row.
class Grid
{
public:
    Grid(unsigned int columns, unsigned int rows, const Subject& subject)
        : _columns(columns), _rows(rows), _subject(subject)
    {
    }

    void addPoint(const osg::Vec3& position, osg::Vec3 normal, double s, double t)
    {
        const float uneven = 0.4f + 1.6f * float(0.5 + 0.5 * std::sin(9.0 * s + 5.0 * t));
        if (_subject.normals == Subject::Normals::Uneven)
            normal *= uneven;
        if (_subject.normals == Subject::Normals::Zero)
            normal = osg::Vec3();
        _positions->push_back(position);
        _normals->push_back(normal);
        _texCoords->push_back(osg::Vec3(s, t, 0.5 + 0.5 * s * t));
        _colors->push_back(osg::Vec4(0.5 + 0.5 * std::cos(6.3 * s), 0.5 + 0.5 * std::sin(6.3 * t),
                                     s * t, 0.25 + 0.75 * t));
    }

    osg::ref_ptr<osg::Geometry> getGeometry() const
    {
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(_positions);
        if (_subject.normals != Subject::Normals::None)
            geometry->setNormalArray(_normals, osg::Array::BIND_PER_VERTEX);
        addColors(*geometry);
        addTexCoords(*geometry);
        for (unsigned int row = 0; row < _rows; ++row)
        {
            osg::ref_ptr<osg::DrawElementsUShort> strip =
                new osg::DrawElementsUShort(GL_TRIANGLE_STRIP);
            for (unsigned int column = 0; column <= _columns; ++column)
            {
                strip->push_back((row + 1) * (_columns + 1) + column);
                strip->push_back(row * (_columns + 1) + column);
            }
            geometry->addPrimitiveSet(strip);
        }
        return geometry;
    }

private:
    void addColors(osg::Geometry& geometry) const
    {
        osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
        switch (_subject.colors)
        {
        case Subject::Colors::None:
            break;
        case Subject::Colors::Overall:
            colors->push_back(osg::Vec4(0.9f, 0.5f, 0.2f, 0.7f));
            geometry.setColorArray(colors, osg::Array::BIND_OVERALL);
            break;
        case Subject::Colors::PerPrimitiveSet:
            for (unsigned int row = 0; row < _rows; ++row)
                colors->push_back((*_colors)[row * (_columns + 1) + row % _columns]);
            geometry.setColorArray(colors, osg::Array::BIND_PER_PRIMITIVE_SET);
            break;
        case Subject::Colors::PerVertex:
            geometry.setColorArray(_colors, osg::Array::BIND_PER_VERTEX);
            break;
        }
    }

    void addTexCoords(osg::Geometry& geometry) const
    {
        for (unsigned int unit = 0; unit < 5; ++unit)
        {
            osg::ref_ptr<osg::Vec3Array> coords = new osg::Vec3Array(*_texCoords);
            for (osg::Vec3& coord : *coords)
                coord = coord * float(2 + unit) + osg::Vec3(0.11f * unit, 0.07f * unit, 0.0f);
            geometry.setTexCoordArray(unit, coords, osg::Array::BIND_PER_VERTEX);
        }
    }

    unsigned int _columns, _rows;
    Subject _subject;
    osg::ref_ptr<osg::Vec3Array> _positions = new osg::Vec3Array, _normals = new osg::Vec3Array,
                                 _texCoords = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec4Array> _colors = new osg::Vec4Array;
};

} // namespace

osg::ref_ptr<osg::Geometry> torus(const Subject& subject)
{
    const unsigned int columns = 24, rows = 12;
    Grid grid(columns, rows, subject);
    const double around = subject.open ? osg::PI : 2.0 * osg::PI;
    const double start = subject.open ? 0.75 * osg::PI : 0.3; // shows both sides to the camera
    for (unsigned int row = 0; row <= rows; ++row)
    {
        for (unsigned int column = 0; column <= columns; ++column)
        {
            const double s = double(column) / columns, t = double(row) / rows;
            const double u = 2.0 * osg::PI * s, v = around * t + start;
            const osg::Vec3d ring(std::cos(u), 0.3 * std::sin(u), std::sin(u));
            const osg::Vec3d axis(0.0, -1.0, 0.3);
            osg::Vec3d normal = ring * std::cos(v) + axis * std::sin(v);
            normal.normalize();
            grid.addPoint(ring * 0.75 + normal * 0.3, normal, s, t);
        }
    }
    return grid.getGeometry();
}

osg::ref_ptr<osg::Geometry> backdrop(const Subject& subject)
{
    const unsigned int cells = 8;
    Grid grid(cells, cells, subject);
    const osg::Vec3 corner(-1.4f, 0.2f, -1.3f), right(2.8f, 0.0f, 0.0f), up(0.0f, 1.6f, 2.4f);
    osg::Vec3 normal = right ^ up;
    normal.normalize();
    for (unsigned int row = 0; row <= cells; ++row)
    {
        for (unsigned int column = 0; column <= cells; ++column)
        {
            const float s = float(column) / cells, t = float(row) / cells;
            grid.addPoint(corner + right * s + up * t, normal, s, t);
        }
    }
    return grid.getGeometry();
}

osg::ref_ptr<osg::Geode> subjectGeode(const Subject& subject)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(backdrop(subject));
    geode->addDrawable(torus(subject));
    return geode;
}

osg::ref_ptr<osg::Image> pattern(GLenum pixelFormat, unsigned int seed)
{
    const int size = 16;
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, pixelFormat, GL_UNSIGNED_BYTE, 1);
    const double phase = 1.7 * seed;
    for (int y = 0; y < size; ++y)
    {
        for (int x = 0; x < size; ++x)
        {
            const double s = 2.0 * osg::PI * x / size, t = 2.0 * osg::PI * y / size;
            const double red = 0.5 + 0.45 * std::sin(s + phase);
            const double green = 0.5 + 0.45 * std::cos(t - phase);
            const double blue = 0.5 + 0.45 * std::sin(s + t + 2.0 * phase);
            const double alpha = 0.5 + 0.5 * std::cos(0.5 * s + phase);
            image->setColor(osg::Vec4(red, green, blue, alpha), x, y);
        }
    }
    return image;
}

osg::ref_ptr<osg::Texture2D> texture2D(GLenum pixelFormat, unsigned int seed)
{
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(pattern(pixelFormat, seed));
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

osg::ref_ptr<osg::Light> light(unsigned int number)
{
    osg::ref_ptr<osg::Light> result = new osg::Light(number);
    result->setPosition(osg::Vec4(-0.6f + 0.25f * number, -1.0f, 0.8f - 0.2f * number, 0.0f));
    result->setAmbient(osg::Vec4(0.05f, 0.05f, 0.05f, 1.0f));
    result->setDiffuse(osg::Vec4(0.7f, 0.4f + 0.05f * number, 0.9f - 0.1f * number, 1.0f));
    result->setSpecular(osg::Vec4(0.4f, 0.4f, 0.3f, 1.0f));
    return result;
}

void addLight(osg::Group& root, osg::Light* light)
{
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(light);
    root.addChild(source);
    root.getOrCreateStateSet()->setMode(GL_LIGHT0 + light->getLightNum(), osg::StateAttribute::ON);
}

FeatureScene& Family::add(const std::string& name, const Build& build, const Subject& subject)
{
    return addNodes(name,
                    [build, subject](osg::Group& root)
                    {
                        root.addChild(subjectGeode(subject));
                        build(root);
                    });
}

FeatureScene& Family::addNodes(const std::string& name, const Build& build)
{
    FeatureScene scene;
    scene.family = _name;
    scene.name = name;
    scene.create = [build]() -> osg::ref_ptr<osg::Node>
    {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        build(*root);
        return root;
    };
    _scenes.push_back(scene);
    return _scenes.back();
}

} // namespace feature
