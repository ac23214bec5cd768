// SPDX-License-Identifier: MIT
#include "Arguments.h"

#include "Output.h"
#include "Parse.h"

#include <functional>

namespace osgrender
{

namespace
{

using Values = std::vector<std::string>;

/// A switch: how many values follow it, and what takes them. `take` returns why it can't, else "".
struct Switch
{
    std::size_t values = 1;
    std::function<std::string(const Values&)> take;
};

using Switches = std::map<std::string, Switch>;

/// Hands known switches with their values to their takers and the other words to `rest`.
bool parse(const Values& words, const Switches& switches, Values& rest, std::string& error)
{
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        const auto found = switches.find(words[i]);
        if (found == switches.end())
        {
            rest.push_back(words[i]);
            continue;
        }
        const std::size_t count = found->second.values;
        if (words.size() - i - 1 < count)
        {
            error =
                words[i] + " needs " + (count == 1 ? "a value" : std::to_string(count) + " values");
            return false;
        }
        const auto first = words.begin() + std::ptrdiff_t(i) + 1;
        const std::string cause = found->second.take(Values(first, first + std::ptrdiff_t(count)));
        if (!cause.empty())
        {
            error = cause.compare(0, 2, "--") == 0 ? cause : words[i] + ": " + cause;
            return false;
        }
        i += count;
    }
    return true;
}

Switch text(std::string& target)
{
    return {1, [&target](const Values& v)
            {
                target = v[0];
                return v[0].empty() ? "an empty value" : "";
            }};
}

Switch whole(int& target, int low, int high)
{
    return {1,
            [&target, low, high](const Values& v) -> std::string
            {
                long value = 0;
                if (!parseWhole(v[0], low, high, value))
                    return "'" + v[0] + "' is not a whole number from " + std::to_string(low) +
                           " to " + std::to_string(high);
                target = int(value);
                return std::string();
            }};
}

/// `low` is 0, or so small that it stands for "more than 0".
Switch number(double& target, double low)
{
    return {1,
            [&target, low](const Values& v) -> std::string
            {
                if (parseNumber(v[0], target) && target >= low)
                    return std::string();
                return "'" + v[0] + "' is not a number " +
                       (low > 0.0 ? "above 0" : "of at least 0");
            }};
}

Switch flag(bool& target)
{
    return {0, [&target](const Values&)
            {
                target = true;
                return std::string();
            }};
}

std::string takeSize(const std::string& width, const std::string& height, Arguments& arguments)
{
    long w = 0, h = 0;
    if (!parseWhole(width, 1, 65536, w) || !parseWhole(height, 1, 65536, h))
        return "'" + width + "x" + height + "' is not a size from 1x1 to 65536x65536, like 800x600";
    arguments.width = int(w);
    arguments.height = int(h);
    return std::string();
}

std::string takeBackend(const std::string& name, Backend& backend)
{
    for (Backend known : {Backend::Auto, Backend::Egl, Backend::Osmesa})
    {
        if (name == toString(known))
        {
            backend = known;
            return std::string();
        }
    }
    return "'" + name + "' is none of auto, egl, osmesa";
}

std::string takeDefinition(const std::string& text, std::map<std::string, std::string>& definitions)
{
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
        return "'" + text + "' is not NAME=value";
    definitions[text.substr(0, equals)] = text.substr(equals + 1);
    return std::string();
}

/// osgviewer's switches that mean the window, which here is the picture.
void addWindowSwitches(Switches& switches, Arguments& arguments)
{
    const Switch window = {4, [&arguments](const Values& v)
                           { return takeSize(v[2], v[3], arguments); }};
    switches["--window"] = switches["--borderless-window"] = window;
    switches["--screen"] = {1, [](const Values&) { return std::string(); }};
}

Switches renderSwitches(Arguments& a)
{
    Switches switches;
    switches["-o"] = {1, [&a](const Values& v)
                      {
                          a.outputs.push_back(v[0]);
                          return checkPattern(v[0]);
                      }};
    switches["--size"] = {1, [&a](const Values& v)
                          {
                              const Values parts = split(v[0], 'x');
                              return parts.size() == 2 ? takeSize(parts[0], parts[1], a)
                                                       : "'" + v[0] + "' is not WIDTHxHEIGHT";
                          }};
    switches["--camera"] = {1, [&a](const Values& v)
                            {
                                std::string error;
                                parseCamera(v[0], a.camera, error);
                                return error;
                            }};
    switches["--tolerance"] = {1, [&a](const Values& v)
                               {
                                   std::string error;
                                   parseTolerance(v[0], a.tolerance, error);
                                   return error;
                               }};
    switches["--probe"] = {1, [&a](const Values& v)
                           {
                               std::string error;
                               parseProbe(v[0], a.probe.points.emplace_back(), error);
                               return error;
                           }};
    switches["--probe-grid"] = {1, [&a](const Values& v)
                                {
                                    std::string error;
                                    parseProbeGrid(v[0], a.probe.grids.emplace_back(), error);
                                    return error;
                                }};
    switches["--pick"] = {1, [&a](const Values& v)
                          {
                              std::string error;
                              parsePick(v[0], a.picks.emplace_back(), error);
                              return error;
                          }};
    switches["--probe-csv"] = text(a.probe.csv);
    switches["--candela"] = number(a.probe.candela, 1e-12);
    switches["--lux"] = number(a.probe.lux, 1e-12);
    switches["--metres-per-unit"] = number(a.probe.metresPerUnit, 1e-12);
    switches["--title"] = text(a.title);
    switches["--samples"] = whole(a.samples, 0, 64);
    switches["--float"] = flag(a.floatPixels);
    switches["--camera-path"] = switches["-p"] = text(a.cameraPath);
    switches["--speed"] = number(a.pathSpeed, 0.0);
    switches["--frames"] = whole(a.frames, 1, 1000000);
    switches["--time"] = number(a.startSeconds, 0.0);
    switches["--frame-time"] = number(a.frameSeconds, 0.0);
    switches["--timing"] = whole(a.timingFrames, 0, 100000);
    switches["--paging-limit"] = number(a.pagingSeconds, 0.0);
    switches["--stats"] = text(a.stats);
    switches["--list-plan"] = flag(a.listPlan);
    switches["--reference"] = text(a.reference);
    switches["--difference"] = text(a.difference);
    addWindowSwitches(switches, a);
    return switches;
}

} // namespace

