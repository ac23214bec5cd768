// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixEntry.h>

#include <osgMultiRender/BuiltInRenderings.h>
#include <osgMultiRender/Import.h>
#include <osgMultiRender/ImportFile.h>

#include <osg/Notify>

#include <algorithm>
#include <array>
#include <map>

namespace osgMultiRender
{

namespace
{

using Bindings = std::map<std::string, unsigned int>;

constexpr std::array<std::pair<const char*, GlslStage>, 2> Stages = {
    {{"vertex", GlslStage::Vertex}, {"fragment", GlslStage::Fragment}}};

constexpr std::array<std::pair<const char*, unsigned int RenderingTexture::*>, 4> TextureNumbers = {
    {{"unit", &RenderingTexture::unit},
     {"target", &RenderingTexture::target},
     {"minFilter", &RenderingTexture::minFilter},
     {"magFilter", &RenderingTexture::magFilter}}};

bool isNumber(const MixJson& value)
{
    return value.is_number_integer() && value >= 0 && value <= 0xffff;
}

/// One text or a list of texts.
std::string readTexts(const MixJson& value, std::vector<std::string>& texts)
{
    for (const MixJson& one : value.is_array() ? value : MixJson::array({value}))
    {
        if (!one.is_string())
            return "is no text";
        texts.push_back(one.get<std::string>());
    }
    return {};
}

std::string readShaders(const MixJson& entry, Rendering& rendering)
{
    for (const auto& [key, stage] : Stages)
    {
        std::vector<std::string> texts;
        if (!entry.contains(key))
            continue;
        if (const std::string error = readTexts(entry[key], texts); !error.empty())
            return std::string(".") + key + " " + error;
        for (const std::string& text : texts)
            rendering.shaders.push_back({stage, text, rendering.name + "." + key});
    }
    return {};
}

std::string readTexture(const MixJson& value,
                        const std::function<std::string(const std::string&)>& pathOf,
                        RenderingTexture& texture)
{
    std::vector<std::string> file;
    if (!value.is_object() || !value.contains("file"))
        return R"( is no texture; write { "unit": 0, "file": "image.png" })";
    if (!readTexts(value["file"], file).empty() || file.size() != 1)
        return ".file is no text";
    texture.fileName = file[0].empty() ? file[0] : pathOf(file[0]);
    for (const auto& [key, part] : value.items())
    {
        const auto number =
            std::find_if(TextureNumbers.begin(), TextureNumbers.end(),
                         [name = key](const auto& one) { return name == one.first; });
        const bool isWrap = key == "wrap" && part.is_array() && part.size() == 3 &&
                            std::all_of(part.begin(), part.end(), isNumber);
        if (number != TextureNumbers.end() && isNumber(part))
            texture.*number->second = part.get<unsigned int>();
        else if (isWrap)
            texture.wrap = {part[0], part[1], part[2]};
        else if (key == "faces" && part.is_array() && readTexts(part, texture.faces).empty())
            std::transform(texture.faces.begin(), texture.faces.end(), texture.faces.begin(),
                           pathOf);
        else if (key != "file")
            return "." + key +
                   " is none; there are file, faces (6 files), unit, target, "
                   "minFilter, magFilter, wrap (3 numbers)";
    }
    return {};
}

std::string readBindings(const MixJson& entry, const char* key, Bindings& bindings)
{
    if (!entry.contains(key))
        return {};
    if (!entry[key].is_object())
        return std::string(".") + key + R"( is no object; write { "name": 1 })";
    for (const auto& [name, value] : entry[key].items())
    {
        if (!isNumber(value))
            return std::string(".") + key + "." + name + " is no number";
        bindings[name] = value.get<unsigned int>();
    }
    return {};
}

/// All but the texts.
std::string readRest(const MixJson& entry,
                     const std::function<std::string(const std::string&)>& pathOf,
                     Rendering& rendering)
{
    if (entry.contains("defines"))
    {
        if (!entry["defines"].is_object())
            return R"(.defines is no object; write { "STEPS": "8" })";
        for (const auto& [name, value] : entry["defines"].items())
        {
            if (!value.is_string())
                return ".defines." + name + " is no text";
            rendering.defines[name] = value.get<std::string>();
        }
    }
    if (entry.contains("textures"))
    {
        if (!entry["textures"].is_array())
            return R"(.textures is no list; write [{ "unit": 0, "file": "image.png" }])";
        for (std::size_t i = 0; i < entry["textures"].size(); ++i)
        {
            RenderingTexture texture;
            const std::string error = readTexture(entry["textures"][i], pathOf, texture);
            if (!error.empty())
                return ".textures[" + std::to_string(i) + "]" + error;
            rendering.textures.push_back(texture);
        }
    }
    const std::string error = readBindings(entry, "attributes", rendering.attributeBindings);
    return error.empty() ? readBindings(entry, "outputs", rendering.fragmentDataBindings) : error;
}

void formatTextures(const Rendering& rendering, MixJson& entry)
{
    for (const RenderingTexture& texture : rendering.textures)
    {
        MixJson json = {{"file", texture.fileName}};
        const RenderingTexture defaults;
        for (const auto& [key, member] : TextureNumbers)
            if (texture.*member != defaults.*member)
                json[key] = texture.*member;
        if (!texture.faces.empty())
            json["faces"] = texture.faces;
        if (texture.wrap != defaults.wrap)
            json["wrap"] = texture.wrap;
        entry["textures"].push_back(json);
    }
}

void formatInFull(const Rendering& rendering, MixJson& entry)
{
    bool isWhole = !rendering.state.given;
    for (const RenderingShader& shader : rendering.shaders)
    {
        const auto stage =
            std::find_if(Stages.begin(), Stages.end(),
                         [&](const auto& one) { return one.second == shader.stage; });
        isWhole = isWhole && stage != Stages.end();
        if (stage != Stages.end())
            entry[stage->first].push_back(shader.text);
    }
    for (const auto& [key, stage] : Stages)
        if (entry.contains(key) && entry[key].size() == 1)
            entry[key] = MixJson(entry[key][0]);
    for (const auto& [name, value] : rendering.defines)
        entry["defines"][name] = value;
    for (const auto& [name, location] : rendering.attributeBindings)
        entry["attributes"][name] = location;
    for (const auto& [name, location] : rendering.fragmentDataBindings)
        entry["outputs"][name] = location;
    formatTextures(rendering, entry);
    if (!isWhole)
        OSG_WARN
            << "osgMultiRender::MixedScene: rendering '" << rendering.name
            << "' is not saved as a whole: a mix has vertex and fragment shaders, and no state "
               "of lights and materials; save it as a file of its own"
            << std::endl;
}

} // namespace

bool isMixProgramKey(const std::string& key)
{
    for (const char* known :
         {"name", "file", "vertex", "fragment", "defines", "textures", "attributes", "outputs"})
        if (key == known)
            return true;
    return false;
}

std::string readMixProgram(const MixJson& entry,
                           const std::function<std::string(const std::string&)>& pathOf,
                           Rendering& rendering)
{
    for (const char* key : {"name", "file"})
        if (entry.contains(key) && !entry[key].is_string())
            return std::string(".") + key + " is no text";
    const std::string name = entry.value("name", ""), file = entry.value("file", "");
    if (!file.empty())
        rendering = importRendering(pathOf(file));
    else if (entry.contains("vertex") || entry.contains("fragment"))
    {
        rendering.name = name.empty() ? "unnamed" : name;
        std::string error = readShaders(entry, rendering);
        if (error.empty())
            error = readRest(entry, pathOf, rendering);
        readUniformComments(rendering);
        return error;
    }
    else if (findBuiltInRendering(name))
        rendering = importNamed(name);
    else
        return name.empty() ? " has neither name nor file"
                            : " names '" + name + "', which is not built in; say it as a file";
    return {};
}

void formatMixProgram(const Rendering& rendering, MixJson& entry)
{
    if (!rendering.fileName.empty())
    {
        entry["file"] = rendering.fileName;
        return;
    }
    entry["name"] = rendering.name;
    const BuiltInRendering* builtIn = findBuiltInRendering(rendering.name);
    const bool isBuiltIn = builtIn && rendering.shaders.size() == 2 && rendering.defines.empty() &&
                           rendering.shaders[0].text == builtIn->vertex &&
                           rendering.shaders[1].text == builtIn->fragment;
    if (!isBuiltIn)
        formatInFull(rendering, entry);
}

} // namespace osgMultiRender
