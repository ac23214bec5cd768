// SPDX-License-Identifier: MIT
// What virtual and plain textures show against trilinear filtering in double precision.
#include "VirtualScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace
{

[[maybe_unused]] const bool filtersExactly = (virtuals::filterExactly(), true);

constexpr int Width = 320, Height = 240, Side = 1024;
constexpr double Floor = 10.0; ///< Units of its side; its middle is the origin.

using Color = std::array<double, 3>;

/// Bilinear, clamped to the edges; u and v from the bottom left corner.
Color sampleLevel(const osgPagedTexture::Pixels& level, double u, double v)
{
    const double x = u * level.width - 0.5, y = v * level.height - 0.5;
    const int left = int(std::floor(x)), low = int(std::floor(y));
    Color sum{};
    for (const auto& [column, row] :
         {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)})
    {
        const double weight = (column ? x - left : left + 1 - x) * (row ? y - low : low + 1 - y);
        const std::uint8_t* texel = level.row(std::clamp(low + row, 0, level.height - 1)) +
                                    level.channels * std::clamp(left + column, 0, level.width - 1);
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += weight * texel[c];
    }
    return sum;
}

Color sample(const virtuals::Levels& levels, double u, double v, double lod)
{
    const double level = std::clamp(lod, 0.0, double(levels.size() - 1));
    const auto finer = std::size_t(level);
    const Color a = sampleLevel(levels[finer], u, v);
    const Color b = sampleLevel(levels[std::min(finer + 1, levels.size() - 1)], u, v);
    const double share = level - double(finer);
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]),
            a[2] + share * (b[2] - a[2])};
}

/// The floor of a camera, where a point of the window meets it.
class Ground
{
public:
    explicit Ground(const support::CameraSpec& camera)
        : _toWorld(osg::Matrixd::inverse(camera.view * camera.projection))
    {
    }

    /// Texture coordinates; false beside the floor.
    bool at(double x, double y, double& u, double& v) const
    {
        const osg::Vec3d near =
            osg::Vec3d(2.0 * x / Width - 1.0, 2.0 * y / Height - 1.0, -1.0) * _toWorld;
        const osg::Vec3d far =
            osg::Vec3d(2.0 * x / Width - 1.0, 2.0 * y / Height - 1.0, 0.5) * _toWorld;
        const double t = near.z() / (near.z() - far.z());
        const osg::Vec3d hit = near + (far - near) * t;
        u = hit.x() / Floor + 0.5;
        v = hit.y() / Floor + 0.5;
        return t > 0.0 && std::min(u, v) > 0.0 && std::max(u, v) < 1.0;
    }

private:
    osg::Matrixd _toWorld;
};

/// How far pictures are from the truth.
struct Errors
{
    unsigned int pixels = 0;
    unsigned int off = 0; ///< By more than two steps of 255 in a channel.
    double worst = 0.0;   ///< Steps.
    double sum = 0.0;     ///< Of squares.

    void add(const Color& truth, const unsigned char* pixel)
    {
        double error = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            error = std::max(error, std::abs(truth[c] - double(pixel[c])));
        ++pixels;
        off += error > 2.0;
        worst = std::max(worst, error);
        sum += error * error;
    }
    double share() const { return double(off) / pixels; }
    double rms() const { return std::sqrt(sum / pixels); }
};

class VirtualFilterGLTest : public testing::TestWithParam<double>
{
protected:
    /// Pixels whose neighbours show the floor too.
    void compare(const support::CameraSpec& camera, const osg::Image& virtualPicture,
                 const osg::Image& plainPicture)
    {
        const Ground ground(camera);
        for (int y = 1; y + 1 < Height; ++y)
            for (int x = 1; x + 1 < Width; ++x)
            {
                double u, v, right[2], left[2], up[2], down[2];
                const double px = x + 0.5, py = y + 0.5;
                if (!ground.at(px, py, u, v) || !ground.at(px + 0.5, py, right[0], right[1]) ||
                    !ground.at(px - 0.5, py, left[0], left[1]) ||
                    !ground.at(px, py + 0.5, up[0], up[1]) ||
                    !ground.at(px, py - 0.5, down[0], down[1]))
                    continue;
                const double longer = std::max(std::hypot(right[0] - left[0], right[1] - left[1]),
                                               std::hypot(up[0] - down[0], up[1] - down[1]));
                const Color truth = sample(_levels, u, v, std::log2(longer * Side));
                _virtual.add(truth, virtualPicture.data(unsigned(x), unsigned(y)));
                _plain.add(truth, plainPicture.data(unsigned(x), unsigned(y)));
            }
    }

    const virtuals::Levels _levels = virtuals::makeLevels(Side, Side, 5);
    support::HeadlessViewer _viewer{{Width, Height}};
    support::TemporaryFolder _folder;
    Errors _virtual, _plain;
};

} // namespace

TEST_P(VirtualFilterGLTest, isNoFartherFromTheTruthThanPlainTexturing)
{
    OSGKITS_NEED_GL(_viewer);
    virtuals::buildStore(_folder.file("atlas"), _levels);
    const auto plain = virtuals::makeFloor(virtuals::makePlainTexture(_levels), float(Floor));
    const auto scene = virtuals::makeScene(
        virtuals::makeFloor(virtuals::makeVirtualTexture(_folder.file("atlas")), float(Floor)));
    const double angle = GetParam() * 0.017453292519943295;
    for (const double distance : {1.0, 6.0, 12.0})
    {
        const auto camera = support::CameraSpec::perspective(
            {0.3 * distance, -distance * std::cos(angle), distance * std::sin(angle)}, {},
            {0.0, 0.0, 1.0}, 50.0, double(Width) / Height, 1e-2, 1e3);
        compare(camera, *virtuals::settle(_viewer, *scene, scene, camera, Width, Height),
                *_viewer.render(plain, camera, Width, Height));
    }
    ASSERT_GT(_plain.pixels, 20000u) << "no proof";
    std::printf("%g degrees: virtual %.3f %% off, worst %.2f, rms %.4f; plain %.3f %%, worst %.2f, "
                "rms %.4f of 255\n",
                GetParam(), 100.0 * _virtual.share(), _virtual.worst, _virtual.rms(),
                100.0 * _plain.share(), _plain.worst, _plain.rms());
    // Where both are good to a rounding either may win.
    EXPECT_LE(_virtual.share(), 1.05 * _plain.share());
    EXPECT_LE(_virtual.rms(), 1.05 * _plain.rms());
    EXPECT_LE(_virtual.worst, _plain.worst + 0.5);
}

INSTANTIATE_TEST_SUITE_P(Degrees, VirtualFilterGLTest, testing::Values(10.0, 30.0, 60.0, 85.0));
