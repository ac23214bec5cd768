// SPDX-License-Identifier: MIT
#include <osgShadowVolume/FalseColors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>

namespace osgShadowVolume
{

namespace
{

constexpr int Steps = 32; ///< Between table entries colours are interpolated.

/// CIE 15: CIELAB with the white of D65 to linear sRGB (IEC 61966-2-1), then its transfer curve.
glm::dvec3 fromLab(double lightness, double a, double b)
{
    const auto inverse = [](double t)
    {
        const double d = 6.0 / 29.0;
        return t > d ? t * t * t : 3.0 * d * d * (t - 4.0 / 29.0);
    };
    const double y = (lightness + 16.0) / 116.0;
    const glm::dvec3 xyz(0.95047 * inverse(y + a / 500.0), inverse(y),
                         1.08883 * inverse(y - b / 200.0));
    const glm::dvec3 linear(glm::dot(glm::dvec3(3.2406, -1.5372, -0.4986), xyz),
                            glm::dot(glm::dvec3(-0.9689, 1.8758, 0.0415), xyz),
                            glm::dot(glm::dvec3(0.0557, -0.2040, 1.0570), xyz));
    glm::dvec3 color;
    for (int i = 0; i < 3; ++i)
    {
        const double c = std::clamp(linear[i], 0.0, 1.0);
        color[i] = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    }
    return color;
}

glm::dvec3 entry(double t)
{
    const double lightness = 14.0 + 78.0 * t;
    const double hue = glm::radians(315.0 - 215.0 * t);
    // As colourful as sRGB has it along this way; it has least between blue and green.
    const double low = std::max(0.0, 1.0 - t / 0.4), high = std::max(0.0, (t - 0.4) / 0.6);
    const double chroma = 27.0 + 25.0 * low * low + 55.0 * std::pow(high, 1.5);
    return fromLab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

const std::array<glm::vec3, Steps + 1>& table()
{
    static const auto colors = []
    {
        std::array<glm::vec3, Steps + 1> made;
        for (int i = 0; i <= Steps; ++i)
            made[std::size_t(i)] = entry(double(i) / Steps);
        return made;
    }();
    return colors;
}

} // namespace

glm::vec3 falseColor(double value)
{
    // A NaN is compared false and becomes 0.
    const double at = value > 0.0 ? std::min(value, 1.0) * Steps : 0.0;
    const int below = std::min(int(at), Steps - 1);
    return glm::mix(table()[std::size_t(below)], table()[std::size_t(below) + 1],
                    float(at - below));
}

std::string falseColorSource()
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(6);
    text << std::fixed << "const vec3 osgsv_falseColors[" << Steps + 1 << "] = vec3[](";
    for (int i = 0; i <= Steps; ++i)
    {
        const glm::vec3& c = table()[std::size_t(i)];
        text << (i ? ",\n    vec3(" : "\n    vec3(") << c.x << ", " << c.y << ", " << c.z << ")";
    }
    text << ");\n\nvec3 osgsv_falseColor(float value)\n{\n"
         << "    float at = (value > 0.0 ? min(value, 1.0) : 0.0) * " << Steps << ".0;\n"
         << "    int below = min(int(at), " << Steps - 1 << ");\n"
         << "    return mix(osgsv_falseColors[below], osgsv_falseColors[below + 1], "
            "at - float(below));\n}\n";
    return text.str();
}

double roundUp(double value)
{
    if (!(value > 0.0) || !std::isfinite(value))
        return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (value <= digit * power * (1.0 + 1e-12))
            return digit * power;
    return 10.0 * power;
}

} // namespace osgShadowVolume
