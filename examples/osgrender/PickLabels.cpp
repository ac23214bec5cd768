// SPDX-License-Identifier: MIT
// What Pick asks osgLabels.
#include "Pick.h"

#include <osgLabels/LabelScene.h>

#include <osg/NodeVisitor>

namespace osgrender
{

namespace
{

using osgLabels::LabelScene;

class SceneFinder : public osg::NodeVisitor
{
public:
    SceneFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Group& group) override
    {
        if (auto* scene = dynamic_cast<LabelScene*>(&group))
            scenes.push_back(scene);
        traverse(group);
    }

    std::vector<LabelScene*> scenes;
};

std::vector<LabelScene*> scenesOf(osg::Node& model)
{
    SceneFinder finder;
    model.accept(finder);
    return finder.scenes;
}

} // namespace

bool askLabels(osg::Node& model, const PickPoint& point, int width, int height, std::string& error)
{
    const std::vector<LabelScene*> scenes = scenesOf(model);
    if (scenes.empty())
        error = "--pick needs labels: 'model.iv.labels'";
    for (LabelScene* scene : scenes)
        scene->pick((2 * point.x + 1) / double(width) - 1.0,
                    (2 * point.y + 1) / double(height) - 1.0);
    return error.empty();
}

std::vector<PickResult> takeAnswers(osg::Node& model, const PickPoint& point)
{
    std::vector<PickResult> results;
    for (LabelScene* scene : scenesOf(model))
        if (const auto picked = scene->takePicked(); picked && picked->identifier)
            results.push_back({point, picked->identifier, picked->text, picked->path});
    if (results.empty())
        results.push_back({point, 0, {}, {}});
    return results;
}

} // namespace osgrender
