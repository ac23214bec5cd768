// SPDX-License-Identifier: MIT
#include "MaskComparison.h"

#include <support/CompareImage.h>

#include <algorithm>
#include <cmath>

namespace truth
{

namespace
{

constexpr double Grazing = 0.02;

Seen seenIn(const osg::Image& mask, int x, int y)
{
    const unsigned char* p = mask.data(x, y);
    if (p[0] == 255 && p[1] == 255 && p[2] == 255)
        return Seen::LIT;
    if (p[0] == 0 && p[1] == 0 && p[2] == 0)
        return Seen::SHADOWED;
    return Seen::NOTHING;
}

bool isRight(Seen mask, Seen truth)
{
    if (truth == Seen::UNREACHED)
        return mask != Seen::NOTHING;
    return mask == truth;
}

/// Whether one surface goes on from the one pixel to the other: each lies near the plane of the
/// other, seen from the eye.
bool goesOn(const Sample& a, const Sample& b)
{
    if (a.triangle == b.triangle)
        return true;
    const osg::Vec3d between = b.point - a.point;
    const double limit = 0.5 * between.length();
    return std::abs(between * a.normal) <= limit || std::abs(between * b.normal) <= limit;
}

bool isEdge(const Sample& a, const Sample& b)
{
    return a.seen != b.seen || (a.seen != Seen::NOTHING && !goesOn(a, b));
}

/// Whether anything but the sample's answer is found within a pixel: thin things lie between the
/// centers of pixels.
bool isEdgeNear(const ShadowTruth& truth, const Light& light, const Sample& center, double x,
                double y, double pixelX, double pixelY)
{
    constexpr int Steps = 12; // on each side
    for (int j = -Steps; j <= Steps; ++j)
    {
        for (int i = -Steps; i <= Steps; ++i)
        {
            const Sample near = truth.sample(light, x + pixelX * i / Steps, y + pixelY * j / Steps);
            if (near.seen != center.seen)
                return true;
        }
    }
    for (const osg::Vec2d& point : truth.findEdgePoints(light, x, y, {pixelX, pixelY}))
        if (truth.sample(light, point.x(), point.y()).seen != center.seen)
            return true;
    return false;
}

/// Whether the light lies so near to planes of casters that its float position may have decided.
bool isWithinLightRounding(const ShadowTruth& truth, Light light, double x, double y, Seen seen)
{
    // On which side of a triangle that it touches the light lies is anybody's guess, and a wrong
    // guess takes the triangle's shadow away where there is another's.
    for (const Triangle& triangle : truth.getScene().triangles)
        if (touches(triangle, truth.getScene().frames[triangle.frame], light))
            return true;
    for (int side : {-1, 0, 1})
    {
        light.sideIfNear = side;
        if (truth.sample(light, x, y).seen == seen)
            return true;
    }
    return false;
}

} // namespace

double MaskDifference::getErrorShare() const
{
    return object
               ? double(wrongBand + wrongGrazing + withinQuantum + withinRounding + leaks) / object
               : 0.0;
}

std::vector<Zone> zonesOf(const std::vector<Sample>& samples, int width, int height)
{
    std::vector<Zone> zones(samples.size());
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            const Sample& center = samples[y * width + x];
            bool edge = false;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                    edge = edge || isEdge(center, samples[v * width + u]);
            zones[y * width + x] = edge                           ? Zone::BAND
                                   : center.seen == Seen::NOTHING ? Zone::NOTHING
                                   : center.grazing < Grazing     ? Zone::GRAZING
                                                                  : Zone::OTHER;
        }
    }
    return zones;
}

double bandShare(const std::vector<Sample>& samples, int width, int height)
{
    const std::vector<Zone> zones = zonesOf(samples, width, height);
    std::size_t band = 0, object = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
        object += samples[i].seen != Seen::NOTHING;
        band += samples[i].seen != Seen::NOTHING && zones[i] == Zone::BAND;
    }
    return object ? double(band) / double(object) : 0.0;
}

