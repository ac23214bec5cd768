// SPDX-License-Identifier: MIT
#include "PlotStyle.h"
#include "ProcessUnit.h"

#include <osg/Math>

#include <cmath>

using namespace plot;
using osg::Vec3d;

void ProcessUnit::towers(double y)
{
    const int count = 3 + _parts.choice(3);
    for (int i = 0; i < count; ++i)
    {
        const double x = 6.0 + 60.0 * (i + _parts.random(0.2, 0.8)) / count;
        const double radius = _parts.random(0.7, 2.2);
        tower(x, y + _parts.random(0.0, 2.0), radius, radius * _parts.random(11.0, 20.0) + 6.0);
    }
}

void ProcessUnit::tower(double x, double y, double radius, double height)
{
    const std::string tag = _tags.equipment("C");
    const double neck = _parts.random(0.45, 0.65) * height;
    const double upper = radius * _parts.random(0.65, 0.9);
    _parts.color = Concrete;
    _parts.cylinder(at(x, y, 0.0), at(x, y, 0.5), 1.5 * radius, tag + "-FDN");
    _parts.color = Steel;
    _parts.snout(at(x, y, 0.5), at(x, y, 3.5), 1.25 * radius, radius, tag + "-SKT");
    _parts.color = Insulation;
    _parts.cylinder(at(x, y, 3.5), at(x, y, neck), radius, tag);
    _parts.snout(at(x, y, neck), at(x, y, neck + 1.5), radius, upper, tag + "-CON");
    _parts.cylinder(at(x, y, neck + 1.5), at(x, y, height), upper, tag + "-TOP");
    _parts.dish(at(x, y, height), {0.0, 0.0, 1.0}, upper, 0.5 * upper, tag + "-HD");
    for (double z = 7.0; z < height; z += _parts.random(5.0, 8.0))
    {
        const double r = (z > neck ? upper : radius) + 1.0;
        _parts.color = Steel;
        _parts.cylinder(at(x, y, z), at(x, y, z + 0.08), r, _tags.steel('P'));
        _parts.color = Yellow;
        _parts.ring(at(x, y, z + 0.55), {0.0, 0.0, 1.0}, r - 0.04, 0.03, _tags.steel('R'));
        _parts.ring(at(x, y, z + 1.1), {0.0, 0.0, 1.0}, r - 0.04, 0.03, _tags.steel('R'));
        for (int i = 0; i < 8; ++i)
        {
            const Vec3d post((r - 0.04) * std::cos(0.25 * i * osg::PI),
                             (r - 0.04) * std::sin(0.25 * i * osg::PI), 0.0);
            _parts.cylinder(at(x, y, z + 0.08) + post, at(x, y, z + 1.1) + post, 0.025,
                            _tags.steel('R'));
        }
    }
    const double pipe = _parts.random(0.1, 0.3), out = y - radius - 1.6;
    _parts.color = Services[_parts.choice(NumServices)].color;
    _parts.route({at(x, y, height + 0.4 * upper), at(x, y, height + 2.0), at(x, out, height + 2.0),
                  at(x, out, 7.6), at(x, RackHigh - 0.6, 7.6)},
                 pipe, _tags.line(pipe, "HC"));
    _parts.color = Yellow;
    for (double side : {-0.25, 0.25})
        _parts.bar(at(x + radius + 0.4, y + side, 0.5), at(x + radius + 0.4, y + side, height),
                   0.07, _tags.steel('L'));
}

void ProcessUnit::drums(double y)
{
    const int count = 4 + _parts.choice(2);
    for (int i = 0; i < count; ++i)
    {
        const double radius = _parts.random(0.7, 1.6);
        drum(5.0 + 62.0 * (i + 0.5) / count, y, radius, _parts.random(4.0, 7.5));
    }
}

