// SPDX-License-Identifier: MIT
#include "Trees.h"

#include "Facades.h"
#include "SolidMesh.h"

#include <osg/Geode>

using osg::Vec3;

namespace
{

const Vec3 Bark(0.36f, 0.27f, 0.18f);

osg::ref_ptr<osg::Node> geodeOf(osg::Drawable* drawable, osg::StateSet* state = nullptr)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(drawable);
    geode->setStateSet(state);
    return geode;
}

osg::ref_ptr<osg::Geometry> makeBroad(const Vec3& leaf)
{
    SolidMesh mesh;
    mesh.turned({{0.06f, 0.0f}, {0.045f, 0.45f}}, 6, Bark);
    mesh.turned({{0.0f, 0.3f}, {0.33f, 0.38f}, {0.5f, 0.6f}, {0.38f, 0.86f}, {0.0f, 1.0f}}, 9,
                leaf);
    return mesh.make();
}

osg::ref_ptr<osg::Geometry> makeFir()
{
    const Vec3 needles(0.17f, 0.34f, 0.2f);
    SolidMesh mesh;
    mesh.turned({{0.05f, 0.0f}, {0.045f, 0.2f}}, 6, Bark);
    mesh.turned({{0.0f, 0.12f}, {0.4f, 0.15f}, {0.0f, 0.7f}}, 8, needles);
    mesh.turned({{0.0f, 0.44f}, {0.28f, 0.47f}, {0.0f, 1.0f}}, 8, needles * 1.15f);
    return mesh.make();
}

/// Two upright quads that cross.
osg::ref_ptr<osg::Geometry> makeCross()
{
    SolidMesh mesh;
    const Vec3 white(1.0f, 1.0f, 1.0f);
    mesh.face({{-0.5f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.5f, 0.0f, 1.0f}, {-0.5f, 0.0f, 1.0f}},
              white, {1.0f, 1.0f});
    mesh.face({{0.0f, -0.5f, 0.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 0.5f, 1.0f}, {0.0f, -0.5f, 1.0f}},
              white, {1.0f, 1.0f});
    return mesh.make();
}

} // namespace

Trees::Trees()
{
    _kinds = {geodeOf(makeBroad({0.34f, 0.5f, 0.22f})), geodeOf(makeBroad({0.44f, 0.55f, 0.24f})),
              geodeOf(makeFir()), geodeOf(makeCross(), makeLeafState())};
}

osg::ref_ptr<osg::MatrixTransform> Trees::plant(const osg::Vec3d& place, CityRandom& random) const
{
    const double height = random(5.0, 12.0), width = height * random(0.55, 0.85);
    const double turn = random(0.0, 2.0 * osg::PI);
    const double mirror = random.choice(4) ? 1.0 : -1.0;
    osg::ref_ptr<osg::MatrixTransform> tree = new osg::MatrixTransform(
        osg::Matrixd::scale(mirror * width, width, height) *
        osg::Matrixd::rotate(turn, 0.0, 0.0, 1.0) * osg::Matrixd::translate(place));
    tree->addChild(_kinds[random.choice(static_cast<unsigned int>(_kinds.size()))]);
    // Sizes must not change how bright the bark is.
    tree->getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
    return tree;
}
