// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <osgShadowVolume/IlluminanceView.h>
#include <osgShadowVolume/LitPass.h>
#include <osgShadowVolume/VolumeShadows.h>

#include <osgUtil/CullVisitor>

namespace osgShadowVolume
{

ShadowedScene::ShadowedScene()
    : _resources(std::make_unique<ShadowResources>()),
      _illuminance(std::make_unique<IlluminanceView>())
{
}

ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyop)
    : LitScene(other, copyop), _settings(other._settings),
      _resources(std::make_unique<ShadowResources>()),
      _illuminance(std::make_unique<IlluminanceView>())
{
}

ShadowedScene::~ShadowedScene() = default;

void ShadowedScene::releaseGLObjects(osg::State* state) const
{
    LitScene::releaseGLObjects(state);
    _resources->releaseGLObjects(state);
    _illuminance->releaseGLObjects(state);
}

void ShadowedScene::resizeGLObjectBuffers(unsigned int maxSize)
{
    LitScene::resizeGLObjectBuffers(maxSize);
    _illuminance->resizeGLObjectBuffers(maxSize);
}

void ShadowedScene::traverse(osg::NodeVisitor& visitor)
{
    LitScene::traverse(visitor);
    if (auto* cullVisitor = visitor.asCullVisitor())
        _illuminance->cullLegend(*cullVisitor);
}

std::unique_ptr<osgMultiRender::SurfacePass> ShadowedScene::createPass() const
{
    std::unique_ptr<LightShadows> shadows;
    if (_settings.shadows == Shadows::VOLUMES)
        shadows = std::make_unique<VolumeShadows>(_settings, *_resources);
    auto pass = std::make_unique<LitPass>(*this, _settings, std::move(shadows));
    pass->setIlluminance(_illuminance.get());
    return pass;
}

} // namespace osgShadowVolume
