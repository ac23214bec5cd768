// SPDX-License-Identifier: MIT
#include "Plant.h"

#include "PlantMeshes.h"

#include <osg/Geode>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

namespace
{

constexpr double BayLength = 6.0; ///< Along a rack, metres.
constexpr double RowWidth = 10.0; ///< From rack to rack: 4 m of rack, 6 m of tanks.
constexpr unsigned int PerBay = 20;

osg::Matrixd place(const osg::Vec3d& scale, const osg::Vec3d& at)
{
    return osg::Matrixd::scale(scale) * osg::Matrixd::translate(at);
}

/// A cylinder of length 1 along z becomes one of this radius and length along x.
osg::Matrixd alongX(double radius, double length, const osg::Vec3d& at)
{
    return osg::Matrixd::scale(radius, radius, length) *
           osg::Matrixd::rotate(osg::Vec3d(0, 0, 1), osg::Vec3d(1, 0, 0)) *
           osg::Matrixd::translate(at);
}

osg::ref_ptr<osg::Geode> geodeOf(std::initializer_list<osg::ref_ptr<osg::Geometry>> meshes,
                                 const char* material, const osg::Vec3& color)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    for (const auto& mesh : meshes)
        geode->addDrawable(mesh);
    osg::ref_ptr<osg::Material> look = new osg::Material;
    look->setName(material);
    look->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(color, 1.0f));
    look->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(color, 1.0f));
    look->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0.3f, 0.3f, 0.3f, 1.0f));
    look->setShininess(osg::Material::FRONT_AND_BACK, 40.0f);
    geode->getOrCreateStateSet()->setAttribute(look);
    return geode;
}

class PlantMaker
{
public:
    explicit PlantMaker(const PlantSettings& settings)
        : _settings(settings), _engine(settings.seed), _root(new osg::Group)
    {
        const unsigned int bays = (settings.objects + PerBay - 1) / PerBay;
        // A bay is longer across than along: so the plant comes out about square.
        _rows = std::max(1, int(std::lround(std::sqrt(bays * BayLength / RowWidth))));
        _bays = std::max(1, int(bays + _rows - 1) / _rows);
        _root->setName("Plant");
    }

    osg::ref_ptr<osg::Group> make()
    {
        addFloor();
        for (int row = 0; row < _rows; ++row)
            for (int bay = 0; bay < _bays; ++bay)
                addBay(osg::Vec3d((bay - 0.5 * _bays) * BayLength, (row - 0.5 * _rows) * RowWidth,
                                  0.0));
        if (_settings.lights)
            addLights();
        return _root;
    }

private:
    double random(double low, double high)
    {
        return low + (high - low) * (double(_engine()) / double(_engine.max()));
    }

    void add(const char* kind, osg::Node& shape, const osg::Matrixd& matrix)
    {
        if (_count == _settings.objects)
            return;
        char name[32];
        std::snprintf(name, sizeof name, "%s %04u", kind, ++_count);
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
        transform->setName(name);
        transform->setDataVariance(osg::Object::STATIC);
        transform->addChild(&shape);
        _root->addChild(transform);
    }

    void addFloor();
    void addBay(const osg::Vec3d& corner);
    void addRack(const osg::Vec3d& corner);
    void addPipes(const osg::Vec3d& corner);
    void addTanks(const osg::Vec3d& corner);
    void addLights();
    void addLight(int number, const osg::Vec4& position, const osg::Vec3& color, float cutoff);

    PlantSettings _settings;
    std::mt19937 _engine;
    osg::ref_ptr<osg::Group> _root;
    int _rows = 0, _bays = 0; ///< Bays in a row.
    unsigned int _count = 0;
    osg::ref_ptr<osg::Geode> _beam = geodeOf({plant::makeBox()}, "Steel", {0.75f, 0.35f, 0.2f});
    osg::ref_ptr<osg::Geode> _pipe =
        geodeOf({plant::makeCylinder(20)}, "Galvanized", {0.6f, 0.65f, 0.7f});
    osg::ref_ptr<osg::Geode> _elbow =
        geodeOf({plant::makeElbow(16, 0.35f)}, "Galvanized", {0.6f, 0.65f, 0.7f});
    osg::ref_ptr<osg::Geode> _valve =
        geodeOf({plant::makeWheel(12, 0.15f)}, "Valve red", {0.85f, 0.1f, 0.1f});
    osg::ref_ptr<osg::Geode> _tank =
        geodeOf({plant::makeVessel(32, 0.4f)}, "Tank white", {0.9f, 0.9f, 0.85f});
    osg::ref_ptr<osg::Geode> _ladder =
        geodeOf({plant::makeLadder(12)}, "Ladder yellow", {0.9f, 0.75f, 0.1f});
};

void PlantMaker::addFloor()
{
    osg::ref_ptr<osg::Geode> floor = geodeOf({plant::makeBox()}, "Concrete", {0.6f, 0.6f, 0.58f});
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(
        place({_bays * BayLength + 8.0, _rows * RowWidth + 8.0, 0.5}, {0.0, 0.0, -0.25}));
    transform->setName("Floor");
    transform->addChild(floor);
    _root->addChild(transform);
}

