// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/BuiltInRenderings.h>

#include <osg/Image>
#include <osg/Node>
#include <osg/StateSet>

#include <string>

/// The program of a rendering with its uniforms as their comments have them.
osg::ref_ptr<osg::StateSet> makeRenderingState(const osgMultiRender::BuiltInRendering& rendering);

/// Sphere, box and a wavy sheet with normals and texture coordinates, a lit material and `image` on
/// unit 0; about 6 units wide around the origin.
osg::ref_ptr<osg::Node> makeSampleModel(osg::Image& image);

/// A quad of 2 x 2 in x and y that shows `image`.
osg::ref_ptr<osg::Node> makeImageQuad(osg::Image& image);

/// Smooth and sharp parts, all colours; RGBA8.
osg::ref_ptr<osg::Image> makeSampleImage(int size);
