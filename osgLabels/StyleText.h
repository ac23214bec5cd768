// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelSettings.h>

#include <osgMultiRender/Option.h>

#include <string>
#include <vector>

namespace osgLabels
{

/// Takes "#rrggbb" or "#rrggbbaa"; false for any other text.
bool parseColor(const std::string& text, osg::Vec4& color);
/// The text that parseColor() would take for a colour, to 8 bits a channel.
std::string formatColor(const osg::Vec4& color);

/// What a style has, as text: ink, plate, outline, in this order.
const std::vector<osgMultiRender::Option<LabelStyle>>& styleOptions();

/// Sets all styles but the first by "hot:ink=#ff0000;cold:ink=#0000ff,plate=off"; "none" for none.
/// What is not said of a style is as in LabelStyle. Returns "", or why the text is wrong, and then
/// sets nothing.
std::string parseStyles(LabelSettings& settings, const std::string& text);

/// The text that parseStyles() would take for them.
std::string formatStyles(const LabelSettings& settings);

} // namespace osgLabels
