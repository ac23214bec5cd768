// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Group>
#include <osg/Matrixd>

#include <functional>
#include <set>
#include <string>
#include <vector>

/// A small scene that shows one feature of fixed-function state, the same each time it is made.
///
/// Seen by featureView(). Its picture under plain OSG differs from that of every other scene of
/// its family by more than 2/255 on more than 0.1 % of the pixels, so that a renderer that ignores
/// the feature is caught; by definition equal ones name their twin.
struct FeatureScene
{
    std::string family; ///< "light", "texEnv", …
    std::string name;   ///< What it shows, unique in its family.
    std::function<osg::ref_ptr<osg::Node>()> create;
    bool beyond = false; ///< A state that the surface functions leave to the fixed function.
    std::string twin;    ///< Name of the scene with, by OpenGL's equations, the same picture.
};

/// All of them, families together.
std::vector<FeatureScene> featureScenes();

/// The names of their families.
std::set<std::string> featureFamilies();

/// The camera of all feature scenes.
osg::Matrixd featureView();

/// Its projection for a picture of `aspect` = width / height.
osg::Matrixd featureProjection(double aspect);
