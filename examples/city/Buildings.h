// SPDX-License-Identifier: MIT
#pragma once

#include "CityRandom.h"
#include "SolidMesh.h"

#include <osg/Vec2d>

enum class Building
{
    House,   ///< With a gable and a chimney.
    Terrace, ///< As a house, as wide as its lot: it shares walls with its neighbours.
    Box,
    L,
    U,
    Court, ///< Around a courtyard.
    Tower, ///< With setbacks.
    TownHall
};

/// Closed, standing on z = 0 around the origin, as large as `size` at most, metres.
SolidMesh makeBuilding(Building kind, const osg::Vec2d& size, CityRandom& random);
