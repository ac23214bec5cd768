// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Image>
#include <osg/Node>
#include <osg/Vec2f>

#include <array>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

/// What the ray tracer of map labels knows of an OSG scene.
namespace mapTruth
{

/// What becomes of a label's pixel; the larger one counts where several things stand before it.
enum class Effect : unsigned char
{
    None,
    Fade,
    Recolor,
    Outline,
    Hide
};

/// What a drawable at the end of a path does to labels.
using EffectOf = std::function<Effect(const osg::NodePath& path)>;

/// By the nearest node of the path whose user value "labelClass", or name where it has none, is one
/// of the classes; Hide where there is none.
EffectOf effectByClass(std::vector<std::pair<std::string, Effect>> classes);

/// A drawable on a path.
struct Mesh
{
    std::set<std::string> names; ///< Of the nodes above it: the features that it belongs to.
    Effect effect = Effect::Hide;
    /// 1: closed, with triangles that are counterclockwise from outside in eye coordinates; -1:
    /// clockwise. 0: open, or not wound consistently.
    int outward = 0;
    /// Where a surface has less alpha than `leastAlpha` it is not there; null: it is everywhere.
    osg::ref_ptr<const osg::Image> alpha;
    float leastAlpha = 0.0f;
};

struct Triangle
{
    std::array<osg::Vec3d, 3> corners; ///< Eye coordinates.
    std::array<osg::Vec2f, 3> texCoords;
    osg::Vec3d normal; ///< Not unit.
    unsigned int mesh = 0;
};

/// Triangles of all drawables by the active children of the scene; not finite ones are left out.
struct Scene
{
    std::vector<Mesh> meshes;
    std::vector<Triangle> triangles;

    Scene(osg::Node& node, const osg::Matrixd& view, const EffectOf& effectOf);
};

/// Alpha from 0 to 1, between the four nearest texels, those at the edges continued.
float alphaAt(const osg::Image& image, const osg::Vec2f& texCoord);

} // namespace mapTruth
