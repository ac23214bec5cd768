// SPDX-License-Identifier: MIT
#include <osgShadowVolume/Photometry.h>

#include <osg/NodeVisitor>
#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

namespace osgShadowVolume
{

namespace
{

/// Digits that tell two values apart where people write them.
std::string toText(double value, int digits = 15)
{
    char text[32];
    // In any locale.
    const auto end =
        std::to_chars(text, text + sizeof(text), value, std::chars_format::general, digits).ptr;
    return std::string(text, end);
}

/// Takes the text of a number out of a user value of any type.
class ValueText : public osg::ValueObject::GetValueVisitor
{
public:
    void apply(bool value) override { text = value ? "true" : "false"; }
    void apply(char value) override { text = toText(value); }
    void apply(unsigned char value) override { text = toText(value); }
    void apply(short value) override { text = toText(value); }
    void apply(unsigned short value) override { text = toText(value); }
    void apply(int value) override { text = toText(value); }
    void apply(unsigned int value) override { text = toText(value); }
    void apply(float value) override { text = toText(double(value), 7); }
    void apply(double value) override { text = toText(value); }
    void apply(const std::string& value) override { text = value; }

    std::string text = "a value of another type";
};

bool isWordCharacter(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// What follows "key=" in a text of several words, up to what can't be part of a number.
std::optional<std::string> findIn(const std::string& text, const std::string& key)
{
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
    {
        if (at > 0 && isWordCharacter(text[at - 1]))
            continue;
        std::size_t begin = at + key.size();
        while (begin < text.size() && text[begin] == ' ')
            ++begin;
        if (begin == text.size() || text[begin] != '=')
            continue;
        ++begin;
        while (begin < text.size() && text[begin] == ' ')
            ++begin;
        const std::size_t end =
            std::find_if(text.begin() + std::ptrdiff_t(begin), text.end(),
                         [](char c)
                         { return !isWordCharacter(c) && c != '.' && c != '-' && c != '+'; }) -
            text.begin();
        return text.substr(begin, end - begin);
    }
    return std::nullopt;
}

std::optional<std::string> userValue(const osg::Object& object, const std::string& key)
{
    const osg::UserDataContainer* data = object.getUserDataContainer();
    const osg::Object* found = data ? data->getUserObject(key) : nullptr;
    const auto* value = dynamic_cast<const osg::ValueObject*>(found);
    if (!value)
        return std::nullopt;
    ValueText text;
    value->get(text);
    return text.text;
}

std::optional<std::string> description(const osg::Object& object, const std::string& key)
{
    const osg::UserDataContainer* data = object.getUserDataContainer();
    for (unsigned int i = 0; data && i < data->getNumDescriptions(); ++i)
        if (auto found = findIn(data->getDescriptions()[i], key))
            return found;
    return std::nullopt;
}

/// What a light states under `key`; see intensityOf() for the places.
std::optional<std::string> findKey(const osg::LightSource& source, const std::string& key)
{
    const osg::Object* objects[] = {&source, source.getLight()};
    for (const osg::Object* object : objects)
        if (auto found = object ? userValue(*object, key) : std::nullopt)
            return found;
    for (const osg::Object* object : objects)
        if (auto found = object ? description(*object, key) : std::nullopt)
            return found;
    for (const osg::Object* object : objects)
        if (auto found = object ? findIn(object->getName(), key) : std::nullopt)
            return found;
    return std::nullopt;
}

/// The number in a text, which may be `least` or more.
Stated parse(const std::string& key, const std::string& text, double least)
{
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value);
    if (result.ec == std::errc() && result.ptr == end && std::isfinite(value) && value >= least)
        return {value, std::string()};
    return {-1.0, "its " + key + "=" + text + " is not a number of at least " + toText(least)};
}

constexpr char MetresKey[] = "metresPerUnit";
constexpr double LeastMetres = 1e-12;

/// Looks for a statement of scale at the nodes that it visits.
class ScaleVisitor : public osg::NodeVisitor
{
public:
    explicit ScaleVisitor(TraversalMode mode) : osg::NodeVisitor(mode) {}

    void apply(osg::Node& node) override
    {
        auto text = userValue(node, MetresKey);
        if (!text)
            text = description(node, MetresKey);
        if (!text)
            text = findIn(node.getName(), MetresKey);
        if (text)
            add(parse(MetresKey, *text, LeastMetres));
        // Above, the nearest statement counts.
        if (!text || getTraversalMode() != TRAVERSE_PARENTS)
            traverse(node);
    }