const char* toString(Backend backend)
{
    switch (backend)
    {
    case Backend::Auto:
        return "auto";
    case Backend::Egl:
        return "egl";
    case Backend::Osmesa:
        break;
    }
    return "osmesa";
}

bool parseProcess(const std::vector<std::string>& words, ProcessArguments& arguments,
                  std::string& error)
{
    Switches switches;
    switches["--help"] = switches["-h"] = flag(arguments.help);
    switches["--list-keys"] = flag(arguments.listKeys);
    switches["--html"] = text(arguments.page);
    switches["--backend"] = {1,
                             [&](const Values& v) { return takeBackend(v[0], arguments.backend); }};
    switches["-D"] = {1,
                      [&](const Values& v) { return takeDefinition(v[0], arguments.definitions); }};
    Values rest;
    if (!parse(words, switches, rest, error))
        return false;

    // osgviewer's way to name the same plugins; other -e stay.
    for (std::size_t i = 0; i < rest.size(); ++i)
    {
        const std::string next = i + 1 < rest.size() ? rest[i + 1] : std::string();
        if (rest[i] == "-e" && (next == "egl" || next == "osmesa"))
        {
            takeBackend(next, arguments.backend);
            ++i;
        }
        else if (rest[i].size() > 1 && rest[i][0] == '@')
            arguments.scripts.push_back(rest[i].substr(1));
        else
            arguments.rest.push_back(rest[i]);
    }
    return true;
}

bool parseRender(const std::vector<std::string>& words, Arguments& arguments, std::string& error)
{
    if (!parse(words, renderSwitches(arguments), arguments.viewerArguments, error))
        return false;
    for (const PickPoint& pick : arguments.picks)
        if (pick.x >= arguments.width || pick.y >= arguments.height)
        {
            error = "--pick: " + std::to_string(pick.x) + "," + std::to_string(pick.y) +
                    " is outside of a picture of " + std::to_string(arguments.width) + "x" +
                    std::to_string(arguments.height);
            return false;
        }
    return checkOutputs(arguments, error);
}

} // namespace osgrender
