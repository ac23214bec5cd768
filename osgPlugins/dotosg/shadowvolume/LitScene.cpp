// SPDX-License-Identifier: MIT
#include <osgShadowVolume/EnumNames.h>

#include <osgDB/DotOsgWrapper>
#include <osgDB/Input>
#include <osgDB/Output>

#include <iomanip>
#include <sstream>

// The LitScene in files of the old .osg format:
//
//     osgShadowVolume::LitScene {
//       lighting PIXEL
//       lightScope MODES
//       lightTolerance 0.00196
//       num_children 1
//       …

namespace
{

using osgShadowVolume::LitScene;

/// Takes "<word> <name of a value>" off the input. An unknown name is skipped and leaves the
/// default.
template <class Names, class Set>
bool read(osgDB::Input& in, const char* word, const Names& names, Set set)
{
    if (!in[0].matchWord(word))
        return false;
    for (const auto& [name, value] : names)
        if (in[1].matchWord(osgShadowVolume::inCapitals(name).c_str()))
            set(value);
    in += 2;
    return true;
}

template <class Names, class Value>
void write(osgDB::Output& out, const char* word, const Names& names, Value value)
{
    for (const auto& [name, candidate] : names)
        if (candidate == value)
            out.indent() << word << " " << osgShadowVolume::inCapitals(name) << "\n";
}

bool readLocalData(osg::Object& object, osgDB::Input& in)
{
    auto& scene = static_cast<LitScene&>(object);
    const bool lighting = read(in, "lighting", osgShadowVolume::LightingNames,
                               [&](LitScene::Lighting l) { scene.setLighting(l); });
    const bool scope = read(in, "lightScope", osgShadowVolume::LightScopeNames,
                            [&](LitScene::LightScope s) { scene.setLightScope(s); });
    double tolerance = 0.0;
    const bool hasTolerance = in[0].matchWord("lightTolerance") && in[1].getFloat(tolerance);
    if (hasTolerance)
    {
        scene.setLightTolerance(tolerance);
        in += 2;
    }
    return lighting || scope || hasTolerance;
}

bool writeLocalData(const osg::Object& object, osgDB::Output& out)
{
    const auto& scene = static_cast<const LitScene&>(object);
    write(out, "lighting", osgShadowVolume::LightingNames, scene.getLighting());
    write(out, "lightScope", osgShadowVolume::LightScopeNames, scene.getLightScope());
    std::ostringstream tolerance;
    tolerance << std::setprecision(17) << scene.getLightTolerance();
    out.indent() << "lightTolerance " << tolerance.str() << "\n";
    return true;
}

} // namespace

REGISTER_DOTOSGWRAPPER(LitScene)
(new osgShadowVolume::LitScene, "osgShadowVolume::LitScene",
 "Object Node osgShadowVolume::LitScene Group", readLocalData, writeLocalData);
