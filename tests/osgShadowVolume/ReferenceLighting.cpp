// SPDX-License-Identifier: MIT
#include "ReferenceLighting.h"

#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <thread>

namespace
{

struct SurfacePoint
{
    osg::Vec3d position, normal;
};

osg::Vec3d rgb(const osg::Vec4& color)
{
    return osg::Vec3d(color.r(), color.g(), color.b());
}

osg::Vec3d product(const osg::Vec3d& a, const osg::Vec3d& b)
{
    return osg::Vec3d(a.x() * b.x(), a.y() * b.y(), a.z() * b.z());
}

osg::Vec3d unit(osg::Vec3d v)
{
    v.normalize();
    return v;
}

/// A light of the scene in double, with what does not depend on the point worked out.
struct PreparedLight
{
    explicit PreparedLight(const osg::Light& light)
        : ambient(rgb(light.getAmbient())), diffuse(rgb(light.getDiffuse())),
          specular(rgb(light.getSpecular())), direction(unit(light.getDirection())),
          constant(light.getConstantAttenuation()), linear(light.getLinearAttenuation()),
          quadratic(light.getQuadraticAttenuation()), exponent(light.getSpotExponent()),
          isDirectional(light.getPosition().w() == 0.0f), isSpot(light.getSpotCutoff() != 180.0f),
          cosCutoff(std::cos(osg::DegreesToRadians(double(light.getSpotCutoff()))))
    {
        const osg::Vec4d p = light.getPosition();
        position = osg::Vec3d(p.x(), p.y(), p.z());
        position = isDirectional ? unit(position) : position / p.w();
    }

    /// Its strength at the point; `toLight` becomes a unit vector.
    double attenuationAt(const osg::Vec3d& point, osg::Vec3d& toLight) const
    {
        double fall = 1.0; // none from infinity
        if (isDirectional)
            toLight = position;
        else
        {
            toLight = position - point;
            const double distance = toLight.normalize();
            fall = constant + linear * distance + quadratic * distance * distance;
        }
        if (!isSpot)
            return 1.0 / fall;
        const double cosine = -(toLight * direction);
        return cosine < cosCutoff ? 0.0 : std::pow(cosine, exponent) / fall;
    }

    osg::Vec3d ambient, diffuse, specular, position, direction;
    double constant, linear, quadratic, exponent;
    bool isDirectional, isSpot;
    double cosCutoff;
};

class Renderer
{
public:
    Renderer(const ReferenceScene& scene, int width, int height, const osg::Vec4& background)
        : _scene(scene), _width(width), _height(height), _background(rgb(background)),
          _toWorld(osg::Matrixd::inverse(scene.view * scene.projection)),
          _eye(osg::Vec3d() * osg::Matrixd::inverse(scene.view))
    {
        // without a local viewer the eye is at infinity behind the camera
        _backwards = osg::Matrixd::transform3x3(scene.view, osg::Vec3d(0, 0, 1));
        for (const auto& light : scene.lights)
            _lights.emplace_back(*light);
    }

    /// The color, clamped to [0, 1], at a place in pixels.
    osg::Vec3d colorAt(double x, double y) const
    {
        const double clipX = 2.0 * x / _width - 1.0, clipY = 2.0 * y / _height - 1.0;
        const osg::Vec3d start = osg::Vec3d(clipX, clipY, -1.0) * _toWorld;
        const osg::Vec3d end = osg::Vec3d(clipX, clipY, 1.0) * _toWorld;
        const std::optional<SurfacePoint> point = intersect(start, unit(end - start));
        return point ? shade(*point) : _background;
    }

private:
    std::optional<SurfacePoint> intersect(const osg::Vec3d& start, const osg::Vec3d& ray) const
    {
        if (_scene.shape == ReferenceScene::Shape::Plane)
        {
            const osg::Vec3d p = start - ray * (start.z() / ray.z());
            if (ray.z() >= 0.0 || std::abs(p.x()) > 2.0 || std::abs(p.y()) > 2.0)
                return {};
            return SurfacePoint{osg::Vec3d(p.x(), p.y(), 0.0), osg::Vec3d(0, 0, 1)};
        }
        const double b = start * ray, c = start * start - 1.0;
        if (b * b < c)
            return {};
        const osg::Vec3d p = start + ray * (-b - std::sqrt(b * b - c));
        return SurfacePoint{p, unit(p)};
    }

    osg::Vec3d shade(const SurfacePoint& point) const
    {
        const osg::Vec3d toEye =
            _scene.localViewer ? unit(_eye - point.position) : unit(_backwards);
        osg::Vec3d ambient = rgb(_scene.sceneAmbient), diffuse, specular, toLight;
        for (const PreparedLight& light : _lights)
        {
            const double strength = light.attenuationAt(point.position, toLight);
            ambient += light.ambient * strength;
            const double cosine = point.normal * toLight;
            if (cosine <= 0.0)
                continue;
            diffuse += light.diffuse * (strength * cosine);
            const double half = std::max(point.normal * unit(toLight + toEye), 0.0);
            specular += light.specular * (strength * std::pow(half, double(_scene.shininess)));
        }
        osg::Vec3d color = rgb(_scene.emission) + product(ambient, rgb(_scene.ambient)) +
                           product(diffuse, rgb(_scene.diffuse)) +
                           product(specular, rgb(_scene.specular));
        for (unsigned int c = 0; c < 3; ++c)
            color[c] = std::clamp(color[c], 0.0, 1.0);
        return color;
    }

