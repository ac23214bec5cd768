// SPDX-License-Identifier: MIT
// Eyes that graze, touch and are far: the text is where it is for any other.
#include "ExtremePictures.h"

#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>

using namespace labelScene;
using support::CameraSpec;

namespace
{

class LabelDistance : public PictureTest
{
};

/// Looks along +y at a place of the plane y = 0 from a distance, which may be of any size.
CameraSpec before(const osg::Vec2d& place, double distance)
{
    return CameraSpec::perspective({place.x(), -distance, place.y()},
                                   {place.x(), 1.0 - distance, place.y()}, {0, 0, 1}, 40.0,
                                   double(Width) / Height, std::abs(distance) / 10.0 + 1e-30, 10.0);
}

/// A place of a board of which all within a pixel of fromFront() is ink, or nothing is.
osg::Vec2d placeOn(const osg::Image& picture, bool ink)
{
    for (int y = Height / 2; y < 3 * Height / 4; ++y)
        for (int x = Width / 4; x < 3 * Width / 4; ++x)
        {
            bool found = true;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    found = found && (picture.data(x + i, y + j)[0] < 40) == ink;
            if (found)
                return {(2.0 * (x + 0.5) / Width - 1.0) * Width / Height,
                        2.0 * (y + 0.5) / Height - 1.0};
        }
    ADD_FAILURE() << "no such place";
    return {};
}

/// What the ink leaves of the light of the pixel that it covers most, as a share.
double leastLight(const InkPictures& pictures)
{
    double least = 1.0;
    for (unsigned int y = 0; y < Height; ++y)
        for (unsigned int x = 0; x < Width; ++x)
            least = std::min<double>(least, pictures.with->getColor(x, y).r() /
                                                pictures.without->getColor(x, y).r());
    return least;
}

} // namespace

TEST_F(LabelDistance, grazingViewsAreSmooth)
{
    const auto model = unlit(board("GRAZING"));
    const auto draw = [&](double degrees)
    {
        const double angle = osg::DegreesToRadians(degrees);
        return drawInk(
            model, "grazing" + std::to_string(degrees),
            lookFrom({2.0 * std::sin(angle), -2.0 * std::cos(angle), 0.1}, {0, 0, 0}, 2.0));
    };
    EXPECT_GT(draw(80.0).inkShare(), 0.02);
    EXPECT_GT(draw(89.0).inkShare(), 0.004);
    // Two of a pixel's width. Through its middle the one shows the board at x = 0.7, where letters
    // side by side are averaged, the other at x = 1.04 and at that beside the text.
    const InkPictures letters = draw(89.8), beside = draw(89.9);
    EXPECT_DOUBLE_EQ(letters.modelShare(), 1.0 / Width);
    EXPECT_GT(letters.inkShare(), 0.001);
    ASSERT_TRUE(letters.with && letters.without);
    EXPECT_GT(leastLight(letters), 0.3) << "a letter alone is black";
    EXPECT_DOUBLE_EQ(beside.modelShare(), 1.0 / Width);
    EXPECT_EQ(beside.inkShare(), 0.0);
    const InkPictures gone = draw(90.0);
    EXPECT_EQ(gone.modelShare(), 0.0);
    EXPECT_EQ(gone.inkShare(), 0.0);
}

TEST_F(LabelDistance, theEyeMayTouchTheSurface)
{
    const auto model = unlit(board("TOUCH"));
    const Picture whole = render(*labelled(model, Plain));
    ASSERT_TRUE(whole);
    const osg::Vec2d ink = placeOn(*whole, true), bare = placeOn(*whole, false);
    for (double distance : {1e-3, 1e-6})
    {
        EXPECT_EQ(drawInk(model, "touchInk", before(ink, distance)).inkShare(), 1.0) << distance;
        const InkPictures blank = drawInk(model, "touchBare", before(bare, distance));
        EXPECT_EQ(blank.inkShare(), 0.0) << distance;
        EXPECT_EQ(blank.modelShare(), 1.0) << distance;
    }
    for (double distance : {0.0, -1e-6})
        EXPECT_EQ(drawInk(model, "touchNone", before(ink, distance)).inkShare(), 0.0) << distance;
}

TEST_F(LabelDistance, anEyeInThePlaneOfABoardSeesNothingOfIt)
{
    const InkPictures edge =
        drawInk(unlit(board("EDGE")), "inPlane",
                CameraSpec::perspective({0, 0, 0}, {1, 0.02, 0}, {0, 0, 1}, 40.0,
                                        double(Width) / Height, 1e-4, 10.0));
    EXPECT_EQ(edge.modelShare(), 0.0);
    EXPECT_EQ(edge.inkShare(), 0.0);
}

TEST_F(LabelDistance, aModelFarFromTheOriginHasTheSameLabels)
{
    const Picture expected = render(*labelled(unlit(board("P-101")), Plain));
    const osg::Vec3d far(1e7, -2e7, 3e6);
    osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(osg::Matrix::translate(far));
    transform->addChild(board("P-101"));
    CameraSpec camera = fromFront();
    camera.view = osg::Matrixd::translate(-far) * camera.view;
    EXPECT_TRUE(
        areAlike(render(*labelled(unlit(transform), Plain), camera), expected, "labelExtreme.far"));
}
