// SPDX-License-Identifier: MIT
#include "VirtualScenes.h"

#include <support/CompareImage.h>
#include <support/NotifyCapture.h>

#include <gtest/gtest.h>

namespace
{

using osgPagedTexture::VirtualScene;

[[maybe_unused]] const bool filtersExactly = (virtuals::filterExactly(), true);

/// GL rounds weights of texels and levels to 1/256 and more, each in its own place, so that a
/// channel may round the other way in each of the two mixes.
const support::CompareImage Same{1.0 / 255.0, 0.0, 2.0 / 255.0};

support::CameraSpec above(double height)
{
    return support::CameraSpec::perspective({0.0, 0.0, height}, {}, {0.0, 1.0, 0.0}, 50.0,
                                            4.0 / 3.0, 0.01, 1e4);
}

class VirtualPictureGLTest : public testing::Test
{
protected:
    support::HeadlessViewer _viewer;
    support::TemporaryFolder _folder;
    support::NotifyCapture _notes;
};

} // namespace

TEST_F(VirtualPictureGLTest, atRestThePictureIsThatOfAPlainTexture)
{
    OSGKITS_NEED_GL(_viewer);
    const virtuals::Levels levels = virtuals::makeLevels(1024, 1024);
    virtuals::buildStore(_folder.file("atlas"), levels);
    const auto plain = virtuals::makeFloor(virtuals::makePlainTexture(levels), 10.0f);
    const auto scene = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(_folder.file("atlas")), 10.0f));
    for (const double height : {0.5, 2.0, 7.3, 12.0, 30.0, 200.0})
    {
        const auto expected = _viewer.render(plain, above(height), 320, 240);
        const auto actual = virtuals::settle(_viewer, *scene, scene, above(height));
        EXPECT_TRUE(Same(actual, expected, "virtual.above" + std::to_string(int(height))));
        EXPECT_EQ(virtuals::countOf(*scene, "levels.missing"), 0.0) << "no proof";
    }
}
