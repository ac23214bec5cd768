// SPDX-License-Identifier: MIT
// Error of a blend of photographs against run time: by iterations, from nothing and from coarser
// grids.
//
//   SeamBlendBenchmark [width [rounds]]   of the four photographs, in pixels, default 1600
//
// Error is the root mean square distance of the corrections, in steps of 0 to 255, from those that
// 20,000 iterations give. Processor time, medians of interleaved rounds; CSV on standard output.
#include "CapturedWall.h"
#include "ExactMask.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/ModelPhotos.h>
#include <osgPagedTexture/SeamBlend.h>

#include <support/TemporaryFolder.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>

using namespace osgPagedTexture;

namespace
{

class Wall
{
public:
    explicit Wall(int width)
        : _model(readModelPhotos(
              CapturedWall(80, 60, width, width * 4 / 5).write(_folder.getPath().string()), true)),
          _samples(sampleSeams(_model.photos, findSeams(_model.photos)))
    {
        for (std::size_t i = 0; i < _model.photos.size(); ++i)
        {
            readSamples(_samples, i, readImageFile(_model.photos[i].file).pixels);
            _masks.push_back(ExactMask(_model.photos[i]).getMask());
        }
    }

    std::unique_ptr<SeamBlend> makeBlend() const
    {
        return std::make_unique<SeamBlend>(_model.photos, _samples,
                                           [this](std::size_t i) { return _masks[i]; });
    }
    double stepBefore() const { return meanSeamStep(_samples); }

    /// The corrections of all photographs, every 16 pixels.
    std::vector<glm::vec3> corrections(const SeamBlend& blend) const
    {
        std::vector<glm::vec3> found;
        for (std::size_t i = 0; i < _masks.size(); ++i)
            for (int y = 8; y < _masks[i].height; y += 16)
                for (int x = 8; x < _masks[i].width; x += 16)
                    if (_masks[i].row(y)[x] != 0)
                        found.push_back(blend.getCorrection(i, {x, y}));
        return found;
    }

private:
    const support::TemporaryFolder _folder;
    const ModelPhotos _model;
    std::vector<SeamSample> _samples;
    std::vector<Pixels> _masks;
};

double distance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += double(glm::dot(a[i] - b[i], a[i] - b[i])) / 3.0;
    return std::sqrt(sum / double(std::max<std::size_t>(a.size(), 1)));
}

struct Way
{
    BlendSettings settings;
    BlendReport report;
    double error = 0.0;
    std::vector<double> seconds{};
};

void solve(const Wall& wall, const std::vector<glm::vec3>& truth, Way& way)
{
    const auto blend = wall.makeBlend();
    const std::clock_t start = std::clock();
    way.report = blend->solve(way.settings);
    way.seconds.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
    way.error = distance(wall.corrections(*blend), truth);
}

} // namespace

int main(int argc, char** argv)
{
    const Wall wall(argc > 1 ? std::atoi(argv[1]) : 1600);
    const int rounds = argc > 2 ? std::atoi(argv[2]) : 3;
    BlendSettings exact;
    exact.iterations = 20000;
    exact.error = 1e-9;
    const auto reference = wall.makeBlend();
    reference->solve(exact);
    const std::vector<glm::vec3> truth = wall.corrections(*reference);
    std::vector<Way> ways;
    for (const bool cascade : {true, false})
        for (const int iterations : {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000})
        {
            Way way;
            way.settings.iterations = iterations;
            way.settings.error = 1e-9; // so that the iterations end it
            way.settings.cascade = cascade;
            ways.push_back(way);
        }
    for (int round = 0; round < rounds; ++round)
        for (Way& way : ways)
            solve(wall, truth, way);
    std::printf("start,iterations,seconds,error,residual,meanStep\n");
    for (Way& way : ways)
    {
        std::sort(way.seconds.begin(), way.seconds.end());
        std::printf("%s,%d,%.3f,%.4f,%.2e,%.3f\n", way.settings.cascade ? "coarser grids" : "zero",
                    way.settings.iterations, way.seconds[way.seconds.size() / 2], way.error,
                    way.report.residual, way.report.expectedStep);
    }
    std::fprintf(stderr, "mean step before: %.3f; %zu values, %d pixels apart\n", wall.stepBefore(),
                 ways[0].report.values, ways[0].report.cell);
}
