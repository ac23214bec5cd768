// SPDX-License-Identifier: MIT
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelScene.h>
#include <osgMultiRender/PseudoLoader.h>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

/// "model.iv.labels": shows the objects' names on their surfaces.
class ReaderWriterLabels : public osgMultiRender::PseudoLoader
{
public:
    ReaderWriterLabels()
        : PseudoLoader("labels", "Text on the surfaces of objects: model.ext.[(settings).]labels")
    {
        const osgLabels::LabelSettings defaults;
        for (const osgLabels::LabelOption& option : osgLabels::labelOptions())
        {
            const std::string value = option.format(defaults);
            supportsOption("labels." + option.name + "=" + option.values,
                           option.help + (value.empty() ? "" : " (default " + value + ")"));
        }
    }

    const char* className() const override { return "osgLabels pseudo-loader"; }

protected:
    osg::ref_ptr<osg::Node> wrap(osg::Node& model, const osgMultiRender::Settings& settings,
                                 std::string& error) const override
    {
        return wrapIn({}, model, settings, error);
    }

    osg::ref_ptr<osg::Node> wrapIn(const std::string& folder, osg::Node& model,
                                   const osgMultiRender::Settings& settings,
                                   std::string& error) const override
    {
        osgLabels::LabelSettings parsed;
        for (const auto& [name, value] : settings)
            if (!setLabelOption(parsed, name, value, error))
                return nullptr;
        if (!findMap(folder, parsed.map, error))
            return nullptr;
        osg::ref_ptr<osgLabels::LabelScene> scene = new osgLabels::LabelScene;
        // The viewer's optimizer must not remove or merge the group.
        scene->setDataVariance(osg::Object::DYNAMIC);
        scene->setSettings(parsed);
        scene->addChild(&model);
        return scene;
    }

private:
    /// Makes the name of a file of labels one that is found from anywhere: it lies beside the
    /// model, or on OSG's data path.
    static bool findMap(const std::string& folder, std::string& map, std::string& error)
    {
        if (map == "off" || map == "values")
            return true;
        const std::string beside = osgDB::concatPaths(folder, map);
        const std::string found = osgDB::fileExists(beside) ? beside : osgDB::findDataFile(map);
        if (found.empty())
            error = "setting 'map=" + map + "': there is no such file, neither beside the model" +
                    (folder.empty() ? "" : " in '" + folder + "'") +
                    " nor on OSG_FILE_PATH; map=off does without";
        else
            map = found;
        return !found.empty();
    }
};

REGISTER_OSGPLUGIN(labels, ReaderWriterLabels)
