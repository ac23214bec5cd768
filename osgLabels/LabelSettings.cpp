// SPDX-License-Identifier: MIT
#include <osgLabels/LabelSettings.h>

#include <algorithm>

namespace osgLabels
{

bool isStyleName(const std::string& name)
{
    // Not std::isalnum(), which depends on the locale.
    const auto isPart = [](char c)
    {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '_' || c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
    };
    return !name.empty() && std::all_of(name.begin(), name.end(), isPart);
}

std::optional<unsigned int> LabelSettings::findStyle(const std::string& name) const
{
    if (name.empty() || name == LabelStyle::DefaultName)
        return 0u;
    const std::size_t end = std::min<std::size_t>(styles.size(), LabelStyle::MaxStyles);
    for (std::size_t i = 1; i < end; ++i)
        if (styles[i].name == name)
            return static_cast<unsigned int>(i);
    return std::nullopt;
}

} // namespace osgLabels
