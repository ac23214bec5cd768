// SPDX-License-Identifier: MIT
#include <osgLabels/LabelScene.h>

#include <osgLabels/LabelKeys.h>
#include <osgLabels/LabelOptions.h>
#include <osgLabels/LabelPass.h>
#include <osgLabels/LabelResources.h>

#include <osg/Notify>
#include <osgGA/EventVisitor>

namespace osgLabels
{

namespace
{

/// Whether settings differ in nothing that labels are collected by.
bool isKept(const LabelSettings& was, LabelSettings is)
{
    is.mapSize = was.mapSize;
    is.mapWorld = was.mapWorld;
    is.mapOffset = was.mapOffset;
    is.mapDepth = was.mapDepth;
    is.mapAction = was.mapAction;
    is.mapTest = was.mapTest;
    is.mapLeader = was.mapLeader;
    is.mapFade = was.mapFade;
    is.mapColor = was.mapColor;
    is.declutter = was.declutter;
    is.keys = was.keys;
    return formatLabelOptions(is) == formatLabelOptions(was);
}

} // namespace

LabelScene::LabelScene()
{
    // So that parents lead event visitors here; not for children, which have their own.
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

LabelScene::LabelScene(const LabelScene& other, const osg::CopyOp& copyop)
    : osgMultiRender::SurfaceGroup(other, copyop), _settings(other._settings),
      _isShown(other._isShown)
{
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

LabelScene::~LabelScene() = default;

bool LabelScene::setText(std::uint32_t identifier, const std::string& text)
{
    const std::shared_ptr<LabelResources> resources = getResources();
    return resources && resources->setText(identifier, text);
}

std::string LabelScene::getText(std::uint32_t identifier) const
{
    const std::shared_ptr<LabelResources> resources = getResources();
    return resources ? resources->getText(identifier) : std::string();
}

bool LabelScene::setStyle(std::uint32_t identifier, const std::string& name)
{
    const std::shared_ptr<LabelResources> resources = getResources();
    return resources && resources->setStyle(identifier, name);
}

std::string LabelScene::getStyle(std::uint32_t identifier) const
{
    const std::shared_ptr<LabelResources> resources = getResources();
    return resources ? resources->getStyle(identifier) : LabelStyle::DefaultName;
}

void LabelScene::pick(double x, double y, const osg::Camera* camera, PickAsker asker)
{
    LabelPick& pick = (*_picks)[asker];
    pick.ask({x, y, camera});
    if (!_isShown && pick.take(camera, true))
        pick.answer({});
}

std::optional<LabelScene::Picked> LabelScene::takePicked(PickAsker asker)
{
    const std::optional<LabelPick::Answer> answer = (*_picks)[asker].takeAnswer();
    if (!answer)
        return std::nullopt;
    if (!answer->resources)
        return Picked{};
    return Picked{answer->identifier, answer->resources->getText(answer->identifier),
                  answer->resources->getPath(*this, answer->identifier)};
}

void LabelScene::setSettings(const LabelSettings& settings)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!isKept(_settings, settings))
        _resources.reset();
    _settings = settings;
}

void LabelScene::setSettingsText(const std::string& text)
{
    LabelSettings settings;
    for (const std::string& error : parseLabelOptions(settings, text))
        OSG_WARN << "osgLabels::LabelScene: " << error << "; it does not count" << std::endl;
    setSettings(settings);
}

std::string LabelScene::getSettingsText() const
{
    return formatLabelOptions(_settings);
}

std::shared_ptr<LabelResources> LabelScene::getResources() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _resources;
}

void LabelScene::collect()
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_resources)
        _resources = std::make_shared<LabelResources>(_settings, *this);
    else
        _resources->sweep(*this);
}

void LabelScene::traverse(osg::NodeVisitor& visitor)
{
    if (visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR && _isShown)
        collect();
    else if (auto* events = dynamic_cast<osgGA::EventVisitor*>(&visitor); events && _settings.keys)
        answerKeys(*this, *events);
    osgMultiRender::SurfaceGroup::traverse(visitor);
}

void LabelScene::releaseGLObjects(osg::State* state) const
{
    osgMultiRender::SurfaceGroup::releaseGLObjects(state);
    if (const std::shared_ptr<LabelResources> resources = getResources())
        resources->releaseGLObjects(state);
}

void LabelScene::cullSubgraph(osg::NodeVisitor& visitor)
{
    const std::shared_ptr<LabelResources> resources = getResources();
    if (resources && resources->getChunks())
        resources->getChunks()->accept(visitor);
    else
        osgMultiRender::SurfaceGroup::cullSubgraph(visitor);
    if (resources && resources->map)
        resources->map->cull(visitor);
}

std::unique_ptr<osgMultiRender::SurfacePass> LabelScene::createPass() const
{
    return std::make_unique<LabelPass>(_isShown ? getResources() : nullptr, _picks, _settings);
}

} // namespace osgLabels
