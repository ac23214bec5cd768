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

/// Drawables that are looked at in each frame, whether they are still where they were.
constexpr std::size_t sweptPerFrame = 256;

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
    return formatLabelOptions(is) == formatLabelOptions(was) && is.styles.size() == 1 &&
           was.styles.size() == 1;
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

void LabelScene::pick(double x, double y)
{
    const std::shared_ptr<LabelResources> resources = getResources();
    if (resources && _isShown)
        resources->pick.ask({x, y});
    else if (resources)
        resources->pick.answer(0);
}

std::optional<LabelScene::Picked> LabelScene::takePicked()
{
    const std::shared_ptr<LabelResources> resources = getResources();
    const std::optional<std::uint32_t> identifier =
        resources ? resources->pick.takeAnswer() : std::nullopt;
    if (!identifier)
        return std::nullopt;
    return Picked{*identifier, resources->getText(*identifier),
                  resources->getPath(*this, *identifier)};
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
    else if (_resources->collector)
        _resources->collector->sweep(*this, sweptPerFrame);
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
    if (resources && resources->map && resources->map->getFileLabels())
        resources->map->getFileLabels()->accept(visitor);
}

std::unique_ptr<osgMultiRender::SurfacePass> LabelScene::createPass() const
{
    return std::make_unique<LabelPass>(_isShown ? getResources() : nullptr, _settings);
}

} // namespace osgLabels
