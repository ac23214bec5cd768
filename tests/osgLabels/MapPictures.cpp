// SPDX-License-Identifier: MIT
#include "MapPictures.h"

namespace mapScene
{

const char* const RedPlate = "ink=#ff0000,plate=#ff0000,declutter=off";

void MapTest::TearDown()
{
    if (labelScene::viewer().isValid())
        labelScene::viewer().setSimulationTime(0.0);
}

osg::ref_ptr<osgLabels::MapLabels> label(const std::string& text, const osg::Vec3d& anchor,
                                         const std::string& feature, double priority)
{
    return new osgLabels::MapLabels({{anchor, text, priority, {}, feature}});
}

osg::ref_ptr<osgLabels::LabelScene> scene(const std::vector<osg::ref_ptr<osg::Node>>& nodes,
                                          const std::string& settings)
{
    const auto scene = labelScene::labelled(nullptr, "surface=off," + std::string(RedPlate) +
                                                         (settings.empty() ? "" : ",") + settings);
    for (const osg::ref_ptr<osg::Node>& node : nodes)
        scene->addChild(node);
    return scene;
}

int redPixels(const osg::Image& picture)
{
    return redPixels(picture, 0, picture.s());
}

int redPixels(const osg::Image& picture, int first, int last)
{
    int count = 0;
    for (int y = 0; y < picture.t(); ++y)
        for (int x = first; x < last; ++x)
        {
            const osg::Vec4 color = picture.getColor(unsigned(x), unsigned(y));
            count += color.r() > 0.9f && color.g() < 0.1f && color.b() < 0.1f;
        }
    return count;
}

osg::Vec2d pixelOf(const osg::Vec3d& point, const support::CameraSpec& camera)
{
    const osg::Vec3d ndc = point * (camera.view * camera.projection);
    return {(0.5 + 0.5 * ndc.x()) * labelScene::Width, (0.5 + 0.5 * ndc.y()) * labelScene::Height};
}

osg::ref_ptr<osg::Geode> sheet(const std::string& name, const osg::Vec3& corner,
                               const osg::Vec3& width, const osg::Vec3& height,
                               const osg::Vec4& color)
{
    return labelScene::named(name, labelScene::rectangle(corner, width, height, color));
}

} // namespace mapScene
