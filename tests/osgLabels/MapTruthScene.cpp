// SPDX-License-Identifier: MIT
#include "MapTruthScene.h"

#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Texture>
#include <osg/TriangleFunctor>
#include <osg/TriangleIndexFunctor>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>
#include <map>

namespace mapTruth
{

namespace
{

struct Corner
{
    osg::Vec3f place;
    osg::Vec2f texCoord;
};
using Corners = std::array<Corner, 3>;

struct PlainSink
{
    std::vector<Corners>* triangles = nullptr;
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c)
    {
        triangles->push_back({{{a, {}}, {b, {}}, {c, {}}}});
    }
};

struct IndexSink
{
    std::vector<Corners>* triangles = nullptr;
    const osg::Vec3Array* places = nullptr;
    const osg::Vec2Array* texCoords = nullptr;

    Corner at(unsigned int i) const
    {
        return {(*places)[i], texCoords ? (*texCoords)[i] : osg::Vec2f()};
    }
    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        triangles->push_back({{at(a), at(b), at(c)}});
    }
};

std::vector<Corners> trianglesOf(osg::Drawable& drawable)
{
    std::vector<Corners> triangles;
    const osg::Geometry* const geometry = drawable.asGeometry();
    const auto* const places =
        geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
    if (places)
    {
        osg::TriangleIndexFunctor<IndexSink> sink;
        sink.triangles = &triangles;
        sink.places = places;
        sink.texCoords = dynamic_cast<const osg::Vec2Array*>(geometry->getTexCoordArray(0));
        drawable.accept(sink);
    }
    else
    {
        osg::TriangleFunctor<PlainSink> sink;
        sink.triangles = &triangles;
        drawable.accept(sink);
    }
    const auto isFinite = [](const Corner& corner) { return corner.place.valid(); };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                                   [&](const Corners& t)
                                   { return !std::all_of(t.begin(), t.end(), isFinite); }),
                    triangles.end());
    return triangles;
}

/// Whether each edge has as many partners that run the other way; triangles without a third
/// corner have no say.
bool isClosed(const std::vector<Corners>& triangles)
{
    std::map<std::pair<osg::Vec3f, osg::Vec3f>, int> balance;
    for (const Corners& t : triangles)
        for (int k = 0; k < 3; ++k)
        {
            const osg::Vec3f &a = t[k].place, &b = t[(k + 1) % 3].place;
            if (a < b)
                ++balance[{a, b}];
            else if (b < a)
                --balance[{b, a}];
        }
    return !balance.empty() && std::all_of(balance.begin(), balance.end(),
                                           [](const auto& edge) { return edge.second == 0; });
}

/// Six times the volume; about a corner, so that nothing is lost far from the origin.
double volumeOf(const std::vector<Triangle>& triangles, std::size_t first)
{
    double volume = 0.0;
    for (std::size_t i = first; i < triangles.size(); ++i)
    {
        const osg::Vec3d o = triangles[first].corners[0];
        const auto& c = triangles[i].corners;
        volume += (c[0] - o) * ((c[1] - o) ^ (c[2] - o));
    }
    return volume;
}

/// Takes what counts of the state on the way to a drawable.
void takeAlphaTest(Mesh& mesh, const osg::NodePath& path, const osg::Drawable& drawable)
{
    bool isTested = false;
    const osg::Image* image = nullptr;
    const auto look = [&](const osg::StateSet* state)
    {
        if (!state)
            return;
        const auto mode = state->getMode(GL_ALPHA_TEST);
        if (!(mode & osg::StateAttribute::INHERIT))
            isTested = mode & osg::StateAttribute::ON;
        if (const auto* test = dynamic_cast<const osg::AlphaFunc*>(
                state->getAttribute(osg::StateAttribute::ALPHAFUNC)))
            mesh.leastAlpha = test->getReferenceValue();
        if (const auto* texture = dynamic_cast<const osg::Texture*>(
                state->getTextureAttribute(0, osg::StateAttribute::TEXTURE)))
            image = texture->getImage(0);
    };
    for (const osg::Node* node : path)
        look(node->getStateSet());
    look(drawable.getStateSet());
    if (isTested)
        mesh.alpha = image;
}

class Collector : public osg::NodeVisitor
{
public:
    Collector(Scene& scene, const osg::Matrixd& view, const EffectOf& effectOf)
        : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), _scene(scene), _view(view),
          _effectOf(effectOf)
    {
    }

    void apply(osg::Drawable& drawable) override
    {
        const std::vector<Corners> triangles = trianglesOf(drawable);
        if (triangles.empty())
            return;
        Mesh mesh;
        for (const osg::Node* node : getNodePath())
            if (!node->getName().empty())
                mesh.names.insert(node->getName());
        mesh.effect = _effectOf(getNodePath());
        takeAlphaTest(mesh, getNodePath(), drawable);
        const osg::Matrixd toEye = osg::computeLocalToWorld(getNodePath()) * _view;
        const std::size_t first = _scene.triangles.size();
        for (const Corners& corners : triangles)
        {
            Triangle triangle;
            for (int k = 0; k < 3; ++k)
            {
                triangle.corners[k] = osg::Vec3d(corners[k].place) * toEye;
                triangle.texCoords[k] = corners[k].texCoord;
            }
            triangle.normal = (triangle.corners[1] - triangle.corners[0]) ^
                              (triangle.corners[2] - triangle.corners[0]);
            triangle.mesh = static_cast<unsigned int>(_scene.meshes.size());
            _scene.triangles.push_back(triangle);
        }
        if (isClosed(triangles))
            mesh.outward = volumeOf(_scene.triangles, first) < 0.0 ? -1 : 1;
        _scene.meshes.push_back(std::move(mesh));
    }

private:
    Scene& _scene;
    const osg::Matrixd _view;
    const EffectOf& _effectOf;
};

} // namespace

EffectOf effectByClass(std::vector<std::pair<std::string, Effect>> classes)
{
    return [classes = std::move(classes)](const osg::NodePath& path)
    {
        for (auto node = path.rbegin(); node != path.rend(); ++node)
        {
            std::string name = (*node)->getName();
            (*node)->getUserValue("labelClass", name);
            for (const auto& [known, effect] : classes)
                if (name == known)
                    return effect;
        }
        return Effect::Hide;
    };
}

Scene::Scene(osg::Node& node, const osg::Matrixd& view, const EffectOf& effectOf)
{
    Collector collector(*this, view, effectOf);
    node.accept(collector);
}

float alphaAt(const osg::Image& image, const osg::Vec2f& texCoord)
{
    const double x = double(texCoord.x()) * image.s() - 0.5,
                 y = double(texCoord.y()) * image.t() - 0.5;
    const double left = std::floor(x), bottom = std::floor(y);
    const auto texel = [&](double column, double row)
    {
        return image
            .getColor(static_cast<unsigned int>(std::clamp(column, 0.0, image.s() - 1.0)),
                      static_cast<unsigned int>(std::clamp(row, 0.0, image.t() - 1.0)))
            .a();
    };
    const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - bottom);
    const float low = texel(left, bottom) * (1.0f - fx) + texel(left + 1.0, bottom) * fx;
    const float high =
        texel(left, bottom + 1.0) * (1.0f - fx) + texel(left + 1.0, bottom + 1.0) * fx;
    return low * (1.0f - fy) + high * fy;
}

} // namespace mapTruth