void ProcessUnit::drum(double x, double y, double radius, double length)
{
    const std::string tag = _tags.equipment("V");
    const double z = radius + 1.2, half = 0.5 * length;
    _parts.color = White;
    _parts.cylinder(at(x - half, y, z), at(x + half, y, z), radius, tag);
    _parts.dish(at(x + half, y, z), {1.0, 0.0, 0.0}, radius, 0.5 * radius, tag + "-HE");
    _parts.dish(at(x - half, y, z), {-1.0, 0.0, 0.0}, radius, 0.5 * radius, tag + "-HW");
    _parts.color = Concrete;
    for (double side : {-0.3, 0.3})
        _parts.box(at(x + side * length - 0.25, y - 0.85 * radius, 0.0),
                   at(x + side * length + 0.25, y + 0.85 * radius, z - 0.5 * radius),
                   tag + (side < 0.0 ? "-SW" : "-SE"));
    _parts.color = Galvanized;
    for (int i = 0; i < 3; ++i)
    {
        const double nx = x + (i - 1) * 0.3 * length;
        const std::string nozzle = tag + "-N" + std::to_string(i + 1);
        _parts.cylinder(at(nx, y, z + 0.9 * radius), at(nx, y, z + radius + 0.4), 0.12, nozzle);
        _parts.cylinder(at(nx, y, z + radius + 0.4), at(nx, y, z + radius + 0.48), 0.2,
                        nozzle + "-FL");
    }
    const double pipe = _parts.random(0.06, 0.16);
    _parts.color = Services[_parts.choice(NumServices)].color;
    _parts.route({at(x, y, z + radius + 0.48), at(x, y, 6.2), at(x, RackLow + 0.8, 6.2)}, pipe,
                 _tags.line(pipe, "HC"));
}

void ProcessUnit::exchangers(double y)
{
    const int count = 6 + _parts.choice(3);
    for (int i = 0; i < count; ++i)
    {
        const double x = 5.0 + 62.0 * (i + 0.5) / count;
        exchanger(x, y, 1.1);
        if (_parts.choice(2))
            exchanger(x, y, 2.7);
    }
}

void ProcessUnit::exchanger(double x, double y, double z)
{
    const std::string tag = _tags.equipment("E", z < 2.0 ? 'A' : 'B');
    const double radius = 0.5;
    _parts.color = Blue;
    _parts.cylinder(at(x, y - 2.2, z), at(x, y + 1.8, z), radius, tag);
    _parts.cylinder(at(x, y + 1.8, z), at(x, y + 1.95, z), 1.25 * radius, tag + "-FL");
    _parts.cylinder(at(x, y + 1.95, z), at(x, y + 2.8, z), radius, tag + "-CH");
    _parts.dish(at(x, y - 2.2, z), {0.0, -1.0, 0.0}, radius, 0.5 * radius, tag + "-HD");
    _parts.color = Concrete;
    for (double side : {-1.4, 1.2})
        _parts.box(at(x - 0.4, y + side - 0.15, z - 1.1), at(x + 0.4, y + side + 0.15, z - 0.35),
                   tag + (side < 0.0 ? "-S1" : "-S2"));
}

void ProcessUnit::pumps(double y)
{
    const int count = 5 + _parts.choice(3);
    for (int i = 0; i < count; ++i)
    {
        const double x = 4.0 + 64.0 * (i + 0.3) / count;
        pump(x, y, 'A');
        pump(x + 3.0, y, 'B');
    }
}

void ProcessUnit::pump(double x, double y, char suffix)
{
    const std::string tag = _tags.equipment("P", suffix);
    _parts.color = Concrete;
    _parts.box(at(x - 0.45, y - 1.1, 0.0), at(x + 0.45, y + 1.1, 0.3), tag + "-FDN");
    _parts.color = Green;
    _parts.cylinder(at(x, y - 1.0, 0.75), at(x, y + 0.05, 0.75), 0.32, tag + "-M");
    _parts.dish(at(x, y - 1.0, 0.75), {0.0, -1.0, 0.0}, 0.32, 0.14, tag + "-MC");
    _parts.cylinder(at(x, y + 0.05, 0.75), at(x, y + 0.4, 0.75), 0.07, tag + "-CPL");
    _parts.color = Blue;
    _parts.cylinder(at(x, y + 0.4, 0.75), at(x, y + 0.7, 0.75), 0.4, tag);
    _parts.box(at(x - 0.2, y + 0.35, 0.3), at(x + 0.2, y + 0.75, 0.5), tag + "-FT");
    _parts.snout(at(x, y + 0.7, 0.75), at(x, y + 0.95, 0.75), 0.24, 0.12, tag + "-RED");
    const double radius = _parts.random(0.06, 0.12);
    const Service& service = Services[_parts.choice(NumServices)];
    const double z = LevelHeights[0] - 0.6, rackY = y < 24.0 ? RackLow : RackHigh;
    _parts.color = service.color;
    const std::string line = _tags.line(radius, service.code);
    _parts.route({at(x, y + 0.55, 1.1), at(x, y + 0.55, z), at(x, rackY, z)}, radius, line);
    valve(at(x, y + 0.55, 1.9), radius);
}

