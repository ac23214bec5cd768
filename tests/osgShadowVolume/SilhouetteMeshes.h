// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/EdgeMesh.h>
#include <osgShadowVolume/Silhouette.h>

#include <glm/glm.hpp>

#include <array>
#include <string>
#include <vector>

/// A heap of triangles with lights that are hard to judge.
struct HardCase
{
    using Triangle = std::array<glm::vec3, 3>;

    std::string name;
    std::vector<Triangle> triangles;
    std::vector<glm::dvec4> lights;

    osgShadowVolume::EdgeMesh build() const;
};

/// Meshes on which judging triangles per edge leaks: a planar wall and a rotated box with lights in
/// their planes, slivers 1e-6 to 1e-4 thin, a sphere and a terrain; moved by `offset`.
std::vector<HardCase> hardCases(double offset);

/// That many triangles whose planes the light nearly touches, in strips that share edges.
HardCase grazingTriangles(std::size_t count);

/// `count` triangles at one edge, like the pages of a book.
HardCase book(unsigned int count);

/// A Moebius strip of 2 * `steps` triangles.
HardCase moebiusStrip(unsigned int steps);

/// Vertices at which the signed multiplicities of the edges do not sum to 0: leaks.
std::size_t openVertices(const osgShadowVolume::EdgeMesh& mesh,
                         const osgShadowVolume::MeshLight& light);
