// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace osgMultiRender
{

/// An integer that may be unknown.
struct GlslValue
{
    bool known = false;
    long long value = 0;
};

/// Evaluates an integer expression of numbers and operators, in linear time and without recursion.
///
/// Any other word is an unknown value; "0 && unknown" is 0 and "1 || unknown" is 1. Malformed
/// expressions, divisions by zero and overlong shifts are unknown.
GlslValue evaluate(const std::vector<std::string_view>& words);

} // namespace osgMultiRender
