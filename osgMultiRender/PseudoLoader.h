// SPDX-License-Identifier: MIT
#pragma once

#include <osgMultiRender/Export.h>

#include <osgDB/ReaderWriter>

#include <map>
#include <string>

namespace osgMultiRender
{

/// Settings of a kit, as key and value.
using Settings = std::map<std::string, std::string>;

/// Splits "file.ext" or "file.ext.(parameters)" off a pseudo-loader's suffix.
///
/// `name` is the file name without the suffix: "cow.osg.(shadows=off)". Parameters exist only if
/// the last component is a balanced round or square bracket preceded by a dot; a file name that
/// merely ends in a bracket is left alone.
OSGMULTIRENDER_EXPORT void splitPseudoName(const std::string& name, std::string& file,
                                           std::string& parameters);

/// Parses "a=b,c='d,e',flag": comma or space separated; a value may be quoted with ' or ", and a
/// bracketed part keeps its commas and spaces. A key without "=" has the value "true". Keys are
/// lowercased. Returns false and fills `error` with the cause and the position on a broken quote,
/// bracket or empty key.
OSGMULTIRENDER_EXPORT bool parseSettings(const std::string& text, Settings& settings,
                                         std::string& error);

/// The settings of an option string ("shadowvolume.lighting=pixel labels.size=0.3") whose keys
/// start with "<kit>.", without that prefix. Words of other kits and plugins are ignored.
OSGMULTIRENDER_EXPORT bool settingsOfKit(const std::string& optionString, const std::string& kit,
                                         Settings& settings, std::string& error);

/// A ReaderWriter for "model.ext.<suffix>": reads the model with whatever reads it and puts a kit's
/// Group over it.
///
/// Settings in parentheses override those of the option string. The inner ReadResult is returned
/// unchanged when the model can't be read; unknown settings are an ERROR_IN_READING_FILE that names
/// the known ones.
class OSGMULTIRENDER_EXPORT PseudoLoader : public osgDB::ReaderWriter
{
public:
    explicit PseudoLoader(const std::string& suffix, const std::string& description);

    ReadResult readObject(const std::string& file, const Options* options) const override;
    ReadResult readNode(const std::string& file, const Options* options) const override;

protected:
    /// Reads what stands before the suffix; with whatever reads nodes.
    virtual ReadResult readModel(const std::string& file, const Options* options) const;
    /// Puts the kit over `model`. Returns null and fills `error` when a setting is wrong.
    virtual osg::ref_ptr<osg::Node> wrap(osg::Node& model, const Settings& settings,
                                         std::string& error) const = 0;
    /// Of a kit whose settings name files, which may lie in the model's folder ("" for the current
    /// one): calls the other one unless it is overridden.
    virtual osg::ref_ptr<osg::Node> wrapIn(const std::string& folder, osg::Node& model,
                                           const Settings& settings, std::string& error) const;

private:
    std::string _suffix;
};

} // namespace osgMultiRender
