// SPDX-License-Identifier: MIT
#include "CapturedWall.h"
#include "ExactMask.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/ModelPhotos.h>
#include <osgPagedTexture/SeamBlend.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

using namespace osgPagedTexture;

namespace
{

constexpr int Columns = 40, Rows = 30, Width = 320, Height = 256;

class SeamBlendTest : public testing::Test
{
protected:
    void load(bool sameExposure = false)
    {
        const CapturedWall wall(Columns, Rows, Width, Height, sameExposure);
        model = readModelPhotos(wall.write(_folder.getPath().string()), true);
        ASSERT_EQ(model.photos.size(), 4u);
        seams = findSeams(model.photos);
        samples = sampleSeams(model.photos, seams);
        for (std::size_t i = 0; i < 4; ++i)
        {
            pictures.push_back(readImageFile(model.photos[i].file).pixels);
            readSamples(samples, i, pictures[i]);
            masks.push_back(grown(ExactMask(model.photos[i]).getMask()));
        }
    }

    /// By two pixels: bilinear lookups at the mask's edge see beyond it.
    static Pixels grown(const Pixels& mask)
    {
        Pixels result = mask;
        for (int y = 2; y + 2 < mask.height; ++y)
            for (int x = 2; x + 2 < mask.width; ++x)
                for (int i = 0; i < 25; ++i)
                    if (mask.row(y + i / 5 - 2)[x + i % 5 - 2] != 0)
                        result.row(y)[x] = 255;
        return result;
    }

    double stepAfter(SeamBlend& blend)
    {
        for (std::size_t i = 0; i < 4; ++i)
        {
            blend.apply(i, pictures[i]);
            readSamples(samples, i, pictures[i]);
        }
        return meanSeamStep(samples);
    }

    /// Length of the wall's surface along a line of its plan.
    static double lengthAlong(bool vertical)
    {
        double length = 0.0;
        const int cells = vertical ? Rows : Columns;
        for (int i = 0; i < cells; ++i)
        {
            const auto at = [&](int k)
            {
                return vertical ? CapturedWall::pointAt(2.0, 3.0 * k / Rows)
                                : CapturedWall::pointAt(4.0 * k / Columns, 1.5);
            };
            length += glm::distance(at(i), at(i + 1));
        }
        return length;
    }

