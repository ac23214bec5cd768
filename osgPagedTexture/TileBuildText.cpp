// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileBuildText.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace osgPagedTexture
{

namespace
{

using nlohmann::json;

/// The words of a member and what they stand for.
template <class Value> struct Word
{
    const char* text;
    Value value;
};

constexpr Word<TileCoding> Codings[] = {{"jpg", TileCoding::Jpeg},
                                        {"png", TileCoding::Png},
                                        {"bc1", TileCoding::Bc1},
                                        {"bc3", TileCoding::Bc3},
                                        {"bc7", TileCoding::Bc7}};
constexpr Word<ChromaSampling> Samplings[] = {{"4:4:4", ChromaSampling::Full},
                                              {"4:2:2", ChromaSampling::Half},
                                              {"4:2:0", ChromaSampling::Quarter}};
constexpr Word<EncodeQuality> Qualities[] = {{"fast", EncodeQuality::Fast},
                                             {"normal", EncodeQuality::Normal},
                                             {"fine", EncodeQuality::Fine},
                                             {"best", EncodeQuality::Best}};
constexpr Word<TileGrid::Edge> Edges[] = {{"padded", TileGrid::Edge::Padded},
                                          {"clipped", TileGrid::Edge::Clipped}};
constexpr Word<bool> Filters[] = {{"linear", true}, {"plain", false}};

template <class Value, std::size_t Count>
const char* textOf(const Word<Value> (&words)[Count], Value value)
{
    return std::find_if(std::begin(words), std::end(words),
                        [value](const Word<Value>& word) { return word.value == value; })
        ->text;
}

[[noreturn]] void refuse(const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused, "osgPagedTexture::TileBuilder: " + what);
}

/// Members of the object, each taken where it is there.
class Reader
{
public:
    explicit Reader(const std::string& text) : _object(json::parse(text, nullptr, false))
    {
        if (!_object.is_object())
        {
            refuse("the settings are no JSON object");
        }
    }

    void number(const char* name, int least, int most, int& value) const
    {
        if (const json* member = find(name))
        {
            value = numberOf(*member, name, least, most);
        }
    }
    template <class Value, std::size_t Count>
    void word(const char* name, const Word<Value> (&words)[Count], Value& value) const
    {
        const json* member = find(name);
        if (!member)
        {
            return;
        }
        std::string known;
        for (const Word<Value>& each : words)
        {
            if (*member == each.text)
            {
                value = each.value;
                return;
            }
            known += known.empty() ? each.text : std::string(", ") + each.text;
        }
        refuse(std::string(name) + " must be one of " + known + ", not " + member->dump());
    }
    void flag(const char* name, bool& value) const
    {
        const json* member = find(name);
        if (member && !member->is_boolean())
        {
            refuse(std::string(name) + " must be true or false, not " + member->dump());
        }
        value = member ? member->get<bool>() : value;
    }
    void color(const char* name, TileColor& value) const
    {
        const json* member = find(name);
        if (!member)
        {
            return;
        }
        if (!member->is_array() || member->size() < 3 || member->size() > 4)
        {
            refuse(std::string(name) + " must be [red, green, blue] or with alpha");
        }
        value[3] = 255;
        for (std::size_t i = 0; i < member->size(); ++i)
        {
            value[i] = static_cast<std::uint8_t>(numberOf((*member)[i], name, 0, 255));
        }
    }

private:
    const json* find(const char* name) const
    {
        const auto member = _object.find(name);
        return member == _object.end() ? nullptr : &*member;
    }
    static int numberOf(const json& member, const char* name, int least, int most)
    {
        const double value = member.is_number_integer() ? member.get<double>() : least - 1.0;
        if (value < least || value > most)
        {
            refuse(std::string(name) + " must be a whole number from " + std::to_string(least) +
                   " to " + std::to_string(most) + ", not " + member.dump());
        }
        return static_cast<int>(value);
    }

    const json _object;
};

} // namespace

std::string describeBuild(const TileBuildSettings& settings)
{
    const TileColor& background = settings.background;
    nlohmann::ordered_json text;
    text["tileSide"] = settings.tileSide;
    text["border"] = settings.border;
    text["edge"] = textOf(Edges, settings.edge);
    text["format"] = textOf(Codings, settings.format.coding);
    text["quality"] = settings.format.quality;
    text["subsampling"] = textOf(Samplings, settings.format.chroma);
    text["compression"] = settings.format.compression;
    text["blockQuality"] = textOf(Qualities, settings.format.blocks);
    text["channels"] = settings.channels;
    text["filter"] = textOf(Filters, settings.linearLight);
    text["lossless"] = settings.lossless;
    text["background"] = {background[0], background[1], background[2], background[3]};
    return text.dump();
}

TileBuildSettings parseBuild(const std::string& text)
{
    TileBuildSettings settings;
    const Reader reader(text);
    reader.number("tileSide", 1, 65536, settings.tileSide);
    reader.number("border", 0, 4096, settings.border);
    reader.word("edge", Edges, settings.edge);
    reader.word("format", Codings, settings.format.coding);
    reader.number("quality", 1, 100, settings.format.quality);
    reader.word("subsampling", Samplings, settings.format.chroma);
    reader.number("compression", 0, 9, settings.format.compression);
    reader.word("blockQuality", Qualities, settings.format.blocks);
    reader.number("channels", 1, 4, settings.channels);
    reader.word("filter", Filters, settings.linearLight);
    reader.flag("lossless", settings.lossless);
    reader.color("background", settings.background);
    return settings;
}

} // namespace osgPagedTexture
