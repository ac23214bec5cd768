// SPDX-License-Identifier: MIT
#include "Town.h"

#include "TownPictures.h"

#include <osg/Geode>
#include <osg/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace
{

constexpr double Pitch = 80.0, Street = 16.0, Block = Pitch - Street;

/// A parallelogram that is seen from where `right` x `up` points; the picture is upright on it.
osg::ref_ptr<osg::Geometry> panel(const osg::Vec3& corner, const osg::Vec3& right,
                                  const osg::Vec3& up, float timesRight, float timesUp)
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const osg::Vec2& at : {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)})
    {
        vertices->push_back(corner + right * at.x() + up * at.y());
        places->push_back(osg::Vec2(at.x() * timesRight, at.y() * timesUp));
    }
    osg::Vec3 normal = right ^ up;
    normal.normalize();
    geometry->setVertexArray(vertices);
    geometry->setTexCoordArray(0, places);
    geometry->setNormalArray(new osg::Vec3Array(1, &normal), osg::Array::BIND_OVERALL);
    const osg::Vec4 white(1, 1, 1, 1);
    geometry->setColorArray(new osg::Vec4Array(1, &white), osg::Array::BIND_OVERALL);
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (unsigned short index : {0, 1, 2, 0, 2, 3})
        triangles->push_back(index);
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

class TownBuilder
{
public:
    explicit TownBuilder(const TownSettings& settings)
        : _random(settings.seed ^ 0x9e3779b9u),
          _pictures(settings.textures, settings.seed, settings.folder)
    {
    }

    /// Blocks in square rings around the middle, until all pictures are given out.
    Town build()
    {
        Town town;
        town.scene = new osg::Group;
        town.scene->setName("Town");
        // The photographs have their light in them.
        town.scene->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        int ring = 0;
        for (; !_pictures.isExhausted(); ++ring)
            for (int row = -ring; row <= ring; ++row)
                for (int column = -ring; column <= ring; ++column)
                    if (std::max(std::abs(row), std::abs(column)) == ring)
                        town.scene->addChild(block(column, row));
        town.pictures = _pictures.getPictures();
        town.halfSide = (ring - 0.5) * Pitch;
        return town;
    }

private:
    osg::ref_ptr<osg::Group> block(int column, int row)
    {
        osg::ref_ptr<osg::Group> group = new osg::Group;
        group->setName("Block " + std::to_string(column) + " " + std::to_string(row));
        const osg::Vec3 corner(column * Pitch - 0.5 * Block, row * Pitch - 0.5 * Block, 0.0);
        ground(*group, corner);
        if ((column * 3 + row * 5) % 7 == 3)
            park(*group, corner);
        else
            for (int lot = 0; lot < 4; ++lot)
                building(*group, corner + osg::Vec3(lot % 2, lot / 2, 0) * (0.5 * Block));
        return group;
    }

    void add(osg::Group& group, const char* name, osg::Geometry* geometry, osg::StateSet* state)
    {
        geometry->setStateSet(state);
        osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->setName(name);
        geode->addDrawable(geometry);
        group.addChild(geode);
    }

    /// The square, a street each on its east and north, and their crossing.
    void ground(osg::Group& group, const osg::Vec3& corner)
    {
        const osg::Vec3 x(1, 0, 0), y(0, 1, 0);
        const auto flat = [&](const char* name, PictureUse use, const osg::Vec3& at, double width,
                              double height, float repeats)
        {
            add(group, name, panel(at, x * width, y * height, 1.0f, repeats),
                _pictures.take(use, width, height / repeats, repeats > 1.0f));
        };
        flat("Square", PictureUse::Ground, corner, Block, Block, 1.0f);
        const float times = _random(0, 1) < 0.3 ? 4.0f : 1.0f;
        flat("Street", PictureUse::Street, corner + x * Block, Street, Block, times);
        // Seen along the street, as the other one: its picture runs from east to west.
        add(group, "Street",
            panel(corner + x * Block + y * Block, y * Street, x * -Block, 1, times),
            _pictures.take(PictureUse::Street, Street, Block / times, times > 1.0f));
        flat("Crossing", PictureUse::Ground, corner + (x + y) * Block, Street, Street, 1.0f);
    }

    void building(osg::Group& group, const osg::Vec3& lot)
    {
        const double side = 0.5 * Block;
        const osg::Vec3 low = lot + osg::Vec3(_random(2.5, 6.0), _random(2.5, 6.0), 0.0);
        const osg::Vec3 high =
            lot + osg::Vec3(side - _random(2.5, 6.0), side - _random(2.5, 6.0), 0.0);
        const bool tower = _random(0, 1) < 0.12;
        const double height = 3.3 * std::floor(tower ? _random(14, 24) : _random(3, 9)) + 1.0;
        osg::ref_ptr<osg::Group> house = new osg::Group;
        house->setName("Building " + std::to_string(_buildings++));
        const osg::Vec3 corners[] = {low, {high.x(), low.y(), 0}, high, {low.x(), high.y(), 0}};
        for (int i = 0; i < 4; ++i)
            facade(*house, corners[i], corners[(i + 1) % 4] - corners[i], height);
        const osg::Vec3 size = high - low;
        add(*house, "Roof",
            panel(low + osg::Vec3(0, 0, height), {size.x(), 0, 0}, {0, size.y(), 0}, 1, 1),
            _pictures.take(PictureUse::Roof, size.x(), size.y(), false));
        group.addChild(house);
    }

    void facade(osg::Group& house, const osg::Vec3& from, const osg::Vec3& along, double height)
    {
        const bool repeats = _random(0, 1) < 0.2;
        const float across = repeats ? 2.0f : 1.0f, up = repeats && height > 20.0 ? 2.0f : 1.0f;
        add(house, "Facade", panel(from, along, osg::Vec3(0, 0, height), across, up),
            _pictures.take(PictureUse::Facade, along.length() / across, height / up, repeats));
    }

    void park(osg::Group& group, const osg::Vec3& corner)
    {
        const float in = 3.0f, side = Block - 2.0f * in;
        const osg::Vec3 low = corner + osg::Vec3(in, in, 0),
                        along[] = {{side, 0, 0}, {0, side, 0}, {-side, 0, 0}, {0, -side, 0}};
        osg::Vec3 at = low;
        for (const osg::Vec3& edge : along)
        {
            add(group, "Fence", panel(at, edge, {0, 0, 2}, side / 4.0f, 1), _pictures.takeFence());
            at += edge;
        }
        for (int i = 0; i < 16; ++i)
            tree(group, low + osg::Vec3(_random(4, side - 4), _random(4, side - 4), 0.0),
                 _random(5, 11));
    }

    void tree(osg::Group& group, const osg::Vec3& at, double height)
    {
        osg::StateSet* const state = _pictures.takeTree();
        const double turn = _random(0.0, osg::PI);
        for (const double angle : {turn, turn + osg::PI_2})
        {
            const osg::Vec3 half(0.5 * height * std::cos(angle), 0.5 * height * std::sin(angle), 0);
            add(group, "Tree", panel(at - half, half * 2, osg::Vec3(0, 0, height), 1, 1), state);
        }
    }

    CityRandom _random;
    TownPictures _pictures;
    unsigned int _buildings = 0;
};

} // namespace

Town makeTown(const TownSettings& settings)
{
    return TownBuilder(settings).build();
}
