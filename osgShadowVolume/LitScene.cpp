// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LitScene.h>

#include <osgShadowVolume/LightTextures.h>
#include <osgShadowVolume/LitPass.h>

namespace osgShadowVolume
{

LitScene::LitScene() : _textures(std::make_unique<LightTextures>()) {}

LitScene::LitScene(const LitScene& other, const osg::CopyOp& copyop)
    : osgMultiRender::SurfaceGroup(other, copyop), _lighting(other._lighting),
      _lightScope(other._lightScope), _lightTolerance(other._lightTolerance),
      _textures(std::make_unique<LightTextures>())
{
}

LitScene::~LitScene() = default;

void LitScene::releaseGLObjects(osg::State* state) const
{
    osgMultiRender::SurfaceGroup::releaseGLObjects(state);
    _textures->releaseGLObjects(state);
}

std::unique_ptr<osgMultiRender::SurfacePass> LitScene::createPass() const
{
    return std::make_unique<LitPass>(*this);
}

} // namespace osgShadowVolume
