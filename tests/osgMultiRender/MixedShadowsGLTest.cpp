// SPDX-License-Identifier: MIT
// Mixes of the frame beside shadows.
#include "osgMultiRender/ImageOperations.h"
#include "osgMultiRender/MixedPictures.h"

#include <osgShadowVolume/ShadowedScene.h>

using namespace osgMultiRender;
using osgShadowVolume::ShadowedScene;

namespace
{

class MixedShadowsGLTest : public MixedPictures
{
protected:
    osg::ref_ptr<osg::Image> drawOther(osg::Node& node)
    {
        return osg::clone(_viewer.renderFloat(&node, _camera, Size, Size, 2).get(),
                          osg::CopyOp::DEEP_COPY_ALL);
    }

    static osg::ref_ptr<osg::Group> around(const osg::ref_ptr<osg::Group>& group, osg::Node& child)
    {
        group->addChild(&child);
        return group;
    }

    osg::ref_ptr<osg::Group> makeShadows() { return new ShadowedScene; }

    osg::ref_ptr<osg::Group> makeFrameMix()
    {
        const osg::ref_ptr<MixedScene> mix = new MixedScene;
        mix->addRendering(importNamed("luminance"));
        mix->setInput(MixInput::Frame);
        return mix;
    }

    /// `picture` is the grey of `plain`, everywhere.
    static void expectGrey(const osg::Image& picture, const osg::Image& plain)
    {
        double worst = 0.0;
        for (int y = 0; y < Size; ++y)
            for (int x = 0; x < Size; ++x)
            {
                const osg::Vec4 off = grey(luminance(at(plain, x, y))) - at(picture, x, y);
                for (int i = 0; i < 3; ++i)
                    worst = std::max(worst, double(std::abs(off[i])));
            }
        EXPECT_LE(worst, 1.0 / 255.0);
    }
};

} // namespace

TEST_F(MixedShadowsGLTest, aMixOfTheFrameInsideOfAndAroundShadowsGetsThePictureWithThem)
{
    const osg::ref_ptr<osg::Image> unshadowed = drawOther(*_model);
    const osg::ref_ptr<osg::Image> plain = drawOther(*around(makeShadows(), *_model));
    ASSERT_GT(support::difference(*plain, *unshadowed, 0.05).pixelsOver, 500u) << "no shadows";
    support::NotifyCapture capture;
    const osg::ref_ptr<osg::Image> mixAround =
        drawOther(*around(makeFrameMix(), *around(makeShadows(), *_model)));
    support::writeImage(*mixAround, "mixedFrameAroundShadows");
    expectGrey(*mixAround, *plain);
    const osg::ref_ptr<osg::Image> mixInside =
        drawOther(*around(makeShadows(), *around(makeFrameMix(), *_model)));
    support::writeImage(*mixInside, "mixedFrameInsideShadows");
    expectGrey(*mixInside, *plain);
    EXPECT_EQ(capture.takeWarnings(), support::NotifyCapture::Lines());
}
