// SPDX-License-Identifier: MIT
#pragma once

#include "Parts.h"
#include "Tags.h"

/// One plot of the refinery, 72 m along x and 48 m along y, with its pipe rack along x.
class ProcessUnit
{
public:
    static constexpr double Length = 72.0, Depth = 48.0;

    /// `corner`: lowest x and y, on the ground.
    ProcessUnit(Parts& parts, Tags& tags, const osg::Vec3d& corner);

    /// Everything, of what is on plots with the number `number`.
    void make(unsigned int number);

private:
    osg::Vec3d at(double x, double y, double z = 0.0) const;

    void rack();
    void rackSteel();
    void rackPipes();
    void towers(double y);
    void tower(double x, double y, double radius, double height);
    void drums(double y);
    void drum(double x, double y, double radius, double length);
    void exchangers(double y);
    void exchanger(double x, double y, double z);
    void pumps(double y);
    void pump(double x, double y, char suffix);
    void valve(const osg::Vec3d& center, double radius);
    void structure(double x, double y, int floors);
    void silo(double x, double y);
    void tankFarm();
    void tank(double x, double y, double radius, double height);
    void spheres(double y);
    void storageSphere(double x, double y, double radius);

    Parts& _parts;
    Tags& _tags;
    osg::Vec3d _corner;
};
