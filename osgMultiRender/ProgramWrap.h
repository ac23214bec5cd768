// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>
#include <osgMultiRender/GlslWrap.h>

#include <osg/Program>
#include <osg/State>

#include <cstdint>
#include <string>

namespace osgMultiRender
{

/// A number for the content of a Program: its shaders' texts, bindings and parameters. Programs
/// with equal content share a wrapper; 0 is never returned.
OSGMULTIRENDER_EXPORT std::uint64_t contentOf(const osg::Program& program);

/// A Program that draws as `program` does but whose fragment stage is a surface function that our
/// own main calls. Uniform names stay; attribute, fragment data and block bindings, geometry
/// parameters and transform feedback are copied. `snippet` comes after the colour is written.
/// Returns null and fills `error` where that can't be done. `isOurs`: see GlslWrap.h.
OSGMULTIRENDER_EXPORT osg::ref_ptr<osg::Program> wrapProgram(const osg::Program& program,
                                                             const GlslSnippet& snippet,
                                                             std::string& error,
                                                             bool isOurs = false);

/// Why a program did not compile or link in a context, one line an error: "file.frag:12: message".
/// Call after it was applied, with the context current.
OSGMULTIRENDER_EXPORT std::string errorsOf(const osg::Program& program, osg::State& state);

} // namespace osgMultiRender
