// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SeamSamples.h>

#include <osgPagedTexture/WrapCells.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

/// An edge may run along the border of two repeats: its middle decides.
glm::dvec2 placeOf(const Photo& photo, const PhotoSeam::Side& side, double share)
{
    const PhotoSurface& surface = photo.surfaces[side.surface];
    const glm::dvec2 point = glm::mix(glm::dvec2(side.from), glm::dvec2(side.to), share);
    return placeInPhoto(point, surface, {photo.width, photo.height});
}

double pixelsOf(const Photo& photo, const PhotoSeam::Side& side)
{
    return glm::length(glm::dvec2(side.to - side.from) * glm::dvec2(photo.width, photo.height));
}

glm::vec3 pixelAt(const Pixels& pixels, int x, int y)
{
    const std::uint8_t* pixel =
        pixels.row(std::clamp(y, 0, pixels.height - 1)) +
        std::ptrdiff_t(std::clamp(x, 0, pixels.width - 1)) * pixels.channels;
    return pixels.channels < 3 ? glm::vec3(pixel[0]) : glm::vec3(pixel[0], pixel[1], pixel[2]);
}

} // namespace

std::vector<SeamSample> sampleSeams(const std::vector<Photo>& photos,
                                    const std::vector<PhotoSeam>& seams)
{
    constexpr double MostOfAnEdge = 65536.0;
    std::vector<SeamSample> samples;
    for (const PhotoSeam& seam : seams)
    {
        double pixels = 1.0;
        for (const PhotoSeam::Side& side : seam.sides)
            pixels = std::max(pixels, std::ceil(pixelsOf(photos[side.photo], side)));
        const int count = int(std::min(pixels, MostOfAnEdge));
        for (int i = 0; i < count; ++i)
        {
            SeamSample sample;
            for (std::size_t side = 0; side < 2; ++side)
            {
                sample.sides[side].photo = seam.sides[side].photo;
                sample.sides[side].place =
                    placeOf(photos[seam.sides[side].photo], seam.sides[side], (i + 0.5) / count);
            }
            sample.weight = seam.length / count;
            samples.push_back(sample);
        }
    }
    return samples;
}

glm::vec3 lookUp(const Pixels& pixels, const glm::dvec2& place)
{
    const glm::dvec2 corner = glm::floor(place - 0.5);
    const glm::vec2 share(place - 0.5 - corner);
    const int x = int(corner.x), y = int(corner.y);
    return glm::mix(glm::mix(pixelAt(pixels, x, y), pixelAt(pixels, x + 1, y), share.x),
                    glm::mix(pixelAt(pixels, x, y + 1), pixelAt(pixels, x + 1, y + 1), share.x),
                    share.y);
}

void readSamples(std::vector<SeamSample>& samples, std::size_t photo, const Pixels& pixels)
{
    for (SeamSample& sample : samples)
        for (SeamSample::Side& side : sample.sides)
            if (side.photo == photo)
                side.color = lookUp(pixels, side.place);
}

double meanSeamStep(const std::vector<SeamSample>& samples)
{
    double sum = 0.0, weight = 0.0;
    for (const SeamSample& sample : samples)
    {
        const glm::dvec3 step(glm::abs(sample.sides[0].color - sample.sides[1].color));
        sum += sample.weight * (step.x + step.y + step.z) / 3.0;
        weight += sample.weight;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

} // namespace osgPagedTexture
