// SPDX-License-Identifier: MIT
#pragma once

#include <osg/StateSet>

/// What walls show: windows, one a unit of the texture coordinates.
osg::ref_ptr<osg::StateSet> makeFacadeState();

/// Leaves on quads, by an alpha test; a unit of the texture coordinates is one crown. Without
/// mipmaps, so that what passes the test depends on the place alone.
osg::ref_ptr<osg::StateSet> makeLeafState();
