// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/Rendering.h>

#include <osg/Node>
#include <osg/Program>
#include <osg/StateSet>

#include <vector>

namespace osgMultiRender
{

/// The program of a model as a rendering, with the uniforms and defines of the StateSet that holds
/// it. Textures stay the model's.
OSGMULTIRENDER_EXPORT Rendering importProgram(const osg::Program& program,
                                              const osg::StateSet* stateSet = nullptr);

/// All programs of a loaded model, each once, in the order of a traversal.
OSGMULTIRENDER_EXPORT std::vector<Rendering> importPrograms(osg::Node& node);

} // namespace osgMultiRender
