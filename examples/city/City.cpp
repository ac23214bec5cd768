// SPDX-License-Identifier: MIT
#include "City.h"

#include "Buildings.h"
#include "CityNames.h"
#include "Facades.h"
#include "Ground.h"
#include "Trees.h"

#include <osg/Geode>
#include <osg/LightModel>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

using osg::Vec2d;

namespace
{

constexpr double BlockX = 104.0, BlockY = 74.0; ///< Metres from street to street.
constexpr double Street = 12.0;
constexpr int BlocksAPark = 9;

/// Between four streets; the one with the Town Hall is 0, 0.
struct Block
{
    int x, y;

    Vec2d middle() const { return {x * BlockX, y * BlockY}; }
    double distance() const { return middle().length(); }
};

/// Where a building may stand.
struct Lot
{
    Vec2d middle, size;
    Building kind;
};

osg::ref_ptr<osg::Group> groupOf(const char* name, const char* labelClass)
{
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->setName(name);
    group->setUserValue("labelClass", std::string(labelClass));
    return group;
}

class CityMaker
{
public:
    explicit CityMaker(const CitySettings& settings) : _settings(settings), _random(settings.seed)
    {
        chooseBlocks();
        double radius = 0.0;
        for (const Block& block : _blocks)
            radius = std::max(radius, block.distance());
        _radius = radius + 0.5 * std::hypot(BlockX, BlockY);
        _ground = std::make_unique<Ground>(_radius);
    }

    City make()
    {
        _city.scene = new osg::MatrixTransform(
            osg::Matrixd::translate(_settings.origin, _settings.origin, 0.0));
        _city.scene->setName("City");
        // Daylight from all sides, so that roofs are not black under a headlight.
        const osg::ref_ptr<osg::LightModel> daylight = new osg::LightModel;
        daylight->setAmbientIntensity(osg::Vec4(0.5f, 0.5f, 0.53f, 1.0f));
        _city.scene->getOrCreateStateSet()->setAttribute(daylight);
        addGround();
        addBuildings();
        addTrees();
        std::stable_sort(_city.labels.begin(), _city.labels.end(),
                         [](const auto& a, const auto& b) { return a.priority > b.priority; });
        return std::move(_city);
    }

private:
    /// Those nearest to the middle that hold all buildings.
    void chooseBlocks()
    {
        // Blocks have 6 lots or more, but for parks.
        const int reach = 2 + int(std::sqrt(_settings.buildings / 4.0));
        std::vector<Block> blocks;
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                blocks.push_back({x, y});
        std::stable_sort(blocks.begin(), blocks.end(),
                         [](const Block& a, const Block& b)
                         { return a.distance() < b.distance(); });
        for (const Block& block : blocks)
        {
            if (_lots.size() >= _settings.buildings)
                break;
            _blocks.push_back(block);
            if (_blocks.size() % BlocksAPark == 3)
                _parks.push_back(block);
            else
                addLots(block);
        }
        _lots.resize(std::min<std::size_t>(_lots.size(), _settings.buildings));
    }

    Building kindAt(double distance)
    {
        const double town = 40.0 * std::sqrt(_settings.buildings / 2.0) + 1.0;
        const double share = distance / town + _random(-0.12, 0.12);
        const unsigned int choice = _random.choice(10);
        if (share < 0.32)
            return choice < 3 ? Building::Tower : choice < 7 ? Building::Court : Building::U;
        if (share < 0.68)
            return choice < 3   ? Building::Court
                   : choice < 6 ? Building::L
                   : choice < 8 ? Building::U
                                : Building::Box;
        return choice < 6 ? Building::House : choice < 8 ? Building::L : Building::Terrace;
    }

    void addLots(const Block& block)
    {
        const Vec2d size(BlockX - Street, BlockY - Street);
        if (_lots.empty())
            _lots.push_back({block.middle(), {0.5 * size.x(), 0.7 * size.y()}, Building::TownHall});
        else
        {
            const Building first = kindAt(block.distance());
            const bool isSmall = first == Building::House || first == Building::Terrace;
            const int columns = isSmall ? 4 : 3, rows = 2;
            const Vec2d lot(size.x() / columns, size.y() / rows);
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x)
                    _lots.push_back({block.middle() - size * 0.5 +
                                         Vec2d((x + 0.5) * lot.x(), (y + 0.5) * lot.y()),
                                     lot, isSmall ? first : kindAt(block.distance())});
        }
    }

    void addGround()
    {
        const osg::ref_ptr<osg::Group> ground = groupOf("Ground", "terrain");
        const osg::ref_ptr<osg::Geode> terrain = _ground->makeTerrain();
        terrain->setName("Terrain");
        ground->addChild(terrain);
        _city.scene->addChild(ground);

        const osg::ref_ptr<osg::Group> streets = groupOf("Streets", "street");
        for (int axis = 0; axis < 2; ++axis)
        {
            // Line i runs before block i; how far blocks beside it reach says how far it goes.
            std::map<int, std::pair<int, int>> lines;
            for (const Block& block : _blocks)
            {
                const int across = axis ? block.x : block.y, along = axis ? block.y : block.x;
                for (const int line : {across, across + 1})
                {
                    auto& [first, last] = lines.try_emplace(line, along, along).first->second;
                    first = std::min(first, along);
                    last = std::max(last, along);
                }
            }
            unsigned int index = 0;
            for (const auto& [line, blocks] : lines)
                addStreet(*streets, axis, index++, line, blocks);
        }
        _city.scene->addChild(streets);
    }

