// SPDX-License-Identifier: MIT
#pragma once

#include "Refinery.h"

#include <osg/Group>

/// How objects of makeDrawables() say their names.
enum class DrawableLabels
{
    None,
    Text,   ///< An osgText::Text an object, before its front.
    Texture ///< A texture an object, with its name on it.
};

/// Takes objects and makes an ordinary Geometry of each, in a Geode with the object's name.
class Drawables
{
public:
    explicit Drawables(DrawableLabels labels);

    void add(const osgLabels::Primitive& primitive);
    osg::Group* get() { return _root.get(); }

private:
    osg::ref_ptr<osg::Group> _root;
    DrawableLabels _labels;
};
