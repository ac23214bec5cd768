// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixOptions.h>

#include <osgMultiRender/MixOptionTexts.h>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

template <class Value> struct Word
{
    const char* name;
    Value value;
};

template <class Value, class Get, class Set>
MixOption choice(const char* name, const std::vector<Word<Value>>& words, Get get, Set set,
                 const char* help)
{
    return wordOption<MixedScene>(name, help, words, get, set);
}

template <class Get, class Set> MixOption flag(const char* name, Get get, Set set, const char* help)
{
    return choice<bool>(name, {{"on", true}, {"off", false}}, get, set, help);
}

template <class Change> auto ruleSetter(Change change)
{
    return [change](MixedScene& scene, auto value)
    {
        MixRules rules = scene.getRules();
        change(rules, value);
        scene.setRules(rules);
    };
}

} // namespace

const std::vector<MixOption>& mixOptions()
{
    using Scene = MixedScene;
    static const std::vector<MixOption> options = {
        {"mix", "<file.mix>", "A mix file; what else is said wins over it", parseMix,
         [](const Scene&) { return std::string(); }},
        {"renderings", "<name or file>:dr0,dr1,dr2,dr3;…",
         "Renderings to add, built-in ones by name, with their ranges of distances",
         parseRenderings, formatRenderings},
        {"points", "<x,y,z>;…", "Key points in coordinates of the model", parsePoints,
         formatPoints},
        choice<KeyMode>(
            "mode",
            {{"points", KeyMode::Points},
             {"polyline", KeyMode::Polyline},
             {"loop", KeyMode::PolylineLoop}},
            &Scene::getKeyMode,
            [](Scene& scene, KeyMode mode) { scene.setKeyPoints(scene.getKeyPoints(), mode); },
            "What lies between key points: nothing, segments, segments to a loop"),
        choice<MixRules::Excess>(
            "excess",
            {{"clamp", MixRules::Excess::Clamp}, {"normalise", MixRules::Excess::Normalise}},
            [](const Scene& scene) { return scene.getRules().excess; },
            ruleSetter([](MixRules& rules, MixRules::Excess value) { rules.excess = value; }),
            "Where weights add up to more than 1: the sum of colours is clamped, or weights are "
            "divided by their sum"),
        {"base", "none|<name or number>", "The rendering that takes what is missing to 1",
         parseBase, formatBase},
        {"background", "none|transparent|<#rrggbb>|<#rrggbbaa>",
         "What takes it without a base: black, what lies behind, a colour", parseBackground,
         formatBackground},
        choice<MixInput>("input", {{"surface", MixInput::Surface}, {"frame", MixInput::Frame}},
                         &Scene::getInput, &Scene::setInput,
                         "What renderings are shown on: surfaces; the frame, in a second pass"),
        choice<bool>("lighting", {{"scene", false}, {"own", true}}, &Scene::getOwnLighting,
                     &Scene::setOwnLighting,
                     "Whose lights and materials imported projects read: the scene's; those that "
                     "they hold"),
        {"uniforms", "<rendering>.<uniform>=<values>;…", "Values of uniforms, as phong.gloss=60",
         parseUniforms, formatUniforms},
        flag("pruning", &Scene::getPruning, &Scene::setPruning,
             "Programs of fewer renderings for drawables that need no more"),
        numberOption<Scene>(
            "settle", "Frames without movement after which such programs are made; 0: at once", 0u,
            100000u, &Scene::getSettleFrames, &Scene::setSettleFrames),
        numberOption<Scene>("programs", "Programs that are kept", 1u, 4096u, &Scene::getMaxPrograms,
                            &Scene::setMaxPrograms),
        choice<MixMarks>(
            "show",
            {{"off", MixMarks::Off}, {"points", MixMarks::Points}, {"lines", MixMarks::Lines}},
            &Scene::getMarks, &Scene::setMarks, "Key points as red spheres; with what joins them"),
        flag("watch", &Scene::isWatching, &Scene::setWatching,
             "Imports files anew when they change: those of renderings, and the mix file"),
        flag("keys", &Scene::getAnswersKeys, &Scene::setAnswersKeys,
             "Answers to keys in osgviewer"),
    };
    return options;
}

bool setMixOptions(MixedScene& scene, const std::map<std::string, std::string>& settings,
                   std::string& error)
{
    for (const auto& [name, value] : settings)
        if (std::none_of(mixOptions().begin(), mixOptions().end(),
                         [key = name](const MixOption& option) { return option.name == key; }))
            return setOption(mixOptions(), scene, name, value, error);
    for (const MixOption& option : mixOptions())
        if (const auto found = settings.find(option.name); found != settings.end())
            if (!setOption(mixOptions(), scene, option.name, found->second, error))
                return false;
    return true;
}

} // namespace osgMultiRender
