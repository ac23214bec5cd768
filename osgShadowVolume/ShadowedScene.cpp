// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

namespace osgShadowVolume
{

ShadowedScene::ShadowedScene() = default;

ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyop)
    : LitScene(other, copyop), _settings(other._settings)
{
}

ShadowedScene::~ShadowedScene() = default;

std::unique_ptr<osgMultiRender::SurfacePass> ShadowedScene::createPass() const
{
    return LitScene::createPass();
}

} // namespace osgShadowVolume
