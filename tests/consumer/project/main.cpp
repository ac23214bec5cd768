// SPDX-License-Identifier: MIT
// What an embedding application does: a LitScene over a model, saved and read back by name.
#include <osgShadowVolume/LitScene.h>
#include <osgShadowVolume/SceneOptions.h>

#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cstdio>

int main(int argc, char** argv)
{
    if (argc != 2)
        return std::fprintf(stderr, "usage: consumer file.osgt\n"), 2;
    osg::ref_ptr<osgShadowVolume::LitScene> scene = new osgShadowVolume::LitScene;
    scene->setLighting(osgShadowVolume::LitScene::Lighting::VERTEX);
    scene->addChild(new osg::ShapeDrawable(new osg::Sphere));
    if (!osgDB::writeNodeFile(*scene, argv[1]))
        return std::fprintf(stderr, "cannot write %s\n", argv[1]), 1;
    osg::ref_ptr<osg::Node> read = osgDB::readRefNodeFile(argv[1]);
    auto* lit = dynamic_cast<osgShadowVolume::LitScene*>(read.get());
    if (!lit || lit->getLighting() != osgShadowVolume::LitScene::Lighting::VERTEX ||
        lit->getNumChildren() != 1)
        return std::fprintf(stderr, "%s did not come back as it was written\n", argv[1]), 1;
    // The pseudo-loader, too, is found in the installation.
    osg::ref_ptr<osg::Node> wrapped =
        osgDB::readRefNodeFile(std::string(argv[1]) + ".(shadows=map).shadowvolume");
    auto* shadowed = dynamic_cast<osgShadowVolume::ShadowedScene*>(wrapped.get());
    std::string error;
    if (!shadowed || shadowed->getShadows() != osgShadowVolume::Shadows::MAP ||
        !setSceneOption(*shadowed, "technique", "cpu", error))
        return std::fprintf(stderr, "no ShadowedScene: %s\n", error.c_str()), 1;
    return 0;
}