    void addStreet(osg::Group& streets, int axis, unsigned int index, int line,
                   const std::pair<int, int>& blocks)
    {
        const double length = axis ? BlockY : BlockX,
                     offset = (line - 0.5) * (axis ? BlockX : BlockY);
        const double from = (blocks.first - 0.5) * length - 0.5 * Street,
                     to = (blocks.second + 0.5) * length + 0.5 * Street;
        const osg::ref_ptr<osg::Geode> street =
            axis ? _ground->makeStreet({offset, from}, {offset, to}, Street)
                 : _ground->makeStreet({from, offset}, {to, offset}, Street);
        street->setName(streetName(axis, index));
        streets.addChild(street);
    }

    void addBuildings()
    {
        const osg::ref_ptr<osg::Group> buildings = groupOf("Buildings", "building");
        buildings->setStateSet(makeFacadeState());
        for (std::size_t i = 0; i < _lots.size(); ++i)
        {
            const Lot& lot = _lots[i];
            const double gap = lot.kind == Building::Terrace ? 0.0 : _random(2.0, 4.0);
            const double garden = lot.kind == Building::House || lot.kind == Building::Terrace
                                      ? lot.size.y() * _random(0.4, 0.55)
                                      : _random(2.0, 6.0);
            const Vec2d size(lot.size.x() - gap, lot.size.y() - garden);
            const SolidMesh mesh = makeBuilding(lot.kind, size, _random);
            const double base =
                _ground->lowestIn(lot.middle - size * 0.5, lot.middle + size * 0.5) - 0.6;
            // Some are mirrored, as instances in models are.
            const double mirror = _random.choice(3) ? 1.0 : -1.0;
            const osg::ref_ptr<osg::MatrixTransform> building = new osg::MatrixTransform(
                osg::Matrixd::scale(mirror, 1.0, 1.0) *
                osg::Matrixd::translate(lot.middle.x(), lot.middle.y(), base));
            building->setName(i ? "Building " + std::to_string(i) : "Town Hall");
            const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
            geode->addDrawable(mesh.make());
            building->addChild(geode);
            buildings->addChild(building);
            addLabel(static_cast<unsigned int>(i), *building, mesh.getBox());
        }
        _city.scene->addChild(buildings);
    }

    void addLabel(unsigned int index, const osg::MatrixTransform& building,
                  const osg::BoundingBox& box)
    {
        const osg::Vec3d top(box.center().x(), box.center().y(), box.zMax());
        osgLabels::MapLabel label;
        label.anchor = top * building.getMatrix() * _city.scene->getMatrix();
        const Vec2d& middle = _lots[index].middle;
        const std::string landmark = landmarkName(index);
        const auto number = 1 + 2 * static_cast<int>(std::abs(middle.x()) / 13.0);
        label.text = landmark.empty()
                         ? std::to_string(number) + " " +
                               streetName(0, unsigned(std::abs(std::lround(middle.y() / BlockY))))
                         : landmark;
        label.priority = landmark.empty() ? std::floor(box.zMax()) : 1000.0 - index;
        label.feature = building.getName();
        _city.labels.push_back(std::move(label));
    }

    void addTrees()
    {
        const osg::ref_ptr<osg::Group> group = groupOf("Trees", "tree");
        const Trees trees;
        for (unsigned int i = 0; i < _settings.trees; ++i)
        {
            const Vec2d at = i % 8 == 0 ? hill() : i % 3 == 0 && !_parks.empty() ? park() : kerb();
            const osg::Vec3d place(at.x(), at.y(), _ground->heightAt(at.x(), at.y()) - 0.15);
            const osg::ref_ptr<osg::MatrixTransform> tree = trees.plant(place, _random);
            tree->setName("tree-" + std::to_string(i));
            group->addChild(tree);
        }
        _city.scene->addChild(group);
    }

    Vec2d park()
    {
        const Block& block = _parks[_random.choice(static_cast<unsigned int>(_parks.size()))];
        return block.middle() + Vec2d(_random(-0.4, 0.4) * BlockX, _random(-0.36, 0.36) * BlockY);
    }

    /// Beside a street.
    Vec2d kerb()
    {
        if (_blocks.empty())
            return hill();
        const Block& block = _blocks[_random.choice(static_cast<unsigned int>(_blocks.size()))];
        const double side = (_random.choice(2) ? 1.0 : -1.0), along = _random(-0.42, 0.42);
        const Vec2d edge(0.5 * (BlockX - Street) + 0.6, 0.5 * (BlockY - Street) + 0.6);
        return block.middle() + (_random.choice(2) ? Vec2d(side * edge.x(), along * BlockY)
                                                   : Vec2d(along * BlockX, side * edge.y()));
    }

    Vec2d hill()
    {
        const double turn = _random(0.0, 2.0 * osg::PI),
                     distance = _random(_radius, _radius + 380.0);
        return Vec2d(std::cos(turn), std::sin(turn)) * distance;
    }

    CitySettings _settings;
    CityRandom _random;
    std::vector<Block> _blocks, _parks;
    std::vector<Lot> _lots;
    double _radius = 0.0;
    std::unique_ptr<Ground> _ground;
    City _city;
};

} // namespace

City makeCity(const CitySettings& settings)
{
    return CityMaker(settings).make();
}
