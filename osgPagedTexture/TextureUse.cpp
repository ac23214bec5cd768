// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TextureUse.h>

#include <osg/Notify>
#include <osg/TexEnvCombine>
#include <osg/Uniform>
#include <osg/ValueObject>
#include <osgDB/FileNameUtils>

#include <algorithm>
#include <cctype>
#include <optional>

namespace osgPagedTexture
{

namespace
{

template <std::size_t Count>
bool isAnyOf(const std::string& word, const char* const (&words)[Count])
{
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

template <std::size_t Count>
bool hasAnyOf(const std::string& text, const char* const (&parts)[Count])
{
    return std::any_of(std::begin(parts), std::end(parts),
                       [&](const char* part) { return text.find(part) != std::string::npos; });
}

/// "Wall01_NormalGL-2k" as wall 01 normal gl 2k, in small letters.
std::vector<std::string> wordsOf(const std::string& text)
{
    std::vector<std::string> words;
    char before = 0;
    for (const char each : text)
    {
        const auto c = static_cast<unsigned char>(each);
        const auto last = static_cast<unsigned char>(before);
        const bool begins = !std::isalnum(last) || (std::isdigit(c) && !std::isdigit(last)) ||
                            (std::isupper(c) && std::islower(last));
        if (std::isalnum(c) && begins)
            words.emplace_back();
        if (std::isalnum(c))
            words.back() += char(std::tolower(c));
        before = each;
    }
    return words;
}

std::optional<TextureUse> usersChoice(const osg::Texture2D& texture)
{
    std::string said;
    if (!texture.getUserValue("osgPagedTexture.use", said))
        return {};
    constexpr const char* words[] = {"color", "data", "normals", "normalsxy"};
    for (int i = 0; i < 4; ++i)
        if (said == words[i])
            return static_cast<TextureUse>(i);
    OSG_WARN << "osgPagedTexture::useOf: '" << said << "' is no use of a texture; say color, data, "
             << "normals or normalsxy" << std::endl;
    return {};
}

TextureUse reliefOf(const TexturePicture& picture)
{
    return picture.channels < 3 ? TextureUse::Data : TextureUse::Normals;
}

/// Of the sampler that reads the unit, as the innermost StateSet says; empty for none.
std::string samplerOf(const TextureSite& site)
{
    for (auto stateSet = site.path.rbegin(); stateSet != site.path.rend(); ++stateSet)
        for (const auto& each : (*stateSet)->getUniformList())
        {
            const osg::Uniform& uniform = *each.second.first;
            int unit = -1;
            const bool isSampler = uniform.getType() == osg::Uniform::INT ||
                                   uniform.getType() == osg::Uniform::SAMPLER_2D;
            if (isSampler && uniform.getNumElements() == 1 && uniform.get(unit) &&
                unit == int(site.unit))
                return osgDB::convertToLowerCase(uniform.getName());
        }
    return {};
}

/// Fixed-function relief multiplies light directions by normals.
bool isDotProduct(const TextureSite& site)
{
    for (auto stateSet = site.path.rbegin(); stateSet != site.path.rend(); ++stateSet)
    {
        const auto* combine = dynamic_cast<const osg::TexEnvCombine*>(
            (*stateSet)->getTextureAttribute(site.unit, osg::StateAttribute::TEXENV));
        if (combine)
            return combine->getCombine_RGB() == osg::TexEnvCombine::DOT3_RGB ||
                   combine->getCombine_RGB() == osg::TexEnvCombine::DOT3_RGBA;
    }
    return false;
}

} // namespace

bool isNamedNormalMap(const std::string& name, bool isShortToo)
{
    constexpr const char* whole[] = {"normal", "normals", "normalmap", "nrm",     "nrml",
                                     "norm",   "nmap",    "normalgl",  "normaldx"};
    constexpr const char* variants[] = {"gl", "dx", "ogl", "opengl", "directx", "k", "px", "map"};
    std::vector<std::string> words = wordsOf(osgDB::getStrippedName(name));
    const auto tellsNothing = [&](const std::string& word)
    { return std::isdigit(static_cast<unsigned char>(word[0])) || isAnyOf(word, variants); };
    while (words.size() > 1 && tellsNothing(words.back()))
        words.pop_back();
    if (words.empty())
        return false;
    const std::string& last = words.back();
    return isAnyOf(last, whole) ||
           (isShortToo && words.size() > 1 && (last == "n" || last == "nm"));
}

TextureUse useOf(const osg::Texture2D& texture, const TextureSite& site,
                 const TexturePicture& picture)
{
    if (const std::optional<TextureUse> chosen = usersChoice(texture))
        return *chosen;
    const std::string sampler = samplerOf(site);
    constexpr const char* reliefs[] = {"normal", "bump", "nrm", "height", "displace"};
    constexpr const char* colors[] = {"color", "colour", "diffuse", "albedo", "base"};
    if (hasAnyOf(sampler, reliefs))
        return reliefOf(picture);
    if (hasAnyOf(sampler, colors))
        return TextureUse::Color;
    if (isDotProduct(site) || (site.bumpUnit >= 0 && int(site.unit) == site.bumpUnit))
        return reliefOf(picture);
    // Unit 0 is the colour of fixed-function models: there "house_n" may be a house's north.
    const bool isNamed = isNamedNormalMap(picture.name, site.unit > 0) ||
                         isNamedNormalMap(texture.getName(), site.unit > 0);
    return isNamed && picture.channels >= 3 ? TextureUse::Normals : TextureUse::Color;
}

} // namespace osgPagedTexture
