// SPDX-License-Identifier: MIT
#include "FeatureScenes.h"

#include <support/CompareImage.h>
#include <support/HeadlessViewer.h>
#include <support/NotifyCapture.h>

#include <cstdlib>
#include <map>
#include <set>

namespace
{

constexpr int Width = 160, Height = 120;

support::HeadlessViewer& theViewer()
{
    static support::HeadlessViewer viewer({Width, Height});
    return viewer;
}

using Picture = osg::ref_ptr<osg::Image>;

Picture picture(const FeatureScene& scene)
{
    const support::CameraSpec camera = {featureView(), featureProjection(double(Width) / Height)};
    return theViewer().render(scene.create(), camera, Width, Height);
}

/// Share of the pixels that show something other than black and the background.
double litShare(const osg::Image& image)
{
    const osg::Vec4 background = image.getColor(0, Height - 1);
    unsigned int count = 0;
    for (int y = 0; y < image.t(); ++y)
    {
        for (int x = 0; x < image.s(); ++x)
        {
            const osg::Vec4 color = image.getColor(x, y);
            count += color != background && color.r() + color.g() + color.b() > 0.1f;
        }
    }
    return double(count) / (image.s() * image.t());
}

class FeatureFamily : public testing::TestWithParam<std::string>
{
};

} // namespace

TEST(FeatureScenes, areManyAndTheirNamesAreUnique)
{
    std::set<std::string> names;
    for (const FeatureScene& scene : featureScenes())
        EXPECT_TRUE(names.insert(scene.family + "." + scene.name).second) << scene.name;
    EXPECT_GE(names.size(), 300u);
}

TEST_P(FeatureFamily, showsSomethingTheSameEachTimeAndNoTwoAreAlike)
{
    OSGKITS_NEED_GL(theViewer());
    support::NotifyCapture notify;
    std::map<std::string, Picture> pictures;
    std::map<std::string, std::string> twins;
    for (const FeatureScene& scene : featureScenes())
    {
        if (scene.family != GetParam())
            continue;
        const Picture image = picture(scene);
        ASSERT_TRUE(image.valid());
        EXPECT_GT(litShare(*image), 0.005) << scene.name << " shows nothing";
        const support::CompareImage exact{0.0, 0.0, 0.0};
        EXPECT_TRUE(exact(picture(scene), image, "feature." + scene.family + "." + scene.name))
            << "it is not the same each time";
        pictures[scene.name] = image;
        twins[scene.name] = scene.twin.empty() ? scene.name : scene.twin;
        if (std::getenv("OSGKITS_KEEP_IMAGES"))
            support::writeImage(*image, "feature." + scene.family + "." + scene.name);
    }
    const double step = 2.0 / 255.0;
    for (auto a = pictures.begin(); a != pictures.end(); ++a)
    {
        for (auto b = std::next(a); b != pictures.end(); ++b)
        {
            const double share = support::difference(*a->second, *b->second, step).getShareOver();
            if (twins[a->first] == twins[b->first])
                EXPECT_LE(share, 0.001) << a->first << " and " << b->first << " are no twins";
            else
                EXPECT_GT(share, 0.001) << a->first << " looks like " << b->first;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(FixedFunction, FeatureFamily, testing::ValuesIn(featureFamilies()),
                         [](const auto& family) { return family.param; });
