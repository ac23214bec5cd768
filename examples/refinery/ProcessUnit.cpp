// SPDX-License-Identifier: MIT
#include "ProcessUnit.h"

#include "PlotStyle.h"

using namespace plot;
using osg::Vec3d;

ProcessUnit::ProcessUnit(Parts& parts, Tags& tags, const Vec3d& corner)
    : _parts(parts), _tags(tags), _corner(corner)
{
}

Vec3d ProcessUnit::at(double x, double y, double z) const
{
    return _corner + Vec3d(x, y, z);
}

void ProcessUnit::make(unsigned int number)
{
    _parts.color = Paving;
    _parts.ground(at(0.5 * Length, 0.5 * Depth), 0.5 * Length - 1.0, 0.5 * Depth - 1.0);
    rack();
    if (number % 7 == 4)
        return tankFarm();
    pumps(18.0);
    towers(33.0);
    drums(12.0);
    if (number % 3 == 0)
        spheres(41.5);
    else
        structure(8.0 + _parts.random(0.0, 20.0), 38.0, 2 + _parts.choice(3));
    exchangers(5.0);
    silo(62.0, 39.0);
    pumps(30.0);
}

void ProcessUnit::rack()
{
    rackSteel();
    rackPipes();
}

void ProcessUnit::rackSteel()
{
    const int bays = int(Length / BayLength);
    for (int i = 0; i < bays; ++i)
    {
        const double x = BayLength * i + 0.5 * BayLength;
        _parts.color = Steel;
        for (double y : {RackLow, RackHigh})
        {
            _parts.bar(at(x, y, 0.0), at(x, y, 7.2), 0.32, _tags.steel('C'));
            for (double z : LevelHeights)
                _parts.bar(at(x, y, z - 0.5), at(x + BayLength, y, z - 0.5), 0.2, _tags.steel('B'));
        }
        for (double z : LevelHeights)
            _parts.bar(at(x, RackLow, z - 0.17), at(x, RackHigh, z - 0.17), 0.3, _tags.steel('B'));
        if (i % 3 == 1)
            for (double y : {RackLow, RackHigh})
                _parts.bar(at(x, y, 0.2), at(x + BayLength, y, 4.0), 0.14, _tags.steel('X'));
        _parts.color = Concrete;
        for (double y : {RackLow, RackHigh})
            _parts.box(at(x - 0.4, y - 0.4, 0.0), at(x + 0.4, y + 0.4, 0.3), _tags.steel('F'));
    }
}

/// Lines that run through, in spools of two bays, with flanges; some leave the rack.
void ProcessUnit::rackPipes()
{
    for (double z : LevelHeights)
    {
        double y = RackLow + 0.5;
        while (y < RackHigh - 0.3)
        {
            const double radius = 0.0254 * (1 + _parts.choice(6) * _parts.choice(3)) + 0.025;
            const Service& service = Services[_parts.choice(NumServices)];
            const std::string line = _tags.line(radius, service.code);
            y += radius;
            int spool = 0;
            for (double x = 0.0; x < Length; x += 2.0 * BayLength)
            {
                _parts.color = service.color;
                _parts.cylinder(at(x, y, z + radius), at(x + 2.0 * BayLength, y, z + radius),
                                radius, line + "-" + char('A' + spool++));
                _parts.color = Galvanized;
                if (_parts.choice(4) == 0)
                    _parts.cylinder(at(x - 0.06, y, z + radius), at(x + 0.06, y, z + radius),
                                    1.6 * radius, line + "-F" + std::to_string(spool));
            }
            if (_parts.choice(3) == 0)
            {
                const double x = _parts.random(4.0, Length - 4.0);
                const double side = _parts.choice(2) ? 30.0 : 18.0;
                _parts.color = service.color;
                const double top = z + 2.0 * radius + 0.7;
                _parts.route({at(x, y, z + radius), at(x, y, top), at(x, side, top),
                              at(x, side, 0.8), at(x, side + (side > 24.0 ? 2.0 : -2.0), 0.8)},
                             0.7 * radius, _tags.line(0.7 * radius, service.code));
            }
            y += radius + _parts.random(0.12, 0.35);
        }
    }
}

void ProcessUnit::structure(double x, double y, int floors)
{
    const double span = 5.0, storey = 4.5;
    for (int floor = 0; floor < floors; ++floor)
    {
        const double z = storey * floor, top = z + storey;
        _parts.color = Steel;
        for (int i = 0; i < 6; ++i)
        {
            const double cx = x + span * (i % 3), cy = y + span * (i / 3);
            _parts.bar(at(cx, cy, z), at(cx, cy, top), 0.3, _tags.steel('C'));
            if (i % 3 < 2)
                _parts.bar(at(cx, cy, top - 0.2), at(cx + span, cy, top - 0.2), 0.24,
                           _tags.steel('B'));
            if (i < 3)
                _parts.bar(at(cx, cy, top - 0.2), at(cx, cy + span, top - 0.2), 0.24,
                           _tags.steel('B'));
        }
        _parts.bar(at(x, y, z), at(x + span, y, top), 0.12, _tags.steel('X'));
        _parts.bar(at(x + 2.0 * span, y, z), at(x + span, y, top), 0.12, _tags.steel('X'));
        _parts.box(at(x - 0.4, y - 0.4, top - 0.08), at(x + 2.0 * span + 0.4, y + span + 0.4, top),
                   _tags.steel('P'));
        _parts.color = Yellow;
        for (double rail : {0.55, 1.1})
            for (double side : {y - 0.35, y + span + 0.35})
                _parts.cylinder(at(x - 0.35, side, top + rail),
                                at(x + 2.0 * span + 0.35, side, top + rail), 0.025,
                                _tags.steel('R'));
        for (int i = 0; i <= 8; ++i)
            for (double side : {y - 0.35, y + span + 0.35})
                _parts.cylinder(at(x - 0.35 + i * (2.0 * span + 0.7) / 8.0, side, top),
                                at(x - 0.35 + i * (2.0 * span + 0.7) / 8.0, side, top + 1.1), 0.025,
                                _tags.steel('R'));
        const std::string tag = _tags.equipment("V");
        const double radius = _parts.random(0.6, 1.1);
        const double cx = x + span + _parts.random(-2.0, 2.0), cy = y + 0.5 * span;
        _parts.color = White;
        _parts.cylinder(at(cx, cy, top + 0.6), at(cx, cy, top + 2.8), radius, tag);
        _parts.dish(at(cx, cy, top + 2.8), {0.0, 0.0, 1.0}, radius, 0.4 * radius, tag + "-HT");
        _parts.dish(at(cx, cy, top + 0.6), {0.0, 0.0, -1.0}, radius, 0.4 * radius, tag + "-HB");
    }
}

void ProcessUnit::silo(double x, double y)
{
    const std::string tag = _tags.equipment("H");
    const double half = 1.8;
    _parts.color = Rust;
    _parts.hopper(at(x, y, 5.0), half, 3.2, tag);
    _parts.box(at(x - half, y - half, 5.0), at(x + half, y + half, 9.0), tag + "-BIN");
    _parts.color = Steel;
    for (int i = 0; i < 4; ++i)
    {
        const double cx = x + (i % 2 ? half : -half), cy = y + (i / 2 ? half : -half);
        _parts.bar(at(cx, cy, 0.0), at(cx, cy, 5.2), 0.25, _tags.steel('C'));
    }
    _parts.snout(at(x, y, 9.0), at(x, y, 10.2), 1.2, 0.3, tag + "-FIL");
}
