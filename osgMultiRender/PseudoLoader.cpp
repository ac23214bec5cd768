// SPDX-License-Identifier: MIT
#include <osgMultiRender/PseudoLoader.h>

#include <osg/Node>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <cctype>

namespace osgMultiRender
{

namespace
{

bool isOpening(char c)
{
    return c == '(' || c == '[';
}

bool isClosing(char c)
{
    return c == ')' || c == ']';
}

std::string lowered(std::string text)
{
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Cuts text at commas and white space outside of quotes and brackets. Quotes stay in the words.
bool splitWords(const std::string& text, std::vector<std::string>& words, std::string& error)
{
    std::string word;
    char quote = 0;
    int depth = 0;
    std::size_t opened = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const char c = text[i];
        if (quote)
            quote = c == quote ? 0 : quote;
        else if (c == '\'' || c == '"')
            quote = c, opened = i;
        else if (isOpening(c))
            opened = depth++ ? opened : i;
        else if (isClosing(c) && --depth < 0)
        {
            error = "closing bracket without an opening one at character " + std::to_string(i + 1) +
                    " of '" + text + "'";
            return false;
        }
        if (!quote && depth == 0 && (c == ',' || std::isspace(static_cast<unsigned char>(c))))
        {
            if (!word.empty())
                words.push_back(word);
            word.clear();
        }
        else
            word += c;
    }
    if (quote || depth)
    {
        error = std::string(quote ? "quote" : "bracket") + " that opens at character " +
                std::to_string(opened + 1) + " of '" + text + "' is not closed";
        return false;
    }
    if (!word.empty())
        words.push_back(word);
    return true;
}

/// Takes quotes away as a shell does: 'it'"'"'s' is it's.
std::string unquoted(const std::string& word)
{
    std::string text;
    char quote = 0;
    for (const char c : word)
    {
        if (quote ? c == quote : (c == '\'' || c == '"'))
            quote = quote ? 0 : c;
        else
            text += c;
    }
    return text;
}

} // namespace

void splitPseudoName(const std::string& name, std::string& file, std::string& parameters)
{
    file = name;
    parameters.clear();
    if (name.empty() || !isClosing(name.back()))
        return;
    int depth = 0;
    for (std::size_t i = name.size(); i-- > 0;)
    {
        if (isClosing(name[i]))
            ++depth;
        else if (isOpening(name[i]) && --depth == 0)
        {
            if (i > 0 && name[i - 1] == '.')
            {
                parameters = name.substr(i + 1, name.size() - i - 2);
                file = name.substr(0, i - 1);
            }
            return;
        }
    }
}

bool parseSettings(const std::string& text, Settings& settings, std::string& error)
{
    std::vector<std::string> words;
    if (!splitWords(text, words, error))
        return false;
    for (const std::string& word : words)
    {
        const std::size_t equals = word.find('=');
        const std::string key = lowered(word.substr(0, equals));
        if (key.empty())
        {
            error = "setting without a name in '" + word + "'";
            return false;
        }
        settings[key] = equals == std::string::npos ? "true" : unquoted(word.substr(equals + 1));
    }
    return true;
}

bool settingsOfKit(const std::string& optionString, const std::string& kit, Settings& settings,
                   std::string& error)
{
    // Words of other plugins need not follow our quoting: only ours are looked at.
    if (lowered(optionString).find(kit + ".") == std::string::npos)
        return true;
    Settings all;
    if (!parseSettings(optionString, all, error))
        return false;
    const std::string prefix = kit + ".";
    for (const auto& [key, value] : all)
        if (key.compare(0, prefix.size(), prefix) == 0)
            settings[key.substr(prefix.size())] = value;
    return true;
}

PseudoLoader::PseudoLoader(const std::string& suffix, const std::string& description)
    : _suffix(suffix)
{
    supportsExtension(suffix, description);
}

osg::ref_ptr<osg::Node> PseudoLoader::wrapIn(const std::string&, osg::Node& model,
                                             const Settings& settings, std::string& error) const
{
    return wrap(model, settings, error);
}

osgDB::ReaderWriter::ReadResult PseudoLoader::readObject(const std::string& file,
                                                         const Options* options) const
{
    return readNode(file, options);
}

osgDB::ReaderWriter::ReadResult PseudoLoader::readModel(const std::string& file,
                                                        const Options* options) const
{
    return osgDB::Registry::instance()->readNode(file, options);
}

osgDB::ReaderWriter::ReadResult PseudoLoader::readNode(const std::string& file,
                                                       const Options* options) const
{
    if (!acceptsExtension(osgDB::getLowerCaseFileExtension(file)))
        return ReadResult::FILE_NOT_HANDLED;

    std::string model, parameters, error;
    splitPseudoName(osgDB::getNameLessExtension(file), model, parameters);
    if (model.empty())
        return ReadResult(_suffix + ": no model before the suffix in '" + file + "'");
    Settings settings;
    if (!settingsOfKit(options ? options->getOptionString() : std::string(), _suffix, settings,
                       error) ||
        !parseSettings(parameters, settings, error))
        return ReadResult(_suffix + ": " + error);

    ReadResult result = readModel(model, options);
    if (!result.validNode())
        return result;
    osg::ref_ptr<osg::Node> node = result.getNode();
    const std::string found = osgDB::findDataFile(model, options);
    osg::ref_ptr<osg::Node> wrapped =
        wrapIn(osgDB::getFilePath(found.empty() ? model : found), *node, settings, error);
    if (!wrapped)
        return ReadResult(_suffix + ": " + error);
    return wrapped.get();
}

} // namespace osgMultiRender
