// SPDX-License-Identifier: MIT
#include "InkReadings.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

using labelScene::labelled;
using labelScene::Picture;

namespace inkReadings
{

namespace
{

constexpr char Marked[] = "ink=#ff00ff,plate=off"; // a colour that no scene has

osg::Vec4 at(const osg::Image& image, int pixel)
{
    return image.getColor(unsigned(pixel % Wide), unsigned(pixel / Wide));
}

/// Pixels that are ink through and through, by letters, which are those that hang together.
std::vector<std::vector<int>> lettersOf(const osg::Image& marked)
{
    const auto isInk = [&](int pixel) { return at(marked, pixel) == osg::Vec4(1, 0, 1, 1); };
    std::vector<bool> seen(std::size_t(Wide) * High);
    std::vector<std::vector<int>> letters;
    for (int start = 0; start < Wide * High; ++start)
    {
        if (seen[std::size_t(start)] || !isInk(start))
            continue;
        std::vector<int> letter, open{start};
        seen[std::size_t(start)] = true;
        while (!open.empty())
        {
            const int pixel = open.back();
            open.pop_back();
            letter.push_back(pixel);
            for (const int next : {pixel - 1, pixel + 1, pixel - Wide, pixel + Wide})
                if (next >= 0 && next < Wide * High && !seen[std::size_t(next)] && isInk(next))
                {
                    seen[std::size_t(next)] = true;
                    open.push_back(next);
                }
        }
        if (letter.size() > 8)
            letters.push_back(letter);
    }
    return letters;
}

/// A model and the same with labels in several ways.
struct Pictures
{
    Picture bare;   ///< Without any ink.
    Picture marked; ///< In a colour that no scene has.
    Picture picked; ///< In the ink that chooses itself.
    Picture plates; ///< All that a plate covers is green; null for Beside::All.
};

/// Whether a pixel has no ink at all, as far as 8 bits tell.
bool isBare(const Pictures& pictures, int pixel)
{
    return at(*pictures.marked, pixel) == at(*pictures.bare, pixel);
}

/// The least contrast of a pixel of ink to what surrounds it: the first pixels without any, beyond
/// an edge that is smoothed over a pixel or two.
double worstAround(const Pictures& pictures, int pixel, double ink)
{
    double worst = 21.0;
    for (int direction = 0; direction < 9; ++direction)
        for (int step = 1; step <= 3; ++step)
        {
            const int x = pixel % Wide + step * (direction % 3 - 1);
            const int y = pixel / Wide + step * (direction / 3 - 1);
            const int next = y * Wide + x;
            if (x < 0 || x >= Wide || y < 0 || y >= High || !isBare(pictures, next))
                continue;
            if (pictures.plates && at(*pictures.plates, next) != osg::Vec4(0, 1, 0, 1))
                break;
            worst = std::min(worst, contrast(ink, luminanceOf(at(*pictures.picked, next))));
            break;
        }
    return worst;
}

} // namespace

support::HeadlessViewer& viewer()
{
    static support::HeadlessViewer theViewer({Wide, High});
    theViewer.getViewer().setLightingMode(osg::View::NO_LIGHT);
    return theViewer;
}

double luminanceOf(const osg::Vec4& color)
{
    const auto linear = [](double c)
    { return c < 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b());
}

double contrast(double a, double b)
{
    return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

Readings readingsOf(osg::Node* model, const support::CameraSpec& camera, const std::string& name,
                    const std::string& settings, Beside beside)
{
    const std::string more = (settings.empty() ? "" : ",") + settings;
    const auto draw = [&](osg::Node* node) { return viewer().render(node, camera, Wide, High, 2); };
    Pictures pictures;
    pictures.bare = draw(model);
    pictures.marked = draw(labelled(model, Marked + more));
    pictures.picked = draw(labelled(model, settings));
    if (beside == Beside::Plates)
        pictures.plates = draw(labelled(model, "ink=#00ff00,plate=#00ff00" + more));
    labelScene::keep(pictures.picked, "labelInk." + name);
    Readings found;
    for (const std::vector<int>& letter : lettersOf(*pictures.marked))
    {
        int black = 0, white = 0;
        for (const int pixel : letter)
        {
            const double ink = luminanceOf(at(*pictures.picked, pixel));
            black += ink < 0.01;
            white += ink > 0.99;
            found.worst = std::min(found.worst, worstAround(pictures, pixel, ink));
        }
        EXPECT_EQ(std::size_t(black + white), letter.size()) << name << ": ink is black or white";
        found.twoColored += black && white;
        found.black += black;
        found.white += white;
        ++found.letters;
    }
    return found;
}

void expectReadable(const Readings& found, const std::string& name, int leastLetters)
{
    EXPECT_GE(found.letters, leastLetters) << name;
    EXPECT_EQ(found.twoColored, 0) << name << ": letters of two colours";
    EXPECT_GE(found.worst, 4.5) << name;
    std::cout << name << ": " << found.letters << " letters, contrast at least " << found.worst
              << ", " << found.black << " black and " << found.white << " white pixels\n";
}

void expectOneInk(const Readings& found, const std::string& name, int leastLetters)
{
    EXPECT_EQ(std::min(found.black, found.white), 0) << name;
    expectReadable(found, name, leastLetters);
}

} // namespace inkReadings
