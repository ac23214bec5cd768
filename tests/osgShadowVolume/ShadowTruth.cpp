// SPDX-License-Identifier: MIT
#include "TruthState.h"

#include <atomic>
#include <thread>

namespace truth
{

ShadowTruth::ShadowTruth(osg::Node& node, const support::CameraSpec& camera)
    : _state(new State(node, camera))
{
}

ShadowTruth::~ShadowTruth() = default;

const Scene& ShadowTruth::getScene() const
{
    return _state->scene;
}

const Light* ShadowTruth::findLight(int number) const
{
    for (const Light& light : _state->scene.lights)
        if (light.number == number)
            return &light;
    return nullptr;
}

Sample ShadowTruth::sample(const Light& light, double x, double y) const
{
    return _state->sample(_state->toEye(light), _state->rayAt(x, y));
}

Sample ShadowTruth::sampleByAll(const Light& light, double x, double y) const
{
    const EyeRay ray = _state->rayAt(x, y);
    Sample sample = _state->firstHitOfAll(ray);
    sample.seen = _state->judge(_state->toEye(light), ray, sample, &State::isOccludedByAny);
    return sample;
}

std::vector<Sample> ShadowTruth::render(const Light& light, int width, int height) const
{
    std::vector<Sample> samples(static_cast<std::size_t>(width) * height);
    const EyeLight eye = _state->toEye(light);
    std::atomic<int> next{0};
    const auto work = [&]
    {
        for (int y = next++; y < height; y = next++)
            for (int x = 0; x < width; ++x)
                samples[static_cast<std::size_t>(y) * width + x] =
                    _state->sample(eye, _state->rayAt(2.0 * (x + 0.5) / width - 1.0,
                                                      2.0 * (y + 0.5) / height - 1.0));
    };
    std::vector<std::thread> threads;
    for (unsigned int i = 1; i < std::thread::hardware_concurrency(); ++i)
        threads.emplace_back(work);
    work();
    for (std::thread& thread : threads)
        thread.join();
    return samples;
}

} // namespace truth
