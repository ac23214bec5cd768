// SPDX-License-Identifier: MIT
#include "LabelPictures.h"
#include "ShapeTruth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace
{

/// Black letters at any size.
const char Settings[] = "ink=#000000,plate=off,readable=0";

/// The picture, the truth and eight times their difference about gray, beside each other.
void keepAll(const osg::Image& picture, const osg::Image& truth, const std::string& name)
{
    const int size = truth.s();
    const osg::ref_ptr<osg::Image> sheet = new osg::Image;
    sheet->allocateImage(3 * size, size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
        {
            const float expected = *reinterpret_cast<const float*>(truth.data(x, y));
            const float actual = 1.0f - picture.data(x, y)[0] / 255.0f;
            const bool isKnown = !std::isnan(expected);
            const float shown[] = {1.0f - actual, isKnown ? 1.0f - expected : 0.8f,
                                   isKnown ? 0.5f + 8.0f * (actual - expected) : 0.5f};
            for (int i = 0; i < 3; ++i)
                for (int channel = 0; channel < 4; ++channel)
                    sheet->data(x + i * size, y)[channel] =
                        channel == 3 ? 255
                                     : static_cast<unsigned char>(
                                           255.0f * std::min(std::max(shown[i], 0.0f), 1.0f));
        }
    labelScene::keep(sheet, name);
}

double getError(const ShapeTruth& shape, const std::string& name, const ShapeView& view,
                int& pixels)
{
    const auto scene = labelScene::labelled(shape.getNode(), Settings);
    const auto picture = labelScene::render(*scene, shape.getCamera(view), view.size, view.size);
    const auto truth = shape.makeTruth(view);
    if (!picture)
        return 100.0;
    keepAll(*picture, *truth,
            "shape-" + name + "-" + std::to_string(int(view.roll + view.tilt)) + "-" +
                std::to_string(int(view.pixelsPerEm)));
    return getShapeError(*picture, *truth, &pixels);
}

ShapeView makeView(double roll, double tilt, double pixelsPerEm)
{
    ShapeView view;
    view.roll = roll;
    view.tilt = tilt;
    view.pixelsPerEm = pixelsPerEm;
    return view;
}

} // namespace

TEST(ShapeCoverageGLTest, lettersOnShapesInPerspectiveAreThoseOfTheOutlines)
{
    OSGKITS_NEED_GL(labelScene::viewer());
    for (const char* const name : ShapeTruth::Names)
    {
        const ShapeTruth shape(name);
        for (const ShapeView& view :
             {makeView(0.0, 0.0, 8.0), makeView(0.0, 0.0, 32.0), makeView(27.0, 0.0, 12.0),
              makeView(27.0, 0.0, 200.0), makeView(0.0, 80.0, 16.0), makeView(0.0, 80.0, 64.0)})
        {
            int pixels = 0;
            const double error = getError(shape, name, view, pixels);
            std::cout << name << ", turned by " << view.roll << ", at " << view.tilt << " degrees, "
                      << view.pixelsPerEm << " pixels an em: " << error << " % over " << pixels
                      << " pixels\n";
            EXPECT_GT(pixels, 50);
            // Towards a sphere's sides pixels are 1.2 to 2 times longer than wide, which one to
            // four squares stand for; at 80 degrees letters at the far end are a few pixels tall.
            const bool isBent = view.tilt > 0.0 || std::string(name) == "sphere";
            EXPECT_LE(error, isBent ? 1.5 : 1.0);
        }
    }
}
