// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SeamBlend.h>

#include <osgPagedTexture/BlendGrid.h>
#include <osgPagedTexture/BlendSystem.h>

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

constexpr int FinestCell = 4; ///< That is chosen of itself.
constexpr std::size_t MostValues = 1000000;
constexpr std::size_t DirectValues = 20000; ///< Up to which a factorization is the fastest.

glm::vec3 valueAt(const BlendGrid& grid, const BlendValues& values, std::size_t photo,
                  const glm::dvec2& place)
{
    CellCorners corners;
    if (!grid.find(photo, place, corners))
        return glm::vec3(0.0f);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            sum[int(channel)] +=
                corners.shares[i] * values[channel][std::size_t(corners.values[i])];
    return glm::vec3(sum);
}

std::vector<CellMap> coarserMaps(const std::vector<CellMap>& maps)
{
    std::vector<CellMap> coarser;
    for (const CellMap& map : maps)
        coarser.push_back(map.coarser());
    return coarser;
}

} // namespace

struct SeamBlend::State
{
    std::vector<Photo> photos; ///< Sizes only.
    std::vector<SeamSample> samples;
    std::function<Pixels(std::size_t)> maskOf;
    std::unique_ptr<BlendGrid> grid;
    BlendValues values;

    std::vector<CellMap> mapsOf(int cell) const;
    void start(std::unique_ptr<BlendGrid> finer);
};

/// Cells that masks or seams use.
std::vector<CellMap> SeamBlend::State::mapsOf(int cell) const
{
    std::vector<CellMap> maps;
    for (std::size_t i = 0; i < photos.size(); ++i)
    {
        maps.emplace_back(photos[i].width, photos[i].height, cell);
        maps.back().add(maskOf(i));
    }
    for (const SeamSample& sample : samples)
    {
        for (const SeamSample::Side& side : sample.sides)
        {
            const glm::ivec2 at = maps[side.photo].cellAt(side.place);
            maps[side.photo].at(at.x, at.y) = 1;
        }
    }
    return maps;
}

/// Goes on to another grid, whose values start as the last one's.
void SeamBlend::State::start(std::unique_ptr<BlendGrid> next)
{
    BlendValues values_;
    for (std::vector<double>& channel : values_)
        channel.assign(next->getCount(), 0.0);
    for (std::size_t photo = 0; grid && photo < photos.size(); ++photo)
    {
        for (const auto& [number, place] : next->placesOf(photo))
        {
            // Corners lie between cells: any of the four may be the one that is used.
            glm::vec3 value(0.0f);
            for (int corner = 0; corner < 4 && value == glm::vec3(0.0f); ++corner)
                value = valueAt(*grid, values, photo,
                                place + 0.01 * glm::dvec2(corner % 2 * 2 - 1, corner / 2 * 2 - 1));
            for (std::size_t channel = 0; channel < 3; ++channel)
                values_[channel][std::size_t(number)] = value[int(channel)];
        }
    }
    grid = std::move(next);
    values = std::move(values_);
}

SeamBlend::SeamBlend(const std::vector<Photo>& photos, std::vector<SeamSample> samples,
                     std::function<Pixels(std::size_t photo)> maskOf)
    : _state(new State)
{
    for (const Photo& photo : photos)
    {
        _state->photos.emplace_back();
        _state->photos.back().width = photo.width;
        _state->photos.back().height = photo.height;
    }
    _state->samples = std::move(samples);
    _state->maskOf = std::move(maskOf);
}

SeamBlend::~SeamBlend() = default;

BlendReport SeamBlend::solve(const BlendSettings& settings)
{
    std::vector<std::unique_ptr<BlendGrid>> grids;
    grids.push_back(std::make_unique<BlendGrid>(
        _state->mapsOf(settings.cell > 0 ? settings.cell : FinestCell)));
    const auto addCoarser = [&]
    { grids.push_back(std::make_unique<BlendGrid>(coarserMaps(grids.back()->getMaps()))); };
    while (settings.cell == 0 && grids.back()->getCount() > MostValues)
    {
        addCoarser();
        grids.erase(grids.begin());
    }
    BlendReport report;
    report.values = grids[0]->getCount();
    report.cell = grids[0]->getMaps().empty() ? 0 : grids[0]->getMaps()[0].cell;
    const auto begin = std::chrono::steady_clock::now();
    while (settings.cascade && grids.back()->getCount() > DirectValues)
        addCoarser();
    _state->grid.reset();
    while (!grids.empty())
    {
        const bool coarsest = !_state->grid;
        _state->start(std::move(grids.back()));
        grids.pop_back();
        const BlendSolution solution =
            solveBlend(*_state->grid, _state->samples, _state->values, settings.iterations,
                       settings.error, settings.cascade && coarsest);
        report.iterations = solution.iterations;
        report.residual = solution.residual;
    }
    report.solveSeconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::vector<SeamSample> corrected = _state->samples;
    for (SeamSample& sample : corrected)
        for (SeamSample::Side& side : sample.sides)
            side.color += getCorrection(side.photo, side.place);
    report.expectedStep = meanSeamStep(corrected);
    return report;
}

glm::vec3 SeamBlend::getCorrection(std::size_t photo, const glm::dvec2& place) const
{
    return _state->grid ? valueAt(*_state->grid, _state->values, photo, place) : glm::vec3(0.0f);
}

void SeamBlend::apply(std::size_t photo, Pixels& pixels) const
{
    const Pixels mask = _state->maskOf(photo);
    for (int y = 0; y < pixels.height; ++y)
    {
        std::uint8_t* pixel = pixels.row(y);
        const std::uint8_t* used = mask.row(y);
        for (int x = 0; x < pixels.width; ++x, pixel += pixels.channels)
        {
            if (used[x] == 0)
                continue;
            const glm::vec3 correction = getCorrection(photo, {x + 0.5, y + 0.5});
            const float grey = (correction.x + correction.y + correction.z) / 3.0f;
            for (int channel = 0; channel < (pixels.channels < 3 ? 1 : 3); ++channel)
            {
                const float value =
                    float(pixel[channel]) + (pixels.channels < 3 ? grey : correction[channel]);
                pixel[channel] =
                    static_cast<std::uint8_t>(std::clamp(std::floor(value + 0.5f), 0.0f, 255.0f));
            }
        }
    }
}

} // namespace osgPagedTexture
