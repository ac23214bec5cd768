// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <osgShadowVolume/LitPass.h>
#include <osgShadowVolume/VolumeShadows.h>

namespace osgShadowVolume
{

ShadowedScene::ShadowedScene() : _resources(std::make_unique<ShadowResources>()) {}

ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyop)
    : LitScene(other, copyop), _settings(other._settings),
      _resources(std::make_unique<ShadowResources>())
{
}

ShadowedScene::~ShadowedScene() = default;

void ShadowedScene::releaseGLObjects(osg::State* state) const
{
    LitScene::releaseGLObjects(state);
    _resources->releaseGLObjects(state);
}

std::unique_ptr<osgMultiRender::SurfacePass> ShadowedScene::createPass() const
{
    std::unique_ptr<LightShadows> shadows;
    if (_settings.shadows == Shadows::VOLUMES)
        shadows = std::make_unique<VolumeShadows>(_settings, *_resources);
    return std::make_unique<LitPass>(*this, _settings, std::move(shadows));
}

} // namespace osgShadowVolume
