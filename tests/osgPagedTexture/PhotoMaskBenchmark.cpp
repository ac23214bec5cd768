// SPDX-License-Identifier: MIT
#include "CapturedWall.h"
#include "PhotoMeshes.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/ModelPhotos.h>
#include <osgPagedTexture/PhotoMask.h>
#include <osgPagedTexture/SeamBlend.h>

#include <support/TemporaryFolder.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

using namespace osgPagedTexture;

namespace
{

double secondsOf(const std::function<void()>& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What a straightforward program does: for each triangle, its box; for each pixel of the box, the
/// three sides.
Pixels plainLoop(const Photo& photo)
{
    Pixels mask(photo.width, photo.height, 1);
    const std::vector<glm::vec2>& coordinates = photo.surfaces[0].coordinates;
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    {
        double x[3], y[3];
        for (std::size_t k = 0; k < 3; ++k)
        {
            x[k] = double(coordinates[i + k].x) * photo.width - 0.5;
            y[k] = double(coordinates[i + k].y) * photo.height - 0.5;
        }
        const auto [left, right] = std::minmax({x[0], x[1], x[2]});
        const auto [bottom, top] = std::minmax({y[0], y[1], y[2]});
        for (int py = std::max(0, int(std::ceil(bottom)));
             py <= std::min(photo.height - 1, int(std::floor(top))); ++py)
        {
            for (int px = std::max(0, int(std::ceil(left)));
                 px <= std::min(photo.width - 1, int(std::floor(right))); ++px)
            {
                bool above = true, below = true;
                for (int k = 0; k < 3; ++k)
                {
                    const int n = (k + 1) % 3;
                    const double side = (x[n] - x[k]) * (py - y[k]) - (y[n] - y[k]) * (px - x[k]);
                    above = above && side >= 0.0;
                    below = below && side <= 0.0;
                }
                if (above || below)
                    mask.row(py)[px] = 255;
            }
        }
    }
    return mask;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void measureMasks()
{
    const osg::ref_ptr<osg::GraphicsContext> context = makeOffscreenContext();
    MaskRenderer renderer(*context);
    std::printf("masks of 4064 x 2704 pixels, medians of 5, interleaved\n"
                "triangles   OpenGL ms   conservative ms   plain loop ms\n");
    for (int side : {70, 224, 707})
    {
        const Photo photo = photoOf(4064, 2704, jitteredGrid(side, side, 1.0));
        std::vector<double> gl, touched, loop;
        for (int turn = 0; turn < 6; ++turn)
        {
            const double a = secondsOf([&] { renderer.render(photo); });
            MaskSettings conservative;
            conservative.conservative = true;
            const double b = secondsOf([&] { renderer.render(photo, conservative); });
            const double c = secondsOf([&] { plainLoop(photo); });
            if (turn == 0)
                continue; // Compiles programs, takes memory.
            gl.push_back(a);
            touched.push_back(b);
            loop.push_back(c);
        }
        std::printf("%9zu %11.0f %17.0f %15.0f\n", photo.surfaces[0].coordinates.size() / 3,
                    1e3 * median(gl), 1e3 * median(touched), 1e3 * median(loop));
    }
}

/// How far corrections are from the solved ones, on a raster of places.
double distanceOf(const SeamBlend& a, const SeamBlend& b, int photos, int width, int height)
{
    double sum = 0.0;
    std::size_t count = 0;
    for (int photo = 0; photo < photos; ++photo)
        for (int y = 0; y < height; y += 16)
            for (int x = 0; x < width; x += 16, ++count)
            {
                const glm::vec3 off = a.getCorrection(std::size_t(photo), {x, y}) -
                                      b.getCorrection(std::size_t(photo), {x, y});
                sum += double(off.x * off.x + off.y * off.y + off.z * off.z) / 3.0;
            }
    return std::sqrt(sum / double(count));
}

void measureBlend(const std::string& folder)
{
    constexpr int Width = 640, Height = 512;
    const CapturedWall wall(80, 60, Width, Height);
    const ModelPhotos model = readModelPhotos(wall.write(folder), true);
    std::vector<SeamSample> samples = sampleSeams(model.photos, findSeams(model.photos));
    for (std::size_t i = 0; i < model.photos.size(); ++i)
        readSamples(samples, i, readImageFile(model.photos[i].file).pixels);
    const osg::ref_ptr<osg::GraphicsContext> context = makeOffscreenContext();
    MaskRenderer renderer(*context);
    std::vector<Pixels> masks;
    for (const Photo& photo : model.photos)
        masks.push_back(renderer.render(photo).pixels);
    const auto maskOf = [&](std::size_t i) { return masks[i]; };
    SeamBlend solved(model.photos, samples, maskOf);
    BlendSettings settings;
    settings.cell = 4;
    settings.iterations = 2000;
    settings.error = 1e-12; // None of the runs below ends before its iterations.
    std::printf("\nblend of 4 photographs of %d x %d, cells of 4; mean step before %.3f, solved "
                "%.3f\niterations   from 0: s, step, rms off   cascade: s, step, rms off\n",
                Width, Height, meanSeamStep(samples), solved.solve(settings).expectedStep);
    for (int iterations : {1, 2, 5, 10, 20, 50, 100})
    {
        std::printf("%10d", iterations);
        for (bool cascade : {false, true})
        {
            settings.cascade = cascade;
            settings.iterations = iterations;
            SeamBlend blend(model.photos, samples, maskOf);
            const BlendReport report = blend.solve(settings);
            std::printf("   %6.2f %6.3f %8.4f", report.solveSeconds, report.expectedStep,
                        distanceOf(blend, solved, 4, Width, Height));
        }
        std::printf("\n");
    }
}

} // namespace

/// `masks`, `blend`, or both.
int main(int argc, char** argv)
{
    const std::string part = argc > 1 ? argv[1] : "";
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    const support::TemporaryFolder folder;
    try
    {
        if (part != "blend")
            measureMasks();
        if (part != "masks")
            measureBlend(folder.getPath().string());
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
