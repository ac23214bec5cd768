// SPDX-License-Identifier: MIT
#include "FeatureScenes.h"

#include "FeatureSubject.h"

std::vector<FeatureScene> featureScenes()
{
    std::vector<FeatureScene> scenes;
    feature::addMaterialScenes(scenes);
    feature::addLightScenes(scenes);
    feature::addTextureScenes(scenes);
    feature::addTexEnvScenes(scenes);
    feature::addCombineScenes(scenes);
    feature::addTexGenScenes(scenes);
    feature::addFragmentScenes(scenes);
    feature::addVertexScenes(scenes);
    feature::addStateScenes(scenes);
    feature::addNodeScenes(scenes);
    return scenes;
}

std::set<std::string> featureFamilies()
{
    std::set<std::string> names;
    for (const FeatureScene& scene : featureScenes())
        names.insert(scene.family);
    return names;
}

osg::Matrixd featureView()
{
    return osg::Matrixd::lookAt(osg::Vec3d(0.5, -6.0, 1.2), osg::Vec3d(0, 0, 0),
                                osg::Vec3d(0, 0, 1));
}

osg::Matrixd featureProjection(double aspect)
{
    return osg::Matrixd::perspective(28.0, aspect, 2.0, 12.0);
}
