// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <osgShadowVolume/LitPass.h>
#include <osgShadowVolume/ShadowKeys.h>
#include <osgShadowVolume/VolumeShadows.h>

#include <osgGA/EventVisitor>

namespace osgShadowVolume
{

ShadowedScene::ShadowedScene() : _resources(std::make_unique<ShadowResources>())
{
    // Event traversals visit only what asks for them.
    setNumChildrenRequiringEventTraversal(1);
}

ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyop)
    : LitScene(other, copyop), _settings(other._settings),
      _resources(std::make_unique<ShadowResources>())
{
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

ShadowedScene::~ShadowedScene() = default;

void ShadowedScene::traverse(osg::NodeVisitor& visitor)
{
    if (osgGA::EventVisitor* events = visitor.asEventVisitor(); events && getKeys())
        answerKeys(*this, *events);
    LitScene::traverse(visitor);
}

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
