// SPDX-License-Identifier: MIT
#include "../city/CityRandom.h"
#include "Town.h"

#include <algorithm>

namespace
{

constexpr double MetresPerSecond = 15.0, Step = 0.5;

class Flight
{
public:
    /// Looks from `eye` to `center`, from now on for no time.
    void look(const osg::Vec3d& eye, const osg::Vec3d& center)
    {
        const osg::Matrixd camera =
            osg::Matrixd::inverse(osg::Matrixd::lookAt(eye, center, osg::Vec3d(0, 0, 1)));
        _path->insert(_time, osg::AnimationPath::ControlPoint(eye, camera.getRotate()));
    }

    /// A straight flight of `seconds` that looks from one direction to another.
    void fly(const osg::Vec3d& from, const osg::Vec3d& to, const osg::Vec3d& first,
             const osg::Vec3d& last, double seconds)
    {
        const int steps = std::max(1, int(seconds / Step));
        for (int i = 0; i <= steps; ++i)
        {
            const double share = double(i) / steps;
            const osg::Vec3d eye = from + (to - from) * share;
            look(eye, eye + first + (last - first) * share);
            _time += i < steps ? seconds / steps : 0.0;
        }
    }

    /// The next place is reached in a thousandth of a second.
    void jump() { _time += 0.001; }
    void pause(double seconds) { _time += seconds; }
    osg::ref_ptr<osg::AnimationPath> get() const { return _path; }

private:
    osg::ref_ptr<osg::AnimationPath> _path = new osg::AnimationPath;
    double _time = 0.0;
};

} // namespace

osg::ref_ptr<osg::AnimationPath> makeFlight(const Town& town, std::uint32_t seed)
{
    Flight flight;
    const osg::Vec3d north(0, 1, -0.05), west(-1, 0, -0.05), high(0, 0, 60);
    const double side = std::min(town.halfSide, 16.0 * MetresPerSecond);
    const osg::Vec3d start(40, -side - 40, 7), crossing(40, 40, 7), end(-side, 40, 7);
    flight.fly(start, crossing, north, north, (crossing - start).length() / MetresPerSecond);
    flight.fly(crossing, crossing + (north + west) * 2, north, west, 2.0);
    flight.fly(crossing + (north + west) * 2, end, west, west,
               (end - crossing).length() / MetresPerSecond);
    const osg::Vec3d down(1.0, -0.7, -0.5);
    flight.fly(end, end + high, west, down, 4.0);
    flight.fly(end + high, osg::Vec3d(0, 0, 70), down, down, 8.0);
    CityRandom random(seed);
    const unsigned int streets = std::max(1u, unsigned(town.halfSide / 40.0));
    for (int i = 0; i < 6; ++i)
    {
        flight.jump();
        const double x = -town.halfSide + 80.0 * random.choice(streets);
        const osg::Vec3d eye(x, random(-town.halfSide, town.halfSide), random(2.0, 30.0));
        const osg::Vec3d ahead = (i % 2 ? -north : north) + osg::Vec3d(random(-0.4, 0.4), 0, 0);
        flight.fly(eye, eye + ahead * 20.0, ahead, ahead, 3.0);
    }
    return flight.get();
}
