// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <osgShadowVolume/IlluminanceView.h>
#include <osgShadowVolume/LitPass.h>
#include <osgShadowVolume/MapShadows.h>
#include <osgShadowVolume/ShadowKeys.h>
#include <osgShadowVolume/VolumeShadows.h>

#include <osgGA/EventVisitor>
#include <osgUtil/CullVisitor>

namespace osgShadowVolume
{

ShadowedScene::ShadowedScene()
    : _resources(std::make_unique<ShadowResources>()),
      _mirrors(std::make_unique<MirrorResources>()),
      _illuminance(std::make_unique<IlluminanceView>())
{
    // Event traversals visit only what asks for them.
    setNumChildrenRequiringEventTraversal(1);
}

ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyop)
    : LitScene(other, copyop), _settings(other._settings),
      _resources(std::make_unique<ShadowResources>()),
      _mirrors(std::make_unique<MirrorResources>()),
      _illuminance(std::make_unique<IlluminanceView>())
{
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

ShadowedScene::~ShadowedScene() = default;

void ShadowedScene::traverse(osg::NodeVisitor& visitor)
{
    if (osgGA::EventVisitor* events = visitor.asEventVisitor(); events && getKeys())
        answerKeys(*this, *events);
    LitScene::traverse(visitor);
    if (osgUtil::CullVisitor* culling = visitor.asCullVisitor())
        _illuminance->cullLegend(*culling);
}

void ShadowedScene::releaseGLObjects(osg::State* state) const
{
    LitScene::releaseGLObjects(state);
    _resources->releaseGLObjects(state);
    _mirrors->pool.releaseGLObjects(state);
    _illuminance->releaseGLObjects(state);
}

void ShadowedScene::resizeGLObjectBuffers(unsigned int maxSize)
{
    LitScene::resizeGLObjectBuffers(maxSize);
    _illuminance->resizeGLObjectBuffers(maxSize);
}

std::unique_ptr<osgMultiRender::SurfacePass> ShadowedScene::createPass() const
{
    std::unique_ptr<LightShadows> shadows;
    if (_settings.shadows == Shadows::VOLUMES)
        shadows = std::make_unique<VolumeShadows>(_settings, *_resources);
    else if (_settings.shadows == Shadows::MAP)
        shadows = std::make_unique<MapShadows>(_settings, *_resources);
    auto pass = std::make_unique<LitPass>(*this, _settings, std::move(shadows));
    pass->setIlluminance(_illuminance.get());
    if (_settings.mirrors)
        pass->setMirrors(std::make_unique<Mirrors>(_settings, *_mirrors));
    return pass;
}

} // namespace osgShadowVolume
