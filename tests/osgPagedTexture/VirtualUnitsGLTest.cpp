// SPDX-License-Identifier: MIT
// Several virtual textures on one surface and beside each other.
#include "VirtualScenes.h"

#include <support/CompareImage.h>

#include <osg/MatrixTransform>

#include <gtest/gtest.h>

namespace
{

// One surface shows a texture, another one the product of two.
class VirtualUnitsGLTest : public testing::Test
{
protected:
    void SetUp() override
    {
        for (const unsigned int seed : {11u, 12u})
            virtuals::buildStore(_folder.file("t" + std::to_string(seed)),
                                 virtuals::makeLevels(512, 512, seed));
    }

    osg::ref_ptr<osg::Texture2D> makeTexture(bool isVirtual, unsigned int seed) const
    {
        if (isVirtual)
            return virtuals::makeVirtualTexture(_folder.file("t" + std::to_string(seed))).get();
        return virtuals::makePlainTexture(virtuals::makeLevels(512, 512, seed));
    }

    /// The second one lies below the first by `depth` units, and is drawn in a render bin before
    /// or after it.
    osg::ref_ptr<osg::Group> makeModel(bool isVirtual, double depth, int bin = 0) const
    {
        osg::ref_ptr<osg::Group> group = new osg::Group;
        group->addChild(virtuals::makeFloor(makeTexture(isVirtual, 11), 4.0f));
        const auto other = virtuals::makeFloor(makeTexture(isVirtual, 12), 10.0f);
        auto* geometry = other->getDrawable(0)->asGeometry();
        geometry->setTexCoordArray(1, geometry->getTexCoordArray(0));
        osg::StateSet& state = *other->getOrCreateStateSet();
        state.setTextureAttributeAndModes(1, makeTexture(isVirtual, 11));
        state.setRenderBinDetails(bin, "RenderBin");
        osg::ref_ptr<osg::MatrixTransform> below =
            new osg::MatrixTransform(osg::Matrix::translate(0.0, 0.0, -depth));
        below->addChild(other);
        group->addChild(below);
        return group;
    }

    void expectPlainPicture(double depth, int bin, const char* name)
    {
        const auto scene = virtuals::makeScene(makeModel(true, depth, bin));
        const auto plain = makeModel(false, depth, bin);
        const auto camera = support::CameraSpec::perspective(
            {0.5, 0.0, 5.0}, {0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}, 50.0, 4.0 / 3.0, 0.01, 1e4);
        const support::CompareImage same{1.0 / 255.0, 0.001, 4.0 / 255.0};
        EXPECT_TRUE(same(virtuals::settle(_viewer, *scene, scene, camera),
                         _viewer.render(plain, camera, 320, 240), name));
    }

    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
};

} // namespace

TEST_F(VirtualUnitsGLTest, severalTexturesAndUnitsShareTheSlots)
{
    OSGKITS_NEED_GL(_viewer);
    expectPlainPicture(0.01, 0, "virtual.units");
}

// What is drawn first hides the other one.
TEST_F(VirtualUnitsGLTest, ofSurfacesInOnePlaneThePagesOfThoseAreThereThatThePictureShows)
{
    OSGKITS_NEED_GL(_viewer);
    expectPlainPicture(0.0, -1, "virtual.planeBelowFirst");
    expectPlainPicture(0.0, 1, "virtual.planeBelowLast");
}
