// SPDX-License-Identifier: MIT
#include "ShapeMeshes.h"

#include <chrono>
#include <cstdio>
#include <functional>

/// Microseconds a fit, of shapes in random order of turns.
int main()
{
    using namespace shapemesh;
    const double whole = 2.0 * 3.14159265358979;
    const std::vector<std::pair<const char*, ShapeMesh>> meshes = {
        {"quad", quad(1, 2, 1)},
        {"box, shared vertices", box({1, 2, 3}, true)},
        {"box", box({1, 2, 3}, false)},
        {"pyramid", pyramid({1, 1, 1}, true)},
        {"cylinder of 12", frustum(1, 1, 5, 12, 1, FanCapped)},
        {"cylinder of 40", frustum(1, 1, 5, 40, 1, FanCapped)},
        {"cone of 24", frustum(1, 0, 2, 24, 1, FanCapped)},
        {"sphere of 24 x 12", sphere(1, 24, 12)},
        {"dish of 24 x 6", dish(1, 0.5, 24, 6, Open)},
        {"elbow of 8 x 16", torus(2, 1, 1.5707963, 8, 16, Open)},
        {"torus of 32 x 16", torus(2, 1, whole, 32, 16, Open)},
        {"profile", extrusion({{0, 0}, {3, 0}, {3, 0.5}, {0.5, 0.5}, {0.5, 2}, {0, 2}}, 4)}};
    for (const auto& [name, original] : meshes)
    {
        ShapeMesh mesh = original;
        mesh.move(glm::normalize(glm::dquat(0.4, 0.3, -0.7, 0.2)), {3, 1, 2});
        const std::vector<glm::vec3> vertices = mesh.vertices();
        int shape = 0;
        double best = 1e9;
        for (int round = 0; round != 5; ++round)
        {
            const int count = 2000;
            const auto start = std::chrono::steady_clock::now();
            for (int i = 0; i != count; ++i)
                shape = int(osgLabels::fitShape(vertices, mesh.indices).shape);
            const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
            best = std::min(best, 1e6 * taken.count() / count);
        }
        std::printf("%-22s %4zu triangles: %7.2f us, shape %d\n", name, mesh.indices.size() / 3,
                    best, shape);
    }
}
