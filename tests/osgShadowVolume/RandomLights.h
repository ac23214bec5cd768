// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>

#include <cmath>
#include <random>
#include <vector>

/// Seeded lights and points for property tests: the same on every run and machine.
class RandomLights
{
public:
    explicit RandomLights(unsigned int seed) : _engine(seed) {}

    double uniform(double low, double high)
    {
        return low + (high - low) * (double(_engine()) / double(_engine.max()));
    }

    /// Evenly spread on a logarithmic scale.
    double scale(double low, double high)
    {
        return std::exp(uniform(std::log(low), std::log(high)));
    }

    unsigned int below(unsigned int n) { return _engine() % n; }

    glm::dvec3 point(const glm::dvec3& low, const glm::dvec3& high)
    {
        return {uniform(low.x, high.x), uniform(low.y, high.y), uniform(low.z, high.z)};
    }

    glm::dvec3 direction()
    {
        for (;;)
        {
            const glm::dvec3 d = point(glm::dvec3(-1.0), glm::dvec3(1.0));
            const double length = glm::length(d);
            if (length > 0.01 && length <= 1.0)
                return d / length;
        }
    }

    /// A light of any type with any attenuation; some are black or negative.
    osgShadowVolume::EyeLight light(const glm::dvec3& low, const glm::dvec3& high)
    {
        osgShadowVolume::EyeLight light;
        light.type = static_cast<osgShadowVolume::EyeLight::Type>(below(3));
        light.position =
            light.type == osgShadowVolume::EyeLight::Directional ? direction() : point(low, high);
        light.ambient = glm::vec3(point(glm::dvec3(0.0), glm::dvec3(0.2)));
        light.diffuse = glm::vec3(point(glm::dvec3(below(8) ? 0.0 : -1.0), glm::dvec3(1.0)));
        light.specular = glm::vec3(point(glm::dvec3(0.0), glm::dvec3(1.0)));
        light.constantAttenuation = below(4) ? 1.0f : float(uniform(0.0, 4.0));
        light.linearAttenuation = below(2) ? 0.0f : float(scale(1e-4, 10.0));
        light.quadraticAttenuation = below(3) ? float(scale(1e-6, 100.0)) : 0.0f;
        light.spotDirection = direction();
        light.spotCutoffDegrees = float(below(5) ? uniform(0.0, 90.0) : 90.0);
        light.spotExponent = float(uniform(0.0, 128.0));
        return light;
    }

private:
    std::mt19937 _engine;
};