MaskDifference compareMask(const osg::Image& mask, const ShadowTruth& truth, const Light& light,
                           const std::vector<Sample>& samples, std::vector<unsigned char>* wrong)
{
    const int width = mask.s(), height = mask.t();
    const std::vector<Zone> zones = zonesOf(samples, width, height);
    MaskDifference result;
    // A picture with so many wrong pixels is wrong; no need to look at each.
    unsigned int questions = 500;
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            const Sample& sample = samples[y * width + x];
            const Zone zone = zones[y * width + x];
            const bool object = sample.seen != Seen::NOTHING;
            result.object += object;
            result.shadowed += sample.seen == Seen::SHADOWED;
            result.band += object && zone == Zone::BAND;
            result.grazing += zone == Zone::GRAZING;
            const Seen seen = seenIn(mask, x, y);
            const bool right = isRight(seen, sample.seen);
            if (wrong)
                wrong->push_back(right ? 0 : 1);
            if (right)
                continue;
            const double ndcX = 2.0 * (x + 0.5) / width - 1.0;
            const double ndcY = 2.0 * (y + 0.5) / height - 1.0;
            if (zone == Zone::BAND)
                ++result.wrongBand;
            else if (zone == Zone::GRAZING)
                ++result.wrongGrazing;
            else if (questions && questions-- &&
                     isEdgeNear(truth, light, sample, ndcX, ndcY, 2.0 / width, 2.0 / height))
                ++result.wrongBand;
            else if (questions &&
                     (truth.isWithinDepthQuantum(light, ndcX, ndcY, seen) ||
                      truth.isWithinSnapping(light, ndcX, ndcY, {2.0 / width, 2.0 / height})))
                ++result.withinQuantum;
            else if (isWithinLightRounding(truth, light, ndcX, ndcY, seen))
                ++result.withinRounding;
            else
            {
                ++result.leaks;
                if (result.leakPixels.size() < 100)
                    result.leakPixels.emplace_back(x, y);
                if (wrong)
                    wrong->back() = 2;
            }
        }
    }
    return result;
}

osg::ref_ptr<osg::Image> toImage(const std::vector<Sample>& samples, int width, int height)
{
    static const unsigned char colors[][3] = {
        {51, 51, 102}, {255, 255, 255}, {0, 0, 0}, {128, 128, 128}};
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::copy_n(colors[int(samples[y * width + x].seen)], 3, image->data(x, y));
    return image;
}

std::string writePictures(const osg::Image& mask, const std::vector<Sample>& samples,
                          const std::vector<unsigned char>& wrong, const std::string& name)
{
    const int width = mask.s(), height = mask.t();
    const osg::ref_ptr<osg::Image> truth = toImage(samples, width, height);
    support::writeImage(*truth, name + ".truth");
    support::writeImage(mask, name + ".mask");
    // The truth, dimmed; what is wrong in blue, leaks in red with the pixels around them.
    const osg::ref_ptr<osg::Image> leaks = new osg::Image(*truth, osg::CopyOp::DEEP_COPY_ALL);
    for (unsigned char* p = leaks->data(); p != leaks->data() + leaks->getTotalSizeInBytes(); ++p)
        *p = static_cast<unsigned char>(*p / 2 + 32);
    const auto paint = [&](int x, int y, unsigned char r, unsigned char g, unsigned char b)
    {
        if (x < 0 || y < 0 || x >= width || y >= height)
            return;
        unsigned char* p = leaks->data(x, y);
        p[0] = r, p[1] = g, p[2] = b;
    };
    for (std::size_t i = 0; i < wrong.size(); ++i)
        if (wrong[i] == 2)
            for (int v = -1; v <= 1; ++v)
                for (int u = -1; u <= 1; ++u)
                    paint(int(i) % width + u, int(i) / width + v, 255, 160, 0);
    for (std::size_t i = 0; i < wrong.size(); ++i)
        if (wrong[i])
            paint(int(i) % width, int(i) / width, wrong[i] == 2 ? 255 : 0, 0,
                  wrong[i] == 2 ? 0 : 255);
    return support::writeImage(*leaks, name + ".leaks");
}

} // namespace truth
