// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MirrorNames.h>

#include <osg/Material>
#include <osg/ValueObject>

#include <cctype>
#include <charconv>

namespace osgShadowVolume
{

namespace
{

/// A share of light; empty for what is none.
std::optional<double> share(double value)
{
    if (value >= 0.0 && value <= 1.0)
        return value;
    return std::nullopt;
}

std::optional<double> shareIn(const std::string& text)
{
    double value = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size())
        return std::nullopt;
    return share(value);
}

class ShareVisitor : public osg::ValueObject::GetValueVisitor
{
public:
    void apply(bool value) override { found = value ? DefaultReflectivity : 0.0; }
    void apply(int value) override { found = share(value); }
    void apply(unsigned int value) override { found = share(value); }
    void apply(float value) override { found = share(double(value)); }
    void apply(double value) override { found = share(value); }
    void apply(const std::string& value) override { found = shareIn(value); }

    std::optional<double> found;
};

std::optional<double> userValueOf(const osg::Object& object)
{
    const osg::UserDataContainer* data = object.getUserDataContainer();
    const auto* value =
        data ? dynamic_cast<const osg::ValueObject*>(data->getUserObject("mirror")) : nullptr;
    if (!value)
        return std::nullopt;
    ShareVisitor visitor;
    value->get(visitor);
    return visitor.found;
}

std::optional<double> descriptionOf(const osg::Node& node)
{
    const std::string head = "mirror=";
    const osg::UserDataContainer* data = node.getUserDataContainer();
    for (unsigned int i = 0; data && i != data->getNumDescriptions(); ++i)
    {
        const std::string& text = data->getDescriptions()[i];
        if (text.compare(0, head.size(), head) == 0)
            return shareIn(text.substr(head.size()));
    }
    return std::nullopt;
}

const osg::StateAttribute* materialOf(const osg::Node& node)
{
    const osg::StateSet* state = node.getStateSet();
    return state ? state->getAttribute(osg::StateAttribute::MATERIAL) : nullptr;
}

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

} // namespace

std::optional<double> reflectivityOfName(const std::string& name)
{
    const std::string word = "mirror";
    if (name.size() < word.size())
        return std::nullopt;
    for (std::size_t i = 0; i < word.size(); ++i)
        if (std::tolower(static_cast<unsigned char>(name[i])) != word[i])
            return std::nullopt;
    std::string rest = name.substr(word.size());
    if (rest.empty())
        return DefaultReflectivity;
    if (std::isalpha(static_cast<unsigned char>(rest[0])))
        return std::nullopt; // "mirrored"
    const bool says = rest[0] == '=';
    if (says)
        rest.erase(0, 1);
    std::size_t end = 0;
    while (end < rest.size() && (isDigit(rest[end]) || rest[end] == '.'))
        ++end;
    const std::string number = rest.substr(0, end);
    if (says || (number.size() > 1 && number.find('.') != std::string::npos))
        return shareIn(number);
    if (number.size() == 2 || number.size() == 3)
        return share(std::stoi(number) / 100.0);
    return DefaultReflectivity;
}

std::optional<MirrorMark> mirrorMarkOf(const osg::Node& node)
{
    const auto mark = [](const std::optional<double>& value, bool byMaterial = false) {
        return value ? std::optional<MirrorMark>(MirrorMark{*value, byMaterial}) : std::nullopt;
    };
    if (const auto value = userValueOf(node))
        return mark(value);
    if (const auto value = descriptionOf(node))
        return mark(value);
    if (node.getStateSet())
        if (const auto value = userValueOf(*node.getStateSet()))
            return mark(value);
    if (const auto value = reflectivityOfName(node.getName()))
        return mark(value);
    if (const osg::StateAttribute* material = materialOf(node))
        return mark(reflectivityOfName(material->getName()), true);
    return std::nullopt;
}

bool hasMaterial(const osg::Node& node)
{
    return materialOf(node) != nullptr;
}

} // namespace osgShadowVolume
