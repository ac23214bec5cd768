// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace osgKitsOiio
{

/// Why the bytes of a file must not reach OpenImageIO 2.4, whose readers of DPX, ICO, IFF and SGI
/// end the process over some damaged sizes and offsets; empty where they may. Other formats pass.
std::string findDamage(const std::string& format, const std::string& bytes);

/// Whether findDamage() has anything to say on a format: reading its files whole is then worth it.
bool isCheckedForDamage(const std::string& format);

/// The PNG file within an ICO file, of its first picture; empty where that is a plain bitmap.
/// OpenImageIO's own reader of these crashes when the PNG is damaged.
std::string extractPng(const std::string& icoBytes);

} // namespace osgKitsOiio
