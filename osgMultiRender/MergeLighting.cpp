// SPDX-License-Identifier: MIT
// Lights and materials that a rendering's description holds, as constants of the merged program.
#include <osgMultiRender/MergeProgram.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace osgMultiRender
{

namespace
{

constexpr std::size_t Lights = 8; ///< gl_MaxLights of a rendering's own.
constexpr double Degree = 3.14159265358979323846 / 180.0;

/// "type(a, b, …)" of numbers or texts.
class Constructor
{
public:
    explicit Constructor(const std::string& type) : _text(type + "(") {}

    Constructor& add(const std::string& text)
    {
        _text += (_text.back() == '(' ? "" : ", ") + text;
        return *this;
    }
    Constructor& add(float number)
    {
        std::ostringstream text;
        text.imbue(std::locale::classic());
        text.precision(9); // all of a float
        // Products of what a file says may be beyond all numbers.
        text << std::showpoint << (std::isfinite(number) ? number : 0.0f);
        return add(text.str());
    }
    template <std::size_t N> Constructor& add(const std::array<float, N>& vector)
    {
        Constructor part("vec" + std::to_string(N));
        for (const float component : vector)
        {
            part.add(component);
        }
        return add(part.text());
    }
    std::string text() const { return _text + ")"; }

private:
    std::string _text;
};

RenderingColor product(const RenderingColor& a, const RenderingColor& b)
{
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]};
}

/// Between the direction of the light and that of an eye at infinity, as GL has it.
RenderingColor halfVector(const RenderingColor& position)
{
    const double length = std::hypot(position[0], position[1], position[2]);
    double half[3] = {0.0, 0.0, 1.0};
    for (std::size_t i = 0; i < 3 && length > 0.0; ++i)
    {
        half[i] += position[i] / length;
    }
    const double size = std::hypot(half[0], half[1], half[2]);
    RenderingColor result = {0.0f, 0.0f, 0.0f, 1.0f};
    for (std::size_t i = 0; i < 3 && size > 1e-6; ++i)
    {
        result[i] = static_cast<float>(half[i] / size);
    }
    return result;
}

/// The light of a number; one that the description does not hold is OpenGL's default.
RenderingLight lightOf(const RenderingState& state, std::size_t number)
{
    const auto found =
        std::find_if(state.lights.begin(), state.lights.end(),
                     [&](const RenderingLight& light) { return light.number == number; });
    if (found != state.lights.end())
    {
        return *found;
    }
    RenderingLight light;
    if (number > 0)
    {
        light.diffuse = light.specular = {0.0f, 0.0f, 0.0f, 1.0f};
    }
    return light;
}

std::string textOf(const RenderingLight& light)
{
    const double cosine = std::cos(light.spotCutoff * Degree);
    Constructor text("gl_LightSourceParameters");
    text.add(light.ambient).add(light.diffuse).add(light.specular).add(light.position);
    text.add(halfVector(light.position)).add(light.spotDirection).add(light.spotExponent);
    text.add(light.spotCutoff).add(static_cast<float>(cosine));
    return text.add(light.attenuation[0])
        .add(light.attenuation[1])
        .add(light.attenuation[2])
        .text();
}

std::string textOf(const RenderingMaterial& material)
{
    Constructor text("gl_MaterialParameters");
    text.add(material.emission).add(material.ambient).add(material.diffuse);
    return text.add(material.specular).add(material.shininess).text();
}

std::string textOf(const RenderingMaterial& material, const RenderingLight& light)
{
    Constructor text("gl_LightProducts");
    text.add(product(material.ambient, light.ambient));
    text.add(product(material.diffuse, light.diffuse));
    return text.add(product(material.specular, light.specular)).text();
}

std::string sceneColor(const RenderingMaterial& material, const RenderingColor& ambient)
{
    RenderingColor color = product(material.ambient, ambient);
    for (std::size_t i = 0; i < 3; ++i)
    {
        color[i] += material.emission[i];
    }
    color[3] = material.diffuse[3];
    return Constructor("gl_LightModelProducts").add(color).text();
}

template <class TextOf>
std::string constantArray(const std::string& type, const std::string& name, TextOf textOfLight)
{
    const std::string arrayType = type + "[" + std::to_string(Lights) + "]";
    Constructor all(arrayType);
    for (std::size_t i = 0; i < Lights; ++i)
    {
        all.add(textOfLight(i));
    }
    return "const " + arrayType + " " + name + " = " + all.text() + ";\n";
}

} // namespace

std::string lightingConstant(const RenderingState& state, const std::string& builtin,
                             const std::string& name)
{
    const bool isFront = builtin.compare(0, 8, "gl_Front") == 0;
    const RenderingMaterial& material = isFront ? state.front : state.back;
    const auto constant = [&](const std::string& type, const std::string& value)
    { return "const " + type + " " + name + " = " + value + ";\n"; };
    if (builtin == "gl_LightSource")
    {
        return constantArray("gl_LightSourceParameters", name,
                             [&](std::size_t i) { return textOf(lightOf(state, i)); });
    }
    if (builtin == "gl_FrontLightProduct" || builtin == "gl_BackLightProduct")
    {
        return constantArray("gl_LightProducts", name,
                             [&](std::size_t i) { return textOf(material, lightOf(state, i)); });
    }
    if (builtin == "gl_FrontMaterial" || builtin == "gl_BackMaterial")
    {
        return constant("gl_MaterialParameters", textOf(material));
    }
    if (builtin == "gl_LightModel")
    {
        return constant("gl_LightModelParameters",
                        Constructor("gl_LightModelParameters").add(state.modelAmbient).text());
    }
    if (builtin == "gl_FrontLightModelProduct" || builtin == "gl_BackLightModelProduct")
    {
        return constant("gl_LightModelProducts", sceneColor(material, state.modelAmbient));
    }
    return "";
}

} // namespace osgMultiRender
