// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LitScene.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

#include <array>
#include <utility>

// The LitScene in files of the old .osg format:
//
//     osgShadowVolume::LitScene {
//       lighting PIXEL
//       lightScope MODES
//       num_children 1
//       …

namespace
{

using osgShadowVolume::LitScene;

constexpr std::array<std::pair<const char*, LitScene::Lighting>, 3> Lightings = {
    {{"OFF", LitScene::Lighting::OFF},
     {"VERTEX", LitScene::Lighting::VERTEX},
     {"PIXEL", LitScene::Lighting::PIXEL}}};

constexpr std::array<std::pair<const char*, LitScene::LightScope>, 2> LightScopes = {
    {{"MODES", LitScene::LightScope::MODES}, {"ALL", LitScene::LightScope::ALL}}};

/// Takes "<word> <name of a value>" off the input. An unknown name is skipped and leaves the
/// default.
template <class Names, class Set>
bool read(osgDB::Input& in, const char* word, const Names& names, Set set)
{
    if (!in[0].matchWord(word))
        return false;
    for (const auto& [name, value] : names)
        if (in[1].matchWord(name))
            set(value);
    in += 2;
    return true;
}

template <class Names, class Value>
void write(osgDB::Output& out, const char* word, const Names& names, Value value)
{
    for (const auto& [name, candidate] : names)
        if (candidate == value)
            out.indent() << word << " " << name << "\n";
}

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    auto& scene = static_cast<LitScene&>(object);
    const bool lighting =
        read(in, "lighting", Lightings, [&](LitScene::Lighting l) { scene.setLighting(l); });
    const bool scope = read(in, "lightScope", LightScopes,
                            [&](LitScene::LightScope s) { scene.setLightScope(s); });
    return lighting || scope;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const LitScene&>(object);
    write(out, "lighting", Lightings, scene.getLighting());
    write(out, "lightScope", LightScopes, scene.getLightScope());
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(LitScene)
(new osgShadowVolume::LitScene, "osgShadowVolume::LitScene",
 "Object Node osgShadowVolume::LitScene Group", readLocalData, writeLocalData);
