// SPDX-License-Identifier: MIT
#include "MaskComparison.h"

#include <support/CompareImage.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

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

/// A pixel whose answer is asked for.
struct Question
{
    const ShadowTruth& truth;
    const Light& light;
    const Sample& sample; ///< At its center.
    osg::Vec2d center;    ///< In normalized device coordinates, as
    osg::Vec2d pixel;     ///< the size of a pixel.
    Seen seen;            ///< In the mask.
};

/// Whether an edge of a shadow or an object lies within a pixel: thin things lie between the
/// centers of pixels, and an object may end where what is behind it is as dark.
bool isEdgeNear(const Question& q)
{
    constexpr int Steps = 12; // on each side
    std::vector<int> known = {q.sample.triangle};
    for (int j = -Steps; j <= Steps; ++j)
    {
        for (int i = -Steps; i <= Steps; ++i)
        {
            const osg::Vec2d p =
                q.center + osg::Vec2d(q.pixel.x() * i / Steps, q.pixel.y() * j / Steps);
            const Sample near = q.truth.sample(q.light, p.x(), p.y());
            if (near.seen != q.sample.seen)
                return true;
            if (std::find(known.begin(), known.end(), near.triangle) != known.end())
                continue;
            known.push_back(near.triangle);
            if (q.truth.isObjectEdgeBetween(q.center, p))
                return true;
        }
    }
    for (const osg::Vec2d& point :
         q.truth.findEdgePoints(q.light, q.center.x(), q.center.y(), q.pixel))
        if (q.truth.sample(q.light, point.x(), point.y()).seen != q.sample.seen)
            return true;
    return false;
}

bool isWithinQuantum(const Question& q)
{
    const double x = q.center.x(), y = q.center.y();
    return q.truth.isWithinDepthQuantum(q.light, x, y, q.seen) ||
           q.truth.isWithinSnapping(q.light, x, y, q.pixel);
}

/// Sorts the wrong pixels of a picture that are away from the band and from grazing light.
class Excuses
{
public:
    /// The number that the pixel adds to.
    unsigned int& find(const Question& q, MaskDifference& difference)
    {
        const bool isAsked = _questions > 0;
        _questions -= isAsked;
        if (isAsked && isEdgeNear(q))
            return difference.wrongBand;
        if (isAsked && isWithinQuantum(q))
            return difference.withinQuantum;
        if (isWithinLightRounding(q))
            return difference.withinRounding;
        return difference.leaks;
    }

private:
    /// Whether the light lies so near to planes of casters that its float position may have
    /// decided.
    bool isWithinLightRounding(const Question& q)
    {
        if (touchesAny(q))
            return true;
        Light light = q.light;
        for (int side : {-1, 0, 1})
        {
            light.sideIfNear = side;
            if (q.truth.sample(light, q.center.x(), q.center.y()).seen == q.seen)
                return true;
        }
        return false;
    }

    /// On which side of a triangle that it touches the light lies is anybody's guess, and a wrong
    /// guess takes the triangle's shadow away where there is another's.
    bool touchesAny(const Question& q)
    {
        const Scene& scene = q.truth.getScene();
        if (!_touches)
            _touches =
                std::any_of(scene.triangles.begin(), scene.triangles.end(),
                            [&](const Triangle& triangle)
                            { return touches(triangle, scene.frames[triangle.frame], q.light); });
        return *_touches;
    }

    unsigned int _questions = 500; ///< They take long; what has more wrong pixels is wrong.
    std::optional<bool> _touches;
};

} // namespace

double MaskDifference::getErrorShare() const
{
    return object
               ? double(wrongBand + wrongGrazing + withinQuantum + withinRounding + leaks) / object
               : 0.0;
}

std::string MaskDifference::describe() const
{
    char line[400];
    std::snprintf(line, sizeof line,
                  "of %u pixels, %u shadowed and %u in the band, wrong in the band %u, at grazing "
                  "light %u (colors off by %.2f/255), within a quantum of depth %u, of the light "
                  "%u, leaks %u",
                  object, shadowed, band, wrongBand, wrongGrazing, 255.0 * worstGrazing,
                  withinQuantum, withinRounding, leaks);
    return line;
}

void MaskDifference::add(const MaskDifference& other)
{
    object += other.object;
    band += other.band;
    grazing += other.grazing;
    shadowed += other.shadowed;
    wrongBand += other.wrongBand;
    wrongGrazing += other.wrongGrazing;
    worstGrazing = std::max(worstGrazing, other.worstGrazing);
    withinQuantum += other.withinQuantum;
    withinRounding += other.withinRounding;
    leaks += other.leaks;
}

TruthPicture::TruthPicture(const ShadowTruth& truth, const Light& light, int w, int h)
    : width(w), height(h), samples(truth.render(light, w, h)), zones(samples.size())
{
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
}

double TruthPicture::getBandShare() const
{
    std::size_t band = 0, object = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
        object += samples[i].seen != Seen::NOTHING;
        band += samples[i].seen != Seen::NOTHING && zones[i] == Zone::BAND;
    }
    return object ? double(band) / double(object) : 0.0;
}

LightColor matteWhite(const TruthPicture& picture)
{
    return [&picture](int x, int y)
    { return static_cast<float>(picture.samples[y * picture.width + x].grazing); };
}

MaskDifference compareMask(const osg::Image& mask, const ShadowTruth& truth, const Light& light,
                           const TruthPicture& picture, const LightColor& color,
                           std::vector<unsigned char>* wrong)
{
    const int width = picture.width, height = picture.height;
    const osg::Vec2d pixel(2.0 / width, 2.0 / height);
    MaskDifference result;
    Excuses excuses;
    for (int i = 0; i < width * height; ++i)
    {
        const int x = i % width, y = i / width;
        const Sample& sample = picture.samples[i];
        const Zone zone = picture.zones[i];
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
        const float error = zone == Zone::GRAZING ? color(x, y) : 1.0f;
        const osg::Vec2d center(pixel.x() * (x + 0.5) - 1.0, pixel.y() * (y + 0.5) - 1.0);
        if (zone == Zone::GRAZING && error <= 1.0f / 255.0f)
            result.worstGrazing = std::max(result.worstGrazing, error);
        unsigned int& number =
            zone == Zone::BAND ? result.wrongBand
            : error <= 1.0f / 255.0f
                ? result.wrongGrazing
                : excuses.find({truth, light, sample, center, pixel, seen}, result);
        ++number;
        if (&number != &result.leaks)
            continue;
        if (result.leakPixels.size() < 100)
            result.leakPixels.emplace_back(x, y);
        if (wrong)
            wrong->back() = 2;
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
