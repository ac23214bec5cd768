// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixFile.h>

#include <osgMultiRender/ImportFile.h>
#include <osgMultiRender/MixEntry.h>
#include <osgMultiRender/MixOptions.h>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

namespace
{

using Json = MixJson;

/// What a file says, before anything of it counts.
struct ParsedMix
{
    struct Entry
    {
        Rendering rendering;
        MixRange range;
        std::map<std::string, std::vector<double>> uniforms;
    };

    std::vector<Entry> renderings;
    std::vector<osg::Vec3d> points;
    bool hasPoints = false;
    std::map<std::string, std::string> options;
};

class MixReader
{
public:
    explicit MixReader(const std::string& fileName) : _fileName(fileName) {}

    bool read(const std::string& text, ParsedMix& mix)
    {
        Json json;
        bool isTooDeep = false;
        try
        {
            json = Json::parse(
                text,
                [&](int depth, Json::parse_event_t, Json&)
                {
                    isTooDeep = isTooDeep || depth > MaxDepth;
                    return depth <= MaxDepth;
                },
                true, true);
        }
        catch (const Json::parse_error& e)
        {
            const std::size_t end = std::min(e.byte, text.size());
            const auto line =
                1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(end), '\n');
            _error = "line " + std::to_string(line) + " is no JSON; " + std::string(e.what());
            return false;
        }
        catch (const Json::exception& e) // a number beyond all doubles
        {
            return fail("the mix", "is no JSON; " + std::string(e.what()));
        }
        if (isTooDeep)
            return fail("the mix", "has lists in lists " + std::to_string(MaxDepth) + " deep");
        if (!json.is_object())
            return fail("the mix", "is no object; write { \"renderings\": […], … }");
        for (const auto& [key, value] : json.items())
            if (!readKey(key, value, mix))
                return false;
        return true;
    }

    const std::string& getError() const { return _error; }

private:
    /// More than a mix has; copies of values would take the stack.
    static constexpr int MaxDepth = 16;

    bool fail(const std::string& place, const std::string& cause)
    {
        _error = place + " " + cause;
        return false;
    }

    bool readKey(const std::string& key, const Json& value, ParsedMix& mix)
    {
        if (key == "renderings")
            return readRenderings(value, mix);
        if (key == "points")
            return readPoints(value, mix);
        const auto& options = mixOptions();
        if (key == "mix" || key == "uniforms" ||
            std::none_of(options.begin(), options.end(),
                         [&](const MixOption& option) { return option.name == key; }))
            return fail("'" + key + "'", "is not known; see docs/settings.md");
        if (value.is_string())
            mix.options[key] = value.get<std::string>();
        else if (value.is_boolean())
            mix.options[key] = value.get<bool>() ? "on" : "off";
        else if (value.is_number())
            mix.options[key] = formatNumber(value.get<double>());
        else
            return fail("'" + key + "'", "is neither text nor number");
        return true;
    }

    bool readNumber(const Json& value, double& number)
    {
        if (value.is_number())
            number = value.get<double>();
        return value.is_number() ||
               (value.is_string() && parseNumber(value.get<std::string>(), number) &&
                !std::isnan(number));
    }

    bool readNumbers(const Json& value, std::vector<double>& numbers)
    {
        const Json list = value.is_array() ? value : Json::array({value});
        for (const Json& one : list)
        {
            double number = 0.0;
            if (!readNumber(one, number))
                return false;
            numbers.push_back(number);
        }
        return true;
    }

    bool readPoints(const Json& value, ParsedMix& mix)
    {
        mix.hasPoints = true;
        if (!value.is_array())
            return fail("'points'", "is no list; write [[x, y, z], …]");
        for (std::size_t i = 0; i < value.size(); ++i)
        {
            std::vector<double> numbers;
            if (!value[i].is_array() || !readNumbers(value[i], numbers) || numbers.size() != 3)
                return fail("points[" + std::to_string(i) + "]", "is not three numbers");
            mix.points.emplace_back(numbers[0], numbers[1], numbers[2]);
        }
        return true;
    }

    bool readRenderings(const Json& value, ParsedMix& mix)
    {
        if (!value.is_array())
            return fail("'renderings'", "is no list; write [{ \"name\": \"phong\" }, …]");
        for (std::size_t i = 0; i < value.size(); ++i)
        {
            ParsedMix::Entry entry;
            const std::string place = "renderings[" + std::to_string(i) + "]";
            if (!value[i].is_object())
                return fail(place, "is no object; write { \"name\": \"phong\" }");
            for (const auto& [key, part] : value[i].items())
                if (!readPart(place, key, part, entry))
                    return false;
            const std::string wrong = readMixProgram(
                value[i], [this](const std::string& file) { return pathOf(file); },
                entry.rendering);
            if (!wrong.empty())
            {
                _error = place + wrong;
                return false;
            }
            // Of a program in full they are its own values, too: those of samplers are units.
            if (value[i].contains("vertex") || value[i].contains("fragment"))
                for (const auto& [name, values] : entry.uniforms)
                    uniformOf(entry.rendering, name).values = values;
            mix.renderings.push_back(std::move(entry));
        }
        return true;
    }

