// SPDX-License-Identifier: MIT
#include <osgShadowVolume/ShadowedScene.h>

#include <osgShadowVolume/ShadowKeys.h>

#include <osgGA/EventVisitor>

namespace osgShadowVolume
{

ShadowedScene::ShadowedScene()
{
    // Event traversals visit only what asks for them.
    setNumChildrenRequiringEventTraversal(1);
}

ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyop)
    : LitScene(other, copyop), _settings(other._settings)
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

std::unique_ptr<osgMultiRender::SurfacePass> ShadowedScene::createPass() const
{
    return LitScene::createPass();
}

} // namespace osgShadowVolume
