// SPDX-License-Identifier: MIT
#include "MapFlight.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace cityPictures;

namespace
{

constexpr int Bits = 11;    ///< The first and the last one are set.
constexpr double Em = 14.0; ///< Pixels a line.

bool bitOf(std::size_t number, int bit)
{
    return bit == 0 || bit == Bits - 1 || (number >> (bit - 1) & 1) != 0;
}

/// Full blocks for bits that are set; others are spaces.
std::string codeOf(std::size_t number)
{
    std::string text;
    for (int bit = 0; bit < Bits; ++bit)
        text += bitOf(number, bit) ? "\xE2\x96\x88" : " ";
    return text;
}

} // namespace

MapFlight::MapFlight(const City& town, const std::string& settings, bool hasPast)
    : _labels(town.labels), _hasPast(hasPast)
{
    for (std::size_t i = 0; i < _labels.size(); ++i)
        _labels[i].text = codeOf(i);
    std::vector<InView> all;
    for (const osgLabels::MapLabel& label : _labels)
        all.push_back({label, 0.0, {}});
    _scene = makeScene(town.scene, all, "ink=#0000ff," + settings);
}

Picture MapFlight::draw(const support::CameraSpec& camera)
{
    _camera = camera;
    _time += FrameTime;
    viewer().setSimulationTime(_hasPast ? _time : 0.0);
    return render(*_scene, camera);
}

bool MapFlight::isShown(const osg::Image& picture, const InView& label) const
{
    const std::size_t number = static_cast<std::size_t>(
        std::find_if(_labels.begin(), _labels.end(),
                     [&](const auto& each) { return each.feature == label.label.feature; }) -
        _labels.begin());
    const double cell = 0.602 / 1.164 * Em; // of a line of DejaVu Sans Mono
    const glm::vec2 middle = 0.5f * (label.space.low + label.space.high);
    for (int bit = 0; bit < Bits; ++bit)
    {
        const double x = double(middle.x) + (bit - 0.5 * (Bits - 1)) * cell;
        const unsigned char* const p =
            picture.data(static_cast<unsigned int>(x), static_cast<unsigned int>(middle.y));
        const bool isInk =
            p[2] > 200 && p[0] < 55 && p[1]<55, isPlate = p[0]> 200 && p[1] < 55 && p[2] < 55;
        if (bitOf(number, bit) ? !isInk : !isPlate)
            return false;
    }
    return true;
}

MapFlight::Flips MapFlight::fly(double from, double seconds, double speed)
{
    Flips result;
    std::map<std::string, bool> before;
    std::map<std::string, std::vector<double>> times;
    double inView = 0.0;
    for (double time = 0.0; time < seconds - 1e-9; time += FrameTime)
    {
        const Picture picture = draw(cameraAt(from + time * speed));
        if (!picture)
            break;
        std::map<std::string, bool> now;
        for (const InView& label : labelsInView(_labels, _camera))
        {
            // All of the code is in the picture.
            const double half = 0.5 * Bits * Em;
            const glm::vec2 middle = 0.5f * (label.space.low + label.space.high);
            if (middle.x < half || middle.x > Width - half || middle.y < Em ||
                middle.y > Height - Em)
                continue;
            const std::string& name = label.label.feature;
            const bool shown = isShown(*picture, label);
            now[name] = shown;
            result.shown += shown;
            const auto last = before.find(name);
            if (last == before.end())
                continue;
            inView += 1.0;
            if (last->second == shown)
                continue;
            ++result.count;
            std::vector<double>& own = times[name];
            own.push_back(time);
            result.most =
                std::max(result.most,
                         unsigned(std::count_if(own.begin(), own.end(),
                                                [&](double t) { return t > time - 1.0 + 1e-6; })));
        }
        before = std::move(now);
        ++result.frames;
    }
    result.shown /= std::max(1u, result.frames);
    result.perLabelAndSecond = result.count / std::max(1.0, inView * FrameTime);
    return result;
}

unsigned int MapFlight::rest(unsigned int frames)
{
    const Picture first = draw(_camera);
    unsigned int differing = first ? 0 : frames;
    for (unsigned int i = 0; first && i < frames; ++i)
    {
        const Picture picture = draw(_camera);
        differing += !picture ||
                     !std::equal(picture->data(), picture->data() + picture->getTotalSizeInBytes(),
                                 first->data());
    }
    return differing;
}
