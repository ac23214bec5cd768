// SPDX-License-Identifier: MIT
#include <osgMultiRender/Overlay.h>

#include <osg/MatrixTransform>
#include <osg/PolygonMode>

namespace osgMultiRender
{

namespace
{

/// State that the model above must not change.
osg::ref_ptr<osg::StateSet> makeState()
{
    constexpr unsigned int off = osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED;
    constexpr unsigned int on = osg::StateAttribute::ON | osg::StateAttribute::PROTECTED;
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    for (const GLenum mode : {GL_LIGHTING, GL_DEPTH_TEST, GL_CULL_FACE, GL_FOG, GL_ALPHA_TEST})
        state->setMode(mode, off);
    state->setMode(GL_BLEND, on);
    state->setAttribute(new osg::PolygonMode, on);
    state->setRenderBinDetails(1000000, "TraversalOrderBin",
                               osg::StateSet::OVERRIDE_PROTECTED_RENDERBIN_DETAILS);
    return state;
}

} // namespace

osg::ref_ptr<osg::Projection> makeOverlay(double width, double height, osg::Node& content)
{
    osg::ref_ptr<osg::Projection> projection =
        new osg::Projection(osg::Matrixd::ortho2D(0.0, width, 0.0, height));
    osg::ref_ptr<osg::MatrixTransform> pixels = new osg::MatrixTransform;
    pixels->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    pixels->addChild(&content);
    projection->addChild(pixels);
    projection->setStateSet(makeState());
    projection->setCullingActive(false);
    return projection;
}

} // namespace osgMultiRender