void ProcessUnit::valve(const Vec3d& center, double radius)
{
    const std::string tag = _tags.equipment("HV");
    _parts.color = Red;
    _parts.sphere(center, 1.8 * radius, tag);
    _parts.cylinder(center, center + Vec3d(-5.0 * radius, 0.0, 0.0), 0.3 * radius, tag + "-SP");
    _parts.ring(center + Vec3d(-5.0 * radius, 0.0, 0.0), {1.0, 0.0, 0.0}, 2.0 * radius,
                0.25 * radius, tag + "-HW");
}

void ProcessUnit::tankFarm()
{
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 3; ++i)
        {
            const double radius = _parts.random(5.5, 7.5);
            tank(13.0 + 23.0 * i, side ? 38.0 : 10.0, radius, _parts.random(8.0, 13.0));
        }
}

void ProcessUnit::tank(double x, double y, double radius, double height)
{
    const std::string tag = _tags.equipment("TK");
    _parts.color = Concrete;
    for (double side : {-1.0, 1.0})
    {
        const double wallX = x + side * 10.8, wallY = y + side * 9.3;
        _parts.box(at(wallX - 0.2, y - 9.3), at(wallX + 0.2, y + 9.3, 1.2),
                   tag + (side < 0.0 ? "-DW" : "-DE"));
        _parts.box(at(x - 10.8, wallY - 0.2), at(x + 10.8, wallY + 0.2, 1.2),
                   tag + (side < 0.0 ? "-DS" : "-DN"));
    }
    _parts.color = White;
    _parts.cylinder(at(x, y, 0.0), at(x, y, height), radius, tag);
    _parts.snout(at(x, y, height), at(x, y, height + 0.18 * radius), radius, 0.3, tag + "-RF");
    _parts.color = Galvanized;
    _parts.cylinder(at(x, y, height + 0.15 * radius), at(x, y, height + 0.15 * radius + 0.7), 0.25,
                    tag + "-VT");
    _parts.ring(at(x, y, height), {0.0, 0.0, 1.0}, radius, 0.12, tag + "-WG");
    _parts.color = Yellow;
    const int steps = int(height / 0.35);
    for (int i = 0; i < steps; ++i)
    {
        const double angle = 0.45 * i / radius, z = 0.35 * i;
        const Vec3d out(std::cos(angle), std::sin(angle), 0.0);
        _parts.bar(at(x, y, z) + out * radius, at(x, y, z) + out * (radius + 0.9), 0.12,
                   _tags.steel('T'));
    }
    const double pipe = _parts.random(0.12, 0.25), rackY = y < 24.0 ? RackLow : RackHigh;
    const double from = y < 24.0 ? y + radius : y - radius;
    _parts.color = Services[0].color;
    _parts.route({at(x + 1.0, from, 0.6), at(x + 1.0, rackY, 0.6), at(x + 1.0, rackY, 4.4)}, pipe,
                 _tags.line(pipe, "HC"));
}

void ProcessUnit::spheres(double y)
{
    for (double x : {10.0, 25.0, 40.0})
        storageSphere(x, y, _parts.random(3.0, 4.2));
}

void ProcessUnit::storageSphere(double x, double y, double radius)
{
    const std::string tag = _tags.equipment("S");
    const double z = radius + 2.0;
    _parts.color = White;
    _parts.sphere(at(x, y, z), radius, tag);
    _parts.color = Steel;
    const auto leg = [&](int i)
    { return Vec3d(std::cos(0.25 * i * osg::PI), std::sin(0.25 * i * osg::PI), 0.0) * radius; };
    for (int i = 0; i < 8; ++i)
    {
        _parts.cylinder(at(x, y, 0.0) + leg(i), at(x, y, z) + leg(i), 0.2,
                        tag + "-L" + std::to_string(i + 1));
        _parts.bar(at(x, y, 0.4) + leg(i), at(x, y, z - 0.8) + leg(i + 1), 0.08, _tags.steel('X'));
    }
    _parts.color = Yellow;
    _parts.ring(at(x, y, z + 0.94 * radius), {0.0, 0.0, 1.0}, 0.5 * radius, 0.04, _tags.steel('R'));
}
