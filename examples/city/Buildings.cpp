// SPDX-License-Identifier: MIT
#include "Buildings.h"

#include <array>

using osg::Vec3;

namespace
{

constexpr float Storey = 3.0f;

Vec3 pick(const std::vector<Vec3>& colors, CityRandom& random)
{
    return colors[random.choice(static_cast<unsigned int>(colors.size()))];
}

Vec3 plaster(CityRandom& random)
{
    return pick({{0.86f, 0.8f, 0.68f},
                 {0.78f, 0.62f, 0.5f},
                 {0.7f, 0.44f, 0.36f},
                 {0.82f, 0.82f, 0.8f},
                 {0.76f, 0.72f, 0.58f},
                 {0.66f, 0.68f, 0.66f}},
                random);
}

Vec3 tiles(CityRandom& random)
{
    return pick({{0.62f, 0.3f, 0.22f}, {0.55f, 0.27f, 0.2f}, {0.4f, 0.36f, 0.34f}}, random);
}

const Vec3 Felt(0.5f, 0.5f, 0.49f), Concrete(0.64f, 0.64f, 0.62f);

/// From 0 to 1, random.
float share(CityRandom& random)
{
    return float(random(0.0, 1.0));
}

void makeHouse(SolidMesh& mesh, float x, float y, CityRandom& random)
{
    const float eaves = Storey * float(1 + random.choice(2)) + 1.0f;
    const float ridge = eaves + 0.7f * y;
    const Vec3 walls = plaster(random);
    mesh.gabled({-x, -y, 0.0f}, {x, y, eaves}, ridge, walls, tiles(random));
    const float at = (share(random) - 0.5f) * x;
    mesh.box({at - 0.4f, 0.2f * y, eaves}, {at + 0.4f, 0.2f * y + 0.8f, ridge + 0.6f}, walls, Felt,
             false);
}

/// A flat one over three columns and rows of cells.
void makeFlat(SolidMesh& mesh, Building kind, float x, float y, CityRandom& random)
{
    const float left = -x + x * (0.55f + 0.2f * share(random)),
                right = x - x * (0.55f + 0.2f * share(random)),
                front = -y + y * (0.55f + 0.2f * share(random)),
                back = y - y * (0.55f + 0.2f * share(random));
    // From the smallest y to the largest.
    const std::vector<bool> cells =
        kind == Building::L       ? std::vector<bool>{1, 1, 1, 1, 0, 0, 1, 0, 0}
        : kind == Building::U     ? std::vector<bool>{1, 0, 1, 1, 0, 1, 1, 1, 1}
        : kind == Building::Court ? std::vector<bool>{1, 1, 1, 1, 0, 1, 1, 1, 1}
                                  : std::vector<bool>(9, true);
    const float height = Storey * float(3 + random.choice(5)) + 1.0f;
    const Vec3 walls = plaster(random);
    mesh.prism({-x, left, right, x}, {-y, front, back, y}, cells, 0.0f, height, walls, Felt);
    // The lift's house stands in the first column, which all of them have.
    const float side = 0.3f * (left + x);
    mesh.box({-x + side, y - 3.0f * side, height - 0.2f},
             {-x + 2.0f * side, y - side, height + 2.6f}, Concrete, Felt, false);
}

void makeTower(SolidMesh& mesh, float x, float y, CityRandom& random)
{
    const Vec3 walls =
        pick({{0.62f, 0.7f, 0.76f}, {0.8f, 0.78f, 0.72f}, {0.56f, 0.6f, 0.62f}}, random);
    const int parts = 1 + int(random.choice(3));
    float low = 0.0f;
    for (int part = 0; part < parts; ++part)
    {
        const float high = low + Storey * float(7 + random.choice(8));
        // A part begins within the one below it, so that no two faces lie in one plane.
        mesh.box({-x, -y, part ? low - 0.5f : 0.0f}, {x, y, high}, walls, Felt, true);
        low = high;
        x *= 0.78f;
        y *= 0.78f;
    }
    mesh.box({-0.4f * x, -0.4f * y, low - 0.2f}, {0.3f * x, 0.3f * y, low + 3.0f}, Concrete, Felt,
             false);
}

/// Wings around a court, and a clock tower with a spire over the front.
void makeTownHall(SolidMesh& mesh, float x, float y)
{
    const Vec3 stone(0.84f, 0.76f, 0.6f), copper(0.38f, 0.6f, 0.52f);
    mesh.prism({-x, -0.55f * x, 0.55f * x, x}, {-y, -0.5f * y, 0.5f * y, y},
               {1, 1, 1, 1, 0, 1, 1, 1, 1}, 0.0f, 17.0f, stone, Felt);
    const float side = 0.2f * x, front = -y - 0.8f, back = front + 2.0f * side;
    mesh.box({-side, front, 0.0f}, {side, back, 34.0f}, stone, Felt, true);
    const Vec3 a(-side, front, 33.8f), b(side, front, 33.8f), c(side, back, 33.8f),
        d(-side, back, 33.8f), top(0.0f, 0.5f * (front + back), 48.0f);
    for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, d}, {d, a}})
        mesh.face({from, to, top}, copper);
    mesh.face({a, d, c, b}, copper);
}

} // namespace

SolidMesh makeBuilding(Building kind, const osg::Vec2d& size, CityRandom& random)
{
    SolidMesh mesh;
    const float x = 0.5f * float(size.x()), y = 0.5f * float(size.y());
    switch (kind)
    {
    case Building::House:
    case Building::Terrace:
        makeHouse(mesh, x, y, random);
        break;
    case Building::Tower:
        makeTower(mesh, x, y, random);
        break;
    case Building::TownHall:
        makeTownHall(mesh, x, y);
        break;
    default:
        makeFlat(mesh, kind, x, y, random);
    }
    return mesh;
}