    Stated found;

private:
    void add(const Stated& stated)
    {
        if (!found.error.empty())
            return;
        if (!stated.isKnown())
            found = {-1.0, "a node's statement is wrong: " + stated.error};
        else if (found.isKnown() && found.value != stated.value)
            found = {-1.0, "nodes contradict each other: " + std::string(MetresKey) + "=" +
                               toText(found.value) + " and " + toText(stated.value)};
        else
            found = stated;
    }
};

} // namespace

Stated intensityOf(const osg::LightSource& source)
{
    const osg::Light* light = source.getLight();
    if (!light)
        return {-1.0, "it has no osg::Light"};
    const auto candela = findKey(source, "candela");
    const auto lumen = findKey(source, "lumen");
    const auto lux = findKey(source, "lux");
    if (light->getPosition().w() == 0.0f)
    {
        if (lux)
            return parse("lux", *lux, 0.0);
        return {-1.0,
                candela || lumen ? "it is directional and needs lux=<number> instead of "
                                   "candela or lumen"
                                 : "it states no lux=<number>",
                !candela && !lumen};
    }
    if (candela && lumen)
        return {-1.0, "it states both candela and lumen"};
    if (candela)
        return parse("candela", *candela, 0.0);
    if (lumen)
    {
        Stated stated = parse("lumen", *lumen, 0.0);
        const double cone = coneOf(light->getSpotCutoff(), light->getSpotExponent());
        if (stated.isKnown() && !(cone > 0.0))
            return {-1.0, "its cone is empty, so its lumen give no candela"};
        if (stated.isKnown())
            stated.value /= cone;
        return stated;
    }
    return {-1.0,
            lux ? "it has a position and needs candela=<number> or lumen=<number> instead of "
                  "lux"
                : "it states no candela=<number>",
            !lux};
}

Stated metresPerUnitOf(const osg::Node& scene)
{
    // Visitors want nodes that they could change; these do not.
    auto& node = const_cast<osg::Node&>(scene);
    for (const auto mode :
         {osg::NodeVisitor::TRAVERSE_NONE, osg::NodeVisitor::TRAVERSE_ALL_CHILDREN,
          osg::NodeVisitor::TRAVERSE_PARENTS})
    {
        ScaleVisitor visitor(mode);
        node.accept(visitor);
        if (visitor.found.isKnown() || !visitor.found.error.empty())
            return visitor.found;
    }
    return {-1.0, "no node states metresPerUnit=<number>", true};
}

std::string describeLight(const osg::Light& light)
{
    std::string text = "light " + std::to_string(light.getLightNum());
    return light.getName().empty() ? text : text + " '" + light.getName() + "'";
}

double coneOf(double cutoffDegrees, double exponent)
{
    constexpr double pi = 3.14159265358979323846;
    if (cutoffDegrees == 180.0)
        return 4.0 * pi;
    // 1 - c^(e+1) without the cancellation of narrow cones, for which c is near 1.
    const double cosine = std::cos(std::min(cutoffDegrees, 90.0) * pi / 180.0);
    const double share = cosine > 0.0 ? -std::expm1((exponent + 1.0) * std::log(cosine)) : 1.0;
    return 2.0 * pi * share / (exponent + 1.0);
}

double illuminanceAt(const EyeLight& light, const glm::dvec3& position, const glm::dvec3& normal)
{
    glm::dvec3 toLight = light.position;
    double lux = light.luxAtUnit;
    if (!light.isDirectional())
    {
        toLight -= position;
        const double distance = glm::length(toLight);
        if (!(distance > 0.0))
            return 0.0;
        toLight /= distance;
        lux = lux / distance / distance;
    }
    const double cosine = glm::dot(normal, toLight);
    if (!(cosine > 0.0))
        return 0.0;
    if (light.type == EyeLight::Spot || light.type == EyeLight::DirectionalSpot)
    {
        constexpr double radians = 3.14159265358979323846 / 180.0;
        const double c = -glm::dot(toLight, light.spotDirection);
        if (c < std::cos(double(light.spotCutoffDegrees) * radians))
            return 0.0;
        if (light.spotExponent != 0.0f)
            lux *= std::pow(std::max(c, 0.0), double(light.spotExponent));
    }
    return lux * cosine;
}

} // namespace osgShadowVolume
