// SPDX-License-Identifier: MIT
#include <osgLabels/LabelSource.h>

#include <osg/Geode>
#include <osg/ValueObject>

#include <algorithm>
#include <sstream>

namespace osgLabels
{

namespace
{

/// std::regex recurses once a character: a name may not exhaust the stack.
constexpr std::size_t longestMatched = 1024;

template <typename T>
bool addValue(const osg::Object& object, const std::string& name, std::string& text)
{
    T value{};
    if (!object.getUserValue(name, value))
        return false;
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream << std::boolalpha << value;
    text = stream.str();
    return true;
}

std::optional<std::string> userValue(const osg::Object& object, const std::string& name)
{
    std::string text;
    if (!object.getUserDataContainer() ||
        !(addValue<std::string>(object, name, text) || addValue<bool>(object, name, text) ||
          addValue<int>(object, name, text) || addValue<unsigned int>(object, name, text) ||
          addValue<float>(object, name, text) || addValue<double>(object, name, text)))
        return std::nullopt;
    return text;
}

/// What Inventor's reader does: a Geode takes the name of its StateSet, which is its texture's.
bool isTextureName(const osg::Geode& geode)
{
    for (unsigned int i = 0; i < geode.getNumDrawables(); ++i)
    {
        const osg::Drawable* drawable = geode.getDrawable(i);
        if (drawable && drawable->getName().empty() && drawable->getStateSet() &&
            drawable->getStateSet()->getName() == geode.getName())
            return true;
    }
    return false;
}

/// The label of path[depth], with its style; none where its text is empty.
std::optional<LabelSource::Found> styled(const TableLabel& label, const osg::NodePath& path,
                                         std::size_t depth)
{
    if (label.text.empty())
        return std::nullopt;
    LabelSource::Found found{label.text, depth, label.style};
    if (!found.style.empty())
        return found;
    for (std::size_t i = std::min(depth + 1, path.size()); i-- > 0;)
        if (path[i]->getUserDataContainer() &&
            path[i]->getUserValue(LabelSource::StyleValue, found.style))
            break;
    return found;
}

} // namespace

std::shared_ptr<const LabelSource> LabelSource::create(const LabelSourceSettings& settings,
                                                       std::string& error)
{
    std::shared_ptr<LabelSource> source(new LabelSource);
    source->_settings = settings;
    error.clear();
    if (!settings.format.empty() && (settings.match.empty() || settings.from != LabelFrom::NAME))
    {
        error = "osgLabels::LabelSource: format=" + settings.format +
                " needs match and from=name: it is made of what matched in the name";
        return nullptr;
    }
    try
    {
        source->_match.assign(settings.match);
    }
    catch (const std::regex_error& cause)
    {
        error = "osgLabels::LabelSource: match=" + settings.match +
                " is no ECMAScript regular expression (" + cause.what() +
                "); escape ( [ { * + ? . by a backslash where they are meant as such";
        return nullptr;
    }
    if (settings.from == LabelFrom::TABLE)
    {
        std::string cause;
        if (settings.table.empty())
            cause = "from=table needs table=<file>.csv or .json";
        else
            readLabelFile(settings.table, source->_texts, cause);
        if (!cause.empty())
        {
            error = "osgLabels::LabelSource: " + cause;
            return nullptr;
        }
    }
    return source;
}

bool LabelSource::hasName(const osg::Node& node)
{
    const std::string& name = node.getName();
    if (name.find_first_not_of(" \t\r\n") == std::string::npos || name == node.className())
        return false;
    return !node.asGeode() || !isTextureName(*node.asGeode());
}

std::optional<std::string> LabelSource::formatted(const std::string& name) const
{
    if (_settings.match.empty())
        return name;
    std::smatch parts;
    const auto end =
        name.begin() + static_cast<std::ptrdiff_t>(std::min(name.size(), longestMatched));
    if (!std::regex_search(name.begin(), end, parts, _match))
        return std::nullopt;
    return _settings.format.empty() ? name : parts.format(_settings.format);
}

std::optional<TableLabel> LabelSource::inTable(const std::string& name) const
{
    const auto found = _texts.find(name);
    return found == _texts.end() ? std::nullopt : std::make_optional(found->second);
}

std::optional<TableLabel> LabelSource::labelOf(const osg::Node& node) const
{
    const auto labelled = [](const std::optional<std::string>& text) {
        return text ? std::make_optional(TableLabel{*text, {}}) : std::nullopt;
    };
    const bool isNamed = hasName(node);
    const bool needsName = _settings.from == LabelFrom::NAME ||
                           _settings.from == LabelFrom::TABLE || !_settings.match.empty();
    if (needsName && !isNamed)
        return std::nullopt;
    const std::optional<std::string> text = needsName ? formatted(node.getName()) : std::string();
    if (!text || _settings.from == LabelFrom::NAME)
        return labelled(text);
    if (_settings.from == LabelFrom::VALUE)
        return labelled(userValue(node, _settings.value));
    if (_settings.from == LabelFrom::TABLE)
        return inTable(node.getName());
    const auto& descriptions = node.getDescriptions();
    const auto first = std::find_if(descriptions.begin(), descriptions.end(),
                                    [](const std::string& line) { return !line.empty(); });
    return first == descriptions.end() ? std::nullopt : labelled(*first);
}

std::optional<LabelSource::Found> LabelSource::ofName(const std::string& name,
                                                      const osg::NodePath& path) const
{
    if (name.empty() || (_settings.from != LabelFrom::NAME && _settings.from != LabelFrom::TABLE))
        return std::nullopt;
    const std::optional<std::string> text = formatted(name);
    const std::optional<TableLabel> label = text && _settings.from == LabelFrom::TABLE
                                                ? inTable(name)
                                            : text ? std::make_optional(TableLabel{*text, {}})
                                                   : std::nullopt;
    return label ? styled(*label, path, path.size() - 1) : std::nullopt;
}

std::optional<LabelSource::Found> LabelSource::find(const osg::NodePath& path) const
{
    for (std::size_t depth = path.size(); depth-- > 0;)
        if (const auto label = labelOf(*path[depth]))
            return styled(*label, path, depth);
    return std::nullopt;
}

} // namespace osgLabels
