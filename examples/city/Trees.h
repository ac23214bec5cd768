// SPDX-License-Identifier: MIT
#pragma once

#include "CityRandom.h"

#include <osg/Group>
#include <osg/MatrixTransform>

#include <vector>

/// The kinds of trees, shared by all of them.
class Trees
{
public:
    Trees();

    /// One that stands at `place`, of a random kind, size and turn; some are mirrored.
    osg::ref_ptr<osg::MatrixTransform> plant(const osg::Vec3d& place, CityRandom& random) const;

private:
    std::vector<osg::ref_ptr<osg::Node>> _kinds; ///< 1 m wide and high, on z = 0.
};