    const ReferenceScene& _scene;
    int _width, _height;
    osg::Vec3d _background;
    osg::Matrixd _toWorld;
    osg::Vec3d _eye, _backwards;
    std::vector<PreparedLight> _lights;
};

bool isUndecided(const Renderer& renderer, double x, double y, const osg::Vec3d& color, double move)
{
    for (double side : {-move, move})
    {
        for (const osg::Vec3d& other :
             {renderer.colorAt(x + side, y), renderer.colorAt(x, y + side)})
        {
            for (unsigned int c = 0; c < 3; ++c)
            {
                if (std::abs(other[c] - color[c]) > 1.0 / 255.0)
                    return true;
            }
        }
    }
    return false;
}

osg::ref_ptr<osg::Geometry> planeGeometry()
{
    osg::ref_ptr<osg::Geometry> plane = osg::createTexturedQuadGeometry(
        osg::Vec3(-2, -2, 0), osg::Vec3(4, 0, 0), osg::Vec3(0, 4, 0));
    plane->setColorArray(nullptr);
    return plane;
}

osg::ref_ptr<osg::Geometry> sphereGeometry()
{
    const unsigned int columns = 512, rows = 256;
    osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> quads = new osg::DrawElementsUInt(GL_QUADS);
    for (unsigned int row = 0; row <= rows; ++row)
    {
        for (unsigned int column = 0; column <= columns; ++column)
        {
            const double u = 2.0 * osg::PI * column / columns, v = osg::PI * row / rows;
            points->push_back(
                osg::Vec3(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), -std::cos(v)));
            if (row == rows || column == columns)
                continue;
            const unsigned int corner = row * (columns + 1) + column;
            for (unsigned int k : {corner, corner + 1, corner + columns + 2, corner + columns + 1})
                quads->push_back(k);
        }
    }
    osg::ref_ptr<osg::Geometry> sphere = new osg::Geometry;
    sphere->setVertexArray(points);
    sphere->setNormalArray(new osg::Vec3Array(*points), osg::Array::BIND_PER_VERTEX);
    sphere->addPrimitiveSet(quads);
    return sphere;
}

} // namespace

osg::ref_ptr<osg::Group> ReferenceScene::createNode() const
{
    osg::ref_ptr<osg::Group> root = new osg::Group;
    static const osg::ref_ptr<osg::Geometry> plane = planeGeometry(), sphere = sphereGeometry();
    root->addChild(shape == Shape::Plane ? plane : sphere);
    osg::StateSet* state = root->getOrCreateStateSet();
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, ambient);
    material->setDiffuse(osg::Material::FRONT_AND_BACK, diffuse);
    material->setSpecular(osg::Material::FRONT_AND_BACK, specular);
    material->setEmission(osg::Material::FRONT_AND_BACK, emission);
    material->setShininess(osg::Material::FRONT_AND_BACK, shininess);
    state->setAttributeAndModes(material);
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(sceneAmbient);
    model->setLocalViewer(localViewer);
    state->setAttributeAndModes(model);
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    for (const auto& light : lights)
    {
        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        source->setLight(light);
        root->addChild(source);
    }
    return root;
}

double ReferencePicture::getUndecidedShare() const
{
    return double(std::count(undecided.begin(), undecided.end(), true)) / undecided.size();
}

ReferencePicture renderReference(const ReferenceScene& scene, int width, int height,
                                 const osg::Vec4& background, double move)
{
    const Renderer renderer(scene, width, height, background);
    ReferencePicture picture;
    picture.image = new osg::Image;
    picture.image->allocateImage(width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE, 1);
    std::vector<char> undecided(width * height, 0); // bits of vector<bool> are not for threads
    std::atomic<int> nextRow{0};
    const auto work = [&]
    {
        for (int y = nextRow++; y < height; y = nextRow++)
        {
            for (int x = 0; x < width; ++x)
            {
                const osg::Vec3d color = renderer.colorAt(x + 0.5, y + 0.5);
                unsigned char* pixel = picture.image->data(x, y);
                for (unsigned int c = 0; c < 3; ++c)
                    pixel[c] = std::lround(255.0 * color[c]);
                pixel[3] = 255;
                undecided[y * width + x] =
                    move > 0.0 && isUndecided(renderer, x + 0.5, y + 0.5, color, move);
            }
        }
    };
    std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
    for (std::thread& thread : threads)
        thread = std::thread(work);
    for (std::thread& thread : threads)
        thread.join();
    picture.undecided.assign(undecided.begin(), undecided.end());
    return picture;
}
