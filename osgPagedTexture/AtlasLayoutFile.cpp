// SPDX-License-Identifier: MIT
#include <osgPagedTexture/AtlasLayout.h>

#include <osgPagedTexture/StoreFile.h>
#include <osgPagedTexture/TileStore.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace osgPagedTexture
{

namespace
{

using nlohmann::json;
using Kind = TileStoreError::Kind;

constexpr char Format[] = "osgKits atlas layout 1";

[[noreturn]] void damaged(const std::string& path, const std::string& what)
{
    throw TileStoreError(Kind::Damaged, "osgPagedTexture::AtlasLayout: '" + path + "': " + what);
}

json toJson(const PixelRect& rect)
{
    return json::array({rect.x, rect.y, rect.width, rect.height});
}

json toJson(const std::vector<PixelRect>& rects)
{
    json list = json::array();
    for (const PixelRect& rect : rects)
    {
        list.push_back(toJson(rect));
    }
    return list;
}

std::string lineOf(const AtlasPhoto& photo)
{
    nlohmann::ordered_json line = {
        {"path", photo.path},         {"x", photo.x},           {"y", photo.y},
        {"width", photo.width},       {"height", photo.height}, {"bytes", photo.bytes},
        {"modified", photo.modified}, {"hash", photo.hash}};
    if (!photo.used.empty())
    {
        line["used"] = toJson(photo.used);
    }
    try
    {
        return line.dump();
    }
    catch (const json::exception&)
    {
        throw TileStoreError(Kind::Refused,
                             "osgPagedTexture::AtlasLayout: the name of photograph '" + photo.path +
                                 "' is not UTF-8; rename it");
    }
}

std::string headOf(const AtlasLayout& layout)
{
    std::string text = std::string("{\n\"format\": \"") + Format + "\",\n";
    const auto number = [&](const char* name, std::int64_t value)
    { text += std::string("\"") + name + "\": " + std::to_string(value) + ",\n"; };
    number("width", layout.width);
    number("height", layout.height);
    number("padding", layout.padding);
    number("alignment", layout.alignment);
    number("alignmentOffset", layout.alignmentOffset);
    if (!layout.photoFolder.empty())
    {
        text += "\"photoFolder\": " + json(layout.photoFolder).dump() + ",\n";
    }
    if (!layout.pending.empty() || !layout.pendingSince.empty())
    {
        text += "\"pending\": " + toJson(layout.pending).dump() + ",\n";
        text += "\"pendingSince\": " + json(layout.pendingSince).dump() + ",\n";
    }
    return text + "\"photographs\": [";
}

/// Gathers text and writes it in large pieces.
class Output
{
public:
    explicit Output(const std::string& path) : _file(path, StoreFile::Mode::Create) {}
    void add(const std::string& text)
    {
        _text += text;
        if (_text.size() > (1 << 20))
        {
            flush();
        }
    }
    void finish(const std::string& path)
    {
        flush();
        _file.sync();
        _file.moveTo(path, true);
    }

private:
    void flush()
    {
        _file.write(_text.data(), _text.size(), _bytes);
        _bytes += _text.size();
        _text.clear();
    }
    StoreFile _file;
    std::string _text;
    std::uint64_t _bytes = 0;
};

/// The members of an object, each asked for by its name and type.
class Members
{
public:
    Members(const std::string& file, const json& object, const std::string& owner)
        : _file(file), _object(object), _owner(owner)
    {
    }
    std::int64_t number(const char* name, std::int64_t least, std::int64_t most) const
    {
        const json& value = find(name);
        if (!value.is_number_integer() ||
            (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(most)) ||
            value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
        {
            damaged(_file, _owner + " has no " + name + " that is a whole number from " +
                               std::to_string(least) + " to " + std::to_string(most));
        }
        return value.get<std::int64_t>();
    }
    std::string word(const char* name) const
    {
        const json& value = find(name);
        if (!value.is_string())
        {
            damaged(_file, _owner + " has no text " + name);
        }
        return value.get<std::string>();
    }
    std::vector<PixelRect> rects(const char* name) const
    {
        std::vector<PixelRect> rects;
        for (const json& value : has(name) ? find(name) : json::array())
        {
            rects.push_back(rect(name, value));
        }
        return rects;
    }
    bool has(const char* name) const { return _object.contains(name); }

private:
    const json& find(const char* name) const
    {
        static const json nothing;
        const auto found = _object.find(name);
        return found == _object.end() ? nothing : *found;
    }
    PixelRect rect(const char* name, const json& value) const
    {
        const bool numbers =
            value.is_array() && value.size() == 4 &&
            std::all_of(value.begin(), value.end(),
                        [](const json& each) {
                            return each.is_number_integer() &&
                                   std::abs(each.get<double>()) <= double(TileGrid::MaxSide);
                        });
        if (!numbers)
        {
            damaged(_file,
                    _owner + " has in " + name + " something else than [x, y, width, height]");
        }
        return {value[0], value[1], value[2], value[3]};
    }

    const std::string& _file;
    const json& _object;
    const std::string _owner;
};

AtlasPhoto photoOf(const std::string& file, const json& object, std::size_t number)
{
    if (!object.is_object())
    {
        damaged(file, "photograph " + std::to_string(number) + " is no object");
    }
    const Members members(file, object, "photograph " + std::to_string(number));
    constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
    AtlasPhoto photo;
    photo.path = members.word("path");
    photo.width = int(members.number("width", 1, std::numeric_limits<int>::max()));
    photo.height = int(members.number("height", 1, std::numeric_limits<int>::max()));
    photo.x = members.number("x", -TileGrid::MaxSide, TileGrid::MaxSide);
    photo.y = members.number("y", -TileGrid::MaxSide, TileGrid::MaxSide);
    photo.bytes = std::uint64_t(members.number("bytes", 0, any));
    photo.modified = members.number("modified", 0, any);
    photo.hash = members.word("hash");
    photo.used = members.rects("used");
    return photo;
}

void readHead(const std::string& path, const json& object, AtlasLayout& layout)
{
    if (!object.is_object() || !object.contains("format") || object["format"] != Format)
    {
        damaged(path, std::string("is no atlas layout, or of another version than '") + Format +
                          "'; make the layout anew");
    }
    const Members members(path, object, "the layout");
    layout.width = members.number("width", 1, TileGrid::MaxSide);
    layout.height = members.number("height", 1, TileGrid::MaxSide);
    layout.padding = int(members.number("padding", 0, 65536));
    layout.alignment = int(members.number("alignment", 1, 4096));
    layout.alignmentOffset = int(members.number("alignmentOffset", 0, layout.alignment - 1));
    layout.photoFolder = members.has("photoFolder") ? members.word("photoFolder") : "";
    layout.pending = members.rects("pending");
    layout.pendingSince = members.has("pendingSince") ? members.word("pendingSince") : "";
    if (!object.contains("photographs") || !object["photographs"].is_array())
    {
        damaged(path, "has no list photographs; make the layout anew");
    }
}

std::string readAll(const std::string& path)
{
    const StoreFile file(path, StoreFile::Mode::Read);
    std::string text(file.getBytes(), '\0');
    text.resize(file.readSome(text.data(), text.size(), 0));
    return text;
}

} // namespace

struct AtlasLock::Content : StoreLock
{
    using StoreLock::StoreLock;
};

AtlasLock::AtlasLock(const std::string& layoutPath, double waitSeconds)
    : _content(std::make_unique<Content>(layoutPath, waitSeconds))
{
}

AtlasLock::~AtlasLock() = default;

void writeAtlasLayout(const std::string& path, const AtlasLayout& layout)
{
    const std::string part = path + ".part";
    try
    {
        Output output(part);
        output.add(headOf(layout));
        const char* separator = "\n";
        for (const AtlasPhoto& photo : layout.photos)
        {
            output.add(separator + lineOf(photo));
            separator = ",\n";
        }
        output.add("\n]}\n");
        output.finish(path);
    }
    catch (const TileStoreError&)
    {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw;
    }
}

AtlasLayout readAtlasLayout(const std::string& path)
{
    AtlasLayout layout;
    std::string listName;
    // Photographs are taken as they are met, so that a million of them are never all JSON.
    const auto take = [&](int depth, json::parse_event_t event, json& value)
    {
        if (depth == 1 && event == json::parse_event_t::key)
        {
            listName = value.get<std::string>();
        }
        if (depth != 2 || listName != "photographs" || event != json::parse_event_t::object_end)
        {
            return true;
        }
        layout.photos.push_back(photoOf(path, value, layout.photos.size() + 1));
        return false;
    };
    try
    {
        readHead(path, json::parse(readAll(path), take), layout);
        checkAtlas(layout);
    }
    catch (const json::exception& error)
    {
        damaged(path, std::string("is no JSON: ") + error.what());
    }
    return layout;
}

} // namespace osgPagedTexture