void PlantMaker::addBay(const osg::Vec3d& corner)
{
    addRack(corner);
    addPipes(corner);
    addTanks(corner);
}

/// 5 objects: two columns, two cross beams, one along the rack.
void PlantMaker::addRack(const osg::Vec3d& corner)
{
    for (double y : {0.5, 3.5})
        add("Beam", *_beam, place({0.3, 0.25, 6.0}, corner + osg::Vec3d(0.5, y, 3.0)));
    for (double z : {3.5, 5.5})
        add("Beam", *_beam, place({0.2, 3.4, 0.3}, corner + osg::Vec3d(0.5, 2.0, z)));
    add("Beam", *_beam, place({BayLength, 0.2, 0.25}, corner + osg::Vec3d(3.5, 0.5, 5.9)));
}

/// 10 objects: six pipes, two of them with a valve, one with an elbow and a riser.
void PlantMaker::addPipes(const osg::Vec3d& corner)
{
    for (int i = 0; i < 6; ++i)
    {
        const double radius = random(0.08, 0.24);
        const osg::Vec3d start =
            corner + osg::Vec3d(0.0, 0.9 + 0.85 * (i % 3), (i < 3 ? 3.65 : 5.65) + radius);
        add("Pipe", *_pipe, alongX(radius, BayLength, start));
        if (i % 3 == 1)
            add("Valve", *_valve,
                place({0.3, 0.3, 0.3}, start + osg::Vec3d(random(1.0, 5.0), 0.0, radius + 0.2)));
    }
    const double radius = random(0.1, 0.2), x = random(1.5, 4.5);
    add("Elbow", *_elbow,
        osg::Matrixd::scale(radius / 0.35, radius / 0.35, radius / 0.35) *
            osg::Matrixd::rotate(0.5 * osg::PI, osg::Vec3d(0, 1, 0)) *
            osg::Matrixd::translate(corner + osg::Vec3d(x, 3.6, 3.2)));
    add("Pipe", *_pipe,
        place({radius, radius, 3.2}, corner + osg::Vec3d(x, 3.6 + radius / 0.35, 0.0)));
}

/// 5 objects: two tanks, a ladder, a pump's base and its casing.
void PlantMaker::addTanks(const osg::Vec3d& corner)
{
    for (int i = 0; i < 2; ++i)
    {
        const double radius = random(0.7, 1.3), height = random(1.5, 4.5);
        const osg::Vec3d at = corner + osg::Vec3d(1.5 + 3.0 * i, 6.8, 0.0);
        add("Tank", *_tank, place({radius, radius, height}, at));
        if (i == 0)
            add("Ladder", *_ladder,
                place({0.5, 1.0, height}, at - osg::Vec3d(0.0, radius + 0.08, 0.0)));
    }
    const osg::Vec3d pump = corner + osg::Vec3d(random(1.0, 5.0), 4.8, 0.0);
    add("Beam", *_beam, place({0.8, 0.5, 0.2}, pump + osg::Vec3d(0.0, 0.0, 0.1)));
    add("Pipe", *_pipe, alongX(0.2, 0.7, pump + osg::Vec3d(-0.35, 0.0, 0.4)));
}

void PlantMaker::addLight(int number, const osg::Vec4& position, const osg::Vec3& color,
                          float cutoff)
{
    osg::ref_ptr<osg::Light> light = new osg::Light(number);
    light->setName("Light " + std::to_string(number));
    light->setPosition(position);
    light->setAmbient(osg::Vec4(0.03f, 0.03f, 0.03f, 1.0f));
    light->setDiffuse(osg::Vec4(color, 1.0f));
    light->setSpecular(osg::Vec4(color, 1.0f));
    light->setSpotCutoff(cutoff);
    light->setSpotExponent(cutoff < 90.0f ? 2.0f : 0.0f);
    light->setDirection(osg::Vec3(0.1f, 0.2f, -1.0f));
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setName(light->getName());
    source->setLight(light);
    _root->addChild(source);
    _root->getOrCreateStateSet()->setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
}

/// A low sun, and lamps over the lanes between the racks.
void PlantMaker::addLights()
{
    addLight(0, osg::Vec4(-0.55f, -0.4f, 0.73f, 0.0f), {0.45f, 0.43f, 0.38f}, 180.0f);
    const double width = _bays * BayLength, depth = _rows * RowWidth;
    for (int i = 0; i < 7; ++i)
    {
        const double x = width * ((i + 0.5) / 7.0 - 0.5) + random(-1.0, 1.0);
        const int row = i * 3 % std::max(_rows, 1);
        const double y = (row + 0.5) * RowWidth - 0.5 * depth + random(-1.0, 1.0);
        const bool spot = i % 2 == 1;
        addLight(i + 1, osg::Vec4(float(x), float(y), spot ? 11.0f : 7.5f, 1.0f),
                 spot ? osg::Vec3(0.2f, 0.25f, 0.3f) : osg::Vec3(0.22f, 0.18f, 0.12f),
                 spot ? 50.0f : 180.0f);
    }
}

} // namespace

osg::ref_ptr<osg::Group> makePlant(const PlantSettings& settings)
{
    return PlantMaker(settings).make();
}
