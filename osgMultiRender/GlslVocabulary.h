// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace osgMultiRender
{

/// The first GLSL version (110 … 460) in which `word` is a keyword or reserved; 0 if it is in none.
int reservedSince(std::string_view word);

/// The first GLSL version that has a built-in function of this name; 0 if none has.
int builtinFunctionSince(std::string_view word);

/// True for storage, interpolation, precision, memory and auxiliary qualifiers; not for "layout".
bool isQualifier(std::string_view word);

/// True for the names of built-in types.
bool isBuiltinType(std::string_view word);

} // namespace osgMultiRender
