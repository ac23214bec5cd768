// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Rendering.h>

#include <vector>

/// Small programs that each show one case that is hard to merge.
///
/// They use names that the partner uses, too, for other things.
const std::vector<osgMultiRender::Rendering>& mergeCases();

/// What cases are merged with.
const osgMultiRender::Rendering& mergePartner();

/// One program of two texts; an empty vertex text is that of the cases: varyings `n`, `uv`, `eye`,
/// gl_FrontColor, gl_TexCoord[0].
osgMultiRender::Rendering mergeCase(const char* name, const std::string& fragment,
                                    const std::string& vertex = "");

std::vector<osgMultiRender::Rendering> outputCases();    ///< Colours, depth, discard, return.
std::vector<osgMultiRender::Rendering> nameCases();      ///< Names, scopes, functions, structs.
std::vector<osgMultiRender::Rendering> macroCases();     ///< Preprocessor, comments, line ends.
std::vector<osgMultiRender::Rendering> interfaceCases(); ///< Varyings, uniforms, attributes.
std::vector<osgMultiRender::Rendering> versionCases();   ///< GLSL 1.10 to 4.50, and ES.
