// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Declutter.h>

#include <cmath>
#include <random>

/// Labels of random sizes, places and priorities in a view of 800 x 600 pixels.
inline std::vector<osgLabels::DeclutterLabel> crowd(std::size_t count, unsigned int seed,
                                                    const glm::vec2& view = {800.0f, 600.0f})
{
    std::mt19937 engine(seed);
    const auto random = [&engine](float most) { return float(engine() * 0x1p-32 * most); };
    std::vector<osgLabels::DeclutterLabel> labels(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const glm::vec2 low(random(view.x) - 20.0f, random(view.y) - 10.0f);
        const float width = 30.0f + random(90.0f);
        labels[i] = {{low, {low.x + width, low.y + 16.0f}}, std::floor(random(10.0f)), i};
    }
    return labels;
}

/// Labels of a city of 4 x 4 km, seen by a camera that flies over it with a slight bend.
class CityFlight
{
public:
    explicit CityFlight(std::size_t count, const glm::vec2& view = {800.0f, 600.0f}) : _view(view)
    {
        std::mt19937 engine(3);
        const auto random = [&engine](double most) { return engine() * 0x1p-32 * most; };
        for (std::size_t i = 0; i < count; ++i)
            _places.push_back({random(4000.0) - 2000.0, random(4000.0), random(60.0) - 300.0,
                               std::floor(random(10.0)), 40.0 + random(80.0)});
    }

    /// Of all labels before the camera, also those beside the view.
    std::vector<osgLabels::DeclutterLabel> labelsAt(double seconds, double metersASecond) const
    {
        std::vector<osgLabels::DeclutterLabel> labels;
        const double turn = 1e-4 * metersASecond * seconds, c = std::cos(turn), s = std::sin(turn);
        for (std::size_t i = 0; i < _places.size(); ++i)
        {
            const Place& place = _places[i];
            const double y = place.y - metersASecond * seconds;
            const double depth = c * y + s * place.x, side = c * place.x - s * y;
            if (depth < 50.0)
                continue;
            const double x = _view.x * (0.5 + 0.7 * side / depth),
                         top = _view.y * 0.8 + _view.x * 0.7 * place.z / depth;
            labels.push_back({{{float(x - 0.5 * place.width), float(top)},
                               {float(x + 0.5 * place.width), float(top + 16.0)}},
                              place.priority,
                              i});
        }
        return labels;
    }

private:
    struct Place
    {
        double x, y, z, priority, width;
    };
    glm::vec2 _view;
    std::vector<Place> _places;
};
