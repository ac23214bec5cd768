// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LitScene.h>
#include <osgShadowVolume/ShadowSettings.h>

#include <array>
#include <string>

namespace osgShadowVolume
{

/// What a value is called in settings; files have the same word in capitals.
template <class Value> struct ValueName
{
    const char* name;
    Value value;
};

/// The word that files have.
inline std::string inCapitals(std::string name)
{
    for (char& c : name)
        c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    return name;
}

template <class Value, std::size_t N> using ValueNames = std::array<ValueName<Value>, N>;

inline constexpr ValueNames<LitScene::Lighting, 3> LightingNames = {
    {{"pixel", LitScene::Lighting::PIXEL},
     {"vertex", LitScene::Lighting::VERTEX},
     {"off", LitScene::Lighting::OFF}}};

inline constexpr ValueNames<LitScene::LightScope, 2> LightScopeNames = {
    {{"modes", LitScene::LightScope::MODES}, {"all", LitScene::LightScope::ALL}}};

inline constexpr ValueNames<Shadows, 3> ShadowsNames = {
    {{"volumes", Shadows::VOLUMES}, {"map", Shadows::MAP}, {"off", Shadows::OFF}}};

inline constexpr ValueNames<Technique, 4> TechniqueNames = {{{"auto", Technique::AUTO},
                                                             {"tess", Technique::TESS},
                                                             {"geometry", Technique::GEOMETRY},
                                                             {"cpu", Technique::CPU}}};

inline constexpr ValueNames<TransparentCasters, 3> TransparentCastersNames = {
    {{"alpha", TransparentCasters::BY_ALPHA},
     {"all", TransparentCasters::ALL},
     {"none", TransparentCasters::NONE}}};

inline constexpr ValueNames<Show, 5> ShowNames = {{{"picture", Show::PICTURE},
                                                   {"mask", Show::MASK},
                                                   {"volumes", Show::VOLUMES},
                                                   {"illuminance", Show::ILLUMINANCE},
                                                   {"lux", Show::LUX}}};

inline constexpr ValueNames<bool, 2> HeadlightNames = {{{"noshadow", false}, {"shadow", true}}};

inline constexpr ValueNames<bool, 2> SwitchNames = {{{"on", true}, {"off", false}}};

} // namespace osgShadowVolume
