// SPDX-License-Identifier: MIT
// Below the readable size letters go over into one tone, without a step, and their plate stays.
#include "ExtremePictures.h"

#include <algorithm>
#include <cmath>
#include <set>

using namespace labelScene;

namespace
{

/// What a line of text takes of the board's height of 1, and so pixels of the picture.
constexpr float Size = 0.4f, Pixels = 0.5f * Size * Height;

class LabelReadable : public PictureTest
{
protected:
    static Picture draw(float readable, const std::string& plate = "off")
    {
        return renderNumbers(*labelled(unlit(board("PIPE 10")),
                                       "ink=#000000,size=" + std::to_string(Size) + ",readable=" +
                                           std::to_string(readable) + ",plate=" + plate),
                             "labelReadable");
    }
};

float greenAt(const osg::Image& picture, int x, int y)
{
    return picture.getColor(unsigned(x), unsigned(y)).g();
}

} // namespace

TEST_F(LabelReadable, lettersAreWholeDownToThatSize)
{
    const Picture expected = draw(0.0f);
    keep(expected, "labelReadable");
    EXPECT_TRUE(areEqual(draw(0.99f * Pixels), expected, "labelReadable.whole"));
    EXPECT_GT(changedShare(*draw(1.1f * Pixels), *expected), 0.02);
}

TEST_F(LabelReadable, lettersGoOverIntoTheirTone)
{
    // All of the letters at the size, none at half of it.
    const Picture letters = draw(0.0f), half = draw(4.0f / 3.0f * Pixels), tone = draw(100.0f);
    std::set<int> tones;
    double ofLetters = 0.0, ofTone = 0.0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            const float a = greenAt(*letters, x, y), b = greenAt(*tone, x, y);
            EXPECT_NEAR(greenAt(*half, x, y), 0.5f * (a + b), 1e-3f) << x << " " << y;
            ofLetters += a;
            ofTone += b;
            tones.insert(int(std::lround(1000.0f * b)));
        }
    EXPECT_EQ(tones.size(), 3u) << "of the background, the board and the text";
    // It is the mean tone of all letters, which these ones have but for a fifth.
    const double bare = [&]
    {
        const Picture without = renderNumbers(*unlit(board("")), "labelReadable.bare");
        double sum = 0.0;
        for (int y = 0; y < Height; ++y)
            for (int x = 0; x < Width; ++x)
                sum += greenAt(*without, x, y);
        return sum;
    }();
    EXPECT_NEAR((bare - ofTone) / (bare - ofLetters), 1.0, 0.2);
}

TEST_F(LabelReadable, aPlateStays)
{
    const Picture letters = draw(0.0f, "#ff0000"), tone = draw(100.0f, "#ff0000");
    keep(tone, "labelReadable.plate");
    int plates = 0;
    for (int y = 0; y < Height; ++y)
        for (int x = 0; x < Width; ++x)
        {
            const osg::Vec4 before = letters->getColor(unsigned(x), unsigned(y)),
                            after = tone->getColor(unsigned(x), unsigned(y));
            const bool isPlate = before.r() > 0.9f && before.g() == 0.0f;
            plates += isPlate;
            if (isPlate)
            {
                EXPECT_EQ(after.g(), 0.0f) << x << " " << y;
                EXPECT_GT(after.r(), 0.6f) << x << " " << y;
            }
        }
    EXPECT_GT(plates, 1000);
}
