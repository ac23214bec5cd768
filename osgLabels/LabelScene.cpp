// SPDX-License-Identifier: MIT
#include <osgLabels/LabelScene.h>

#include <osgLabels/DrawableFit.h>
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelPass.h>
#include <osgLabels/LabelResources.h>

#include <osg/Notify>

namespace osgLabels
{

LabelScene::LabelScene() = default;

LabelScene::LabelScene(const LabelScene& other, const osg::CopyOp& copyop)
    : osgMultiRender::SurfaceGroup(other, copyop), _settings(other._settings)
{
}

LabelScene::~LabelScene() = default;

bool LabelScene::setText(std::uint32_t identifier, const std::string& text)
{
    return _resources && _resources->setText(identifier, text);
}

void LabelScene::setSettings(const LabelSettings& settings)
{
    _settings = settings;
    _resources.reset();
}

void LabelScene::setSettingsText(const std::string& text)
{
    LabelSettings settings;
    std::string error;
    if (!parseLabelOptions(settings, text, error))
        OSG_WARN << "osgLabels::LabelScene: " << error << "; the defaults count" << std::endl;
    setSettings(settings);
}

std::string LabelScene::getSettingsText() const
{
    return formatLabelOptions(_settings);
}

namespace
{
class Interim : public osg::NodeVisitor
{
public:
    Interim(LabelScene& s) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), scene(s) {}
    void apply(osg::Drawable& drawable) override
    {
        ObjectRecord r = fitDrawable(drawable).record(last + 1);
        std::string name;
        for (auto i = getNodePath().rbegin(); i != getNodePath().rend() && name.empty(); ++i)
            name = (*i)->getName();
        r.identifier = ++last;
        scene.setText(last, name.empty() ? "unnamed" : name);
        scene.getResources()->objects.add(drawable, r);
    }
    LabelScene& scene;
    std::uint32_t last = 0;
};
} // namespace

void LabelScene::traverse(osg::NodeVisitor& visitor)
{
    if (!_resources && visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR)
    {
        _resources = std::make_shared<LabelResources>(_settings);
        Interim i(*this);
        for (unsigned int c = 0; c < getNumChildren(); ++c)
            getChild(c)->accept(i);
    }
    osgMultiRender::SurfaceGroup::traverse(visitor);
}

void LabelScene::releaseGLObjects(osg::State* state) const
{
    osgMultiRender::SurfaceGroup::releaseGLObjects(state);
    if (_resources)
        _resources->releaseGLObjects(state);
}

std::unique_ptr<osgMultiRender::SurfacePass> LabelScene::createPass() const
{
    return std::make_unique<LabelPass>(*this);
}

} // namespace osgLabels