    bool readPart(const std::string& place, const std::string& key, const Json& part,
                  ParsedMix::Entry& entry)
    {
        std::vector<double> numbers;
        if (key == "range")
        {
            if (!part.is_array() || !readNumbers(part, numbers))
                return fail(place + ".range", "is no list of distances");
            const std::string cause = makeRange(numbers, entry.range);
            return cause.empty() || fail(place + ".range:", cause);
        }
        if (key == "uniforms")
        {
            if (!part.is_object())
                return fail(place + ".uniforms", "is no object; write { \"gloss\": 60 }");
            for (const auto& [name, value] : part.items())
                if (!readNumbers(value, entry.uniforms[name]))
                    return fail(place + ".uniforms." + name, "is no number or list of numbers");
            return true;
        }
        return isMixProgramKey(key) ||
               fail(place + "." + key,
                    "is not known; there are name, file, range, uniforms, vertex, fragment, "
                    "defines, textures, attributes, outputs");
    }

    std::string pathOf(const std::string& file) const
    {
        if (!_fileName.empty() && !osgDB::isAbsolutePath(file))
            return osgDB::concatPaths(osgDB::getFilePath(_fileName), file);
        const std::string found = osgDB::findDataFile(file);
        return found.empty() ? file : found;
    }

    std::string _fileName;
    std::string _error;
};

Json formatDistance(double distance)
{
    return std::isfinite(distance) ? Json(distance) : Json(formatNumber(distance));
}

} // namespace

bool applyMix(MixedScene& scene, const std::string& text, const std::string& fileName,
              std::string& error)
{
    const std::string who = fileName.empty() ? "mix" : fileName;
    MixReader reader(fileName);
    ParsedMix mix;
    const auto apply = [&](MixedScene& to)
    {
        std::vector<unsigned int> numbers;
        for (const ParsedMix::Entry& entry : mix.renderings)
        {
            const unsigned int number = to.addRendering(entry.rendering, entry.range);
            numbers.push_back(number);
            for (const auto& [name, values] : entry.uniforms)
                to.setUniform(number, name, values);
        }
        if (mix.hasPoints)
            to.setKeyPoints(mix.points, to.getKeyMode());
        // Numbers in a mix are places in its list.
        if (const auto base = mix.options.find("base"); base != mix.options.end())
            for (std::size_t i = 0; i < numbers.size(); ++i)
                if (base->second == std::to_string(i))
                {
                    base->second = std::to_string(numbers[i]);
                    break;
                }
        return setMixOptions(to, mix.options, error);
    };
    // First into a copy, so that a mistake changes nothing.
    if (!reader.read(text, mix))
        error = reader.getError();
    else if (const osg::ref_ptr<MixedScene> trial = scene.cloneSettings(); apply(*trial))
    {
        scene.takeSettings(*trial);
        if (mix.options.count("watch"))
            scene.setWatching(trial->isWatching());
        return true;
    }
    error = who + ": " + error;
    return false;
}

bool readMixFile(MixedScene& scene, const std::string& fileName, std::string& error)
{
    std::string text;
    if (readTextFile(fileName, text, error))
    {
        // First: a mix may say that files are looked after, this one as well.
        const std::string before = scene.getMixFile();
        scene.setMixFile(fileName);
        if (applyMix(scene, text, fileName, error))
            return true;
        scene.setMixFile(before);
        return false;
    }
    error = fileName + ": " + error;
    return false;
}

std::string formatMix(const MixedScene& scene)
{
    Json json = Json::object();
    std::map<unsigned int, int> places; // by number: removed ones leave gaps
    for (const unsigned int number : scene.getRenderings())
    {
        places.emplace(number, int(places.size()));
        Json entry = Json::object();
        const std::shared_ptr<const Rendering> rendering = scene.getRendering(number);
        formatMixProgram(*rendering, entry);
        const MixRange range = scene.getRange(number);
        for (const double dr : {range.dr0, range.dr1, range.dr2, range.dr3})
            entry["range"].push_back(formatDistance(dr));
        std::vector<std::string> names = scene.getSetUniforms(number);
        if (entry.contains("vertex") || entry.contains("fragment"))
            for (const RenderingUniform& uniform : rendering->uniforms)
                if (!uniform.values.empty() &&
                    std::find(names.begin(), names.end(), uniform.name) == names.end())
                    names.push_back(uniform.name);
        for (const std::string& name : names)
            for (const double value : scene.getUniform(number, name))
                entry["uniforms"][name].push_back(formatDistance(value));
        json["renderings"].push_back(entry);
    }
    for (const osg::Vec3d& point : scene.getKeyPoints())
        json["points"].push_back(
            {formatDistance(point.x()), formatDistance(point.y()), formatDistance(point.z())});
    const osg::ref_ptr<MixedScene> defaults = new MixedScene;
    for (const MixOption& option : mixOptions())
    {
        if (option.name == "renderings" || option.name == "points")
            continue;
        std::string value = option.format(scene);
        const auto place = places.find(unsigned(scene.getRules().base));
        if (option.name == "base" && scene.getRules().base >= 0)
            value = place == places.end() ? "none" : std::to_string(place->second);
        if (value != option.format(*defaults))
            json[option.name] = value;
    }
    // Texts of renderings need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace osgMultiRender