    support::TemporaryFolder _folder;
    ModelPhotos model;
    std::vector<PhotoSeam> seams;
    std::vector<SeamSample> samples;
    std::vector<Pixels> pictures, masks;
};

TEST_F(SeamBlendTest, seamsHaveTheLengthThatTheyHaveOnTheModel)
{
    load();
    double length = 0.0;
    for (const PhotoSeam& seam : seams)
        length += seam.length;
    // Numbers in an OBJ file are read as floats.
    EXPECT_NEAR(length, lengthAlong(true) + lengthAlong(false), 1e-5);
    EXPECT_EQ(seams.size(), std::size_t(Columns + Rows));
    const auto neighbours = findNeighbours(model.photos, seams);
    for (const auto& each : neighbours)
    {
        // Those at one side and above or below; the one across meets it in a point alone.
        ASSERT_EQ(each.size(), 2u);
        EXPECT_GE(each[0].length, each[1].length);
    }
    EXPECT_NEAR(neighbours[0][0].length + neighbours[0][1].length + neighbours[3][0].length +
                    neighbours[3][1].length,
                length, 1e-5);
    EXPECT_GT(neighbours[0][0].pixels, 100.0);
}

TEST_F(SeamBlendTest, cornersThatAreNotQuiteEqualAreOneWithinTheTolerance)
{
    load();
    const std::size_t found = seams.size();
    for (PhotoSurface& surface : model.photos[0].surfaces)
        for (glm::dvec3& place : surface.places)
            place += glm::dvec3(2e-4, -1e-4, 1e-4);
    EXPECT_EQ(findSeams(model.photos).size(), found - Columns / 2 - Rows / 2);
    EXPECT_EQ(findSeams(model.photos, 3e-4).size(), found);
}

TEST_F(SeamBlendTest, stepsAtSeamsAreGoneAndGradientsStay)
{
    load();
    const double before = meanSeamStep(samples);
    EXPECT_GT(before, 10.0);
    SeamBlend blend(model.photos, samples, [&](std::size_t i) { return masks[i]; });
    const BlendReport report = blend.solve();
    EXPECT_LT(report.residual, 1e-3);
    // Joints between bricks are as narrow as pixels, and two photographs never show them alike.
    EXPECT_LT(report.expectedStep, 0.15 * before);
    const std::vector<Pixels> originals = pictures;
    EXPECT_LT(stepAfter(blend), 0.15 * before);
    // From one pixel to the next, a correction changes by less than a step of 8 bits but for
    // rounding, so that what is in the photograph stays.
    int largest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (int y = 0; y < Height; ++y)
            for (int x = 0; x + 1 < Width; ++x)
                if (masks[i].row(y)[x] != 0 && masks[i].row(y)[x + 1] != 0)
                    for (int c = 0; c < 3; ++c)
                    {
                        const auto change = [&](int column) {
                            return int(pictures[i].row(y)[3 * column + c]) -
                                   int(originals[i].row(y)[3 * column + c]);
                        };
                        largest = std::max(largest, std::abs(change(x) - change(x + 1)));
                    }
    EXPECT_LE(largest, 3);
}

TEST_F(SeamBlendTest, pixelsThatTheModelDoesNotShowAreLeftAlone)
{
    load();
    SeamBlend blend(model.photos, samples, [&](std::size_t i) { return masks[i]; });
    blend.solve();
    const std::vector<Pixels> originals = pictures;
    stepAfter(blend);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t pixel = 0; pixel < masks[i].bytes.size(); ++pixel)
            for (std::size_t c = 0; c < 3; ++c)
            {
                const bool same =
                    pictures[i].bytes[3 * pixel + c] == originals[i].bytes[3 * pixel + c];
                EXPECT_TRUE(same || masks[i].bytes[pixel] != 0);
                changed += !same;
            }
    EXPECT_GT(changed, masks[0].bytes.size());
}

TEST_F(SeamBlendTest, photographsThatAgreeAreHardlyChanged)
{
    load(true);
    const double before = meanSeamStep(samples);
    SeamBlend blend(model.photos, samples, [&](std::size_t i) { return masks[i]; });
    blend.solve();
    double largest = 0.0;
    for (int y = 0; y < Height; y += 3)
        for (int x = 0; x < Width; x += 3)
            largest = std::max(largest, double(glm::length(blend.getCorrection(0, {x, y}))));
    // Joints of bricks are a few pixels wide: their edges are sampled differently.
    EXPECT_LT(before, 5.0);
    EXPECT_LT(largest, 12.0);
}

TEST_F(SeamBlendTest, cascadeAndPlainIterationFindTheSameCorrection)
{
    load();
    const auto mask = [&](std::size_t i) { return masks[i]; };
    SeamBlend cascade(model.photos, samples, mask), plain(model.photos, samples, mask);
    BlendSettings settings;
    settings.cell = 8;
    settings.error = 1e-8;
    settings.iterations = 5000;
    cascade.solve(settings);
    settings.cascade = false;
    plain.solve(settings);
    for (int y = 40; y < Height - 40; y += 7)
        for (int x = 70; x < Width - 70; x += 7)
        {
            const glm::vec3 difference =
                cascade.getCorrection(1, {x, y}) - plain.getCorrection(1, {x, y});
            EXPECT_LT(glm::length(difference), 0.01f) << x << ", " << y;
        }
}

TEST_F(SeamBlendTest, photographsWithoutSeamsHaveNoCorrection)
{
    Photo alone;
    alone.width = alone.height = 64;
    Pixels mask(64, 64, 1);
    std::fill(mask.bytes.begin(), mask.bytes.end(), std::uint8_t(255));
    SeamBlend blend({alone}, {}, [&](std::size_t) { return mask; });
    EXPECT_EQ(blend.solve().expectedStep, 0.0);
    EXPECT_EQ(blend.getCorrection(0, {30, 30}), glm::vec3(0.0f));
    SeamBlend nothing({}, {}, [&](std::size_t) { return mask; });
    EXPECT_EQ(nothing.solve().values, 0u);
}

} // namespace
