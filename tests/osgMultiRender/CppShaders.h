// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Rendering.h>

#include <string>
#include <vector>

/// A shader that a C++ source holds as string literals.
struct CppShader
{
    osgMultiRender::GlslStage stage = osgMultiRender::GlslStage::Fragment;
    std::string text;
};

/// The shaders in the text of a C++ source: adjacent literals are one text, raw ones too; those
/// that define main() are shaders, and what built-ins they use tells the stage. Compute shaders,
/// which are of no rendering, are left out.
std::vector<CppShader> shadersOfCpp(const std::string& text);
