// SPDX-License-Identifier: MIT
// Which lights each leaf gets, and by which program.
#include <osgShadowVolume/LitPass.h>

#include <osgShadowVolume/LitBits.h>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

using osgMultiRender::LightingMode;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceState;

namespace
{

/// The most that a matrix stretches a length.
double stretchOf(const osg::Matrixd& m)
{
    const osg::Vec3d rows[3] = {
        {m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
    const double a = rows[0].length2(), b = rows[1].length2(), c = rows[2].length2();
    const double skew = std::max(
        {std::abs(rows[0] * rows[1]), std::abs(rows[1] * rows[2]), std::abs(rows[2] * rows[0])});
    // Rotations and scalings have rows at right angles; for others the Frobenius norm is a bound.
    const double largest = std::max({a, b, c});
    return std::sqrt(skew <= 1e-6 * largest ? largest * (1.0 + 4e-6) : a + b + c);
}

/// A sphere in eye coordinates around a leaf; false for one without a finite bound.
bool sphereOf(const osgUtil::RenderLeaf& leaf, glm::dvec3& center, double& radius)
{
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (!box.valid())
        return false;
    osg::Vec3d middle = box.center();
    radius = box.radius();
    if (leaf._modelview.valid())
    {
        middle = middle * *leaf._modelview;
        radius *= stretchOf(*leaf._modelview);
    }
    center = {middle.x(), middle.y(), middle.z()};
    return std::isfinite(radius) && std::isfinite(glm::length(center));
}

} // namespace

void LitPass::fillReach(LightSet& set) const
{
    double threshold = 0.5 * _tolerance / std::max<std::size_t>(1, set.lights.size());
    if (set.lights.size() > maxListed)
    {
        std::vector<EyeLight> lights;
        for (std::uint32_t light : set.lights)
            lights.push_back(_lights[light]);
        threshold = thresholdFor(lights, _points, 0.5 * _tolerance);
    }
    set.reach.assign(_lights.size(), 0.0);
    for (std::uint32_t light : set.lights)
        set.reach[light] = reachOf(_lights[light], threshold);
}

LitPass::LightSet& LitPass::setOf(const SurfaceState& state)
{
    const bool all = _lightScope == LitScene::LightScope::ALL;
    const std::pair<std::uint32_t, const void*> key =
        all ? std::make_pair(0u, static_cast<const void*>(nullptr))
            : std::make_pair(state.getModes() & (SurfaceState::Light0 * 255u),
                             state.getExtraLightsIdentity());
    const auto [found, isNew] = _sets.try_emplace(key);
    LightSet& set = found->second;
    if (!isNew)
        return set;
    for (std::uint32_t i = 0; i < _lights.size(); ++i)
        if (all || state.isLightOn(_lights[i].number) ||
            _lights[i].number >= int(osgMultiRender::FirstUnscopedLight))
            set.lights.push_back(i);
    fillReach(set);
    set.reachesAll = std::all_of(set.lights.begin(), set.lights.end(),
                                 [&](std::uint32_t light)
                                 {
                                     return !std::isfinite(set.reach[light]) &&
                                            (_lights[light].type != EyeLight::Spot ||
                                             _lights[light].spotCutoffDegrees >= 90.0f);
                                 });
    if (set.lights.size() > maxListed && _hasBox)
        makeGrid(set);
    return set;
}

void LitPass::makeGrid(LightSet& set)
{
    std::vector<EyeLight> lights = _lights;
    for (EyeLight& light : lights)
    {
        light.position = toGrid(light.position);
        light.spotDirection = toGrid(light.spotDirection);
    }
    // All grids of a frame share a texture.
    const double maxPairs = LightGrid::MaxPairs / double(++_grids);
    set.grid.emplace(lights, set.reach, set.lights, _boxMin, _boxMax, maxPairs);
    List list;
    list.lights = set.grid->getEverywhere();
    list.grid = &set;
    for (std::uint32_t light : list.lights)
        _used[light] = true;
    for (std::uint32_t light : set.grid->getIndices())
        _used[light] = true;
    set.gridNumber = static_cast<std::uint32_t>(_lists.size());
    _lists.push_back(std::move(list));
}

std::uint32_t LitPass::listOf(std::vector<std::uint32_t> lights)
{
    const auto [found, isNew] =
        _listNumbers.emplace(lights, static_cast<std::uint32_t>(_lists.size()));
    if (isNew)
    {
        for (std::uint32_t light : lights)
            _used[light] = true;
        _lists.emplace_back();
        _lists.back().lights = std::move(lights);
    }
    return found->second;
}

bool LitPass::classifiesUnlit() const
{
    return lightsUnlit() || (_mirrors && _mirrors->isAny());
}

bool LitPass::lightsUnlit() const
{
    return _settings.show != Show::PICTURE && _settings.show != Show::VOLUMES;
}

void LitPass::classify(const SurfaceState& state, const osgUtil::RenderLeaf& leaf, bool,
                       SurfaceKey& key, std::uint32_t& number)
{
    if (key.lighting == LightingMode::Pixel || lightsUnlit())
        classifyLights(state, leaf, key, number);
    if (key.kit || lightsUnlit())
        addShadowBits(state, leaf, key, number);
    if (_mirrors && _mirrors->isAny())
        addMirrorBit(state, leaf, key, number);
}

void LitPass::addMirrorBit(const SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                           SurfaceKey& key, std::uint32_t& number)
{
    const int mirror = _mirrors->reflect(leaf, state.isOn(SurfaceState::Blend));
    if (mirror < 0)
        return;
    key.kit |= Reflecting;
    _reflections.push_back({number, mirror});
    number = static_cast<std::uint32_t>(_reflections.size() - 1);
}

void LitPass::addShadowBits(const SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                            SurfaceKey& key, std::uint32_t number) const
{
    if (lightsUnlit())
    {
        key.lighting = LightingMode::Pixel;
        key.kit |= std::uint32_t(_settings.show) << ShowShift;
        const osg::Geometry* geometry = leaf._drawable->asGeometry();
        if (measuresLight(_settings) && geometry && !geometry->getNormalArray())
            key.kit |= FaceNormals;
    }
    const bool lit = (key.kit & ((1u << TypesShift) - 1u)) != 0;
    if (!_shadows || !lit || !hasShadow(_lists[number]) || !_shadows->receives(leaf, state))
        return;
    key.kit |= Shadowed | (_shadows->getVariantBits() << TechniqueShift);
    if (!state.isOpaque())
        key.kit |= Transparent;
}

bool LitPass::hasShadow(const List& list) const
{
    const auto has = [this](std::uint32_t light) { return shadowIndexOf(light) >= 0.0f; };
    if (list.grid)
        return std::any_of(list.grid->lights.begin(), list.grid->lights.end(), has);
    return std::any_of(list.lights.begin(), list.lights.end(), has);
}

float LitPass::shadowIndexOf(std::size_t light) const
{
    return _shadows ? float(_shadows->getDecision(light).index) : -1.0f;
}

void LitPass::classifyLights(const SurfaceState& state, const osgUtil::RenderLeaf& leaf,
                             SurfaceKey& key, std::uint32_t& number)
{
    LightSet& set = setOf(state);
    if (set.forAll)
    {
        key.kit = set.forAll->kit;
        number = set.forAll->number;
        return;
    }
    glm::dvec3 center;
    double radius = 0.0;
    const bool isInGrid = _hasBox && sphereOf(leaf, center, radius);
    if (isInGrid && set.lights.size() > maxListed)
    {
        key.kit = Gridded;
        number = set.gridNumber;
        return;
    }
    std::vector<std::uint32_t> reaching = set.lights;
    if (isInGrid && !set.reachesAll)
        reaching.erase(
            std::remove_if(reaching.begin(), reaching.end(),
                           [&](std::uint32_t light)
                           { return !reaches(_lights[light], set.reach[light], center, radius); }),
            reaching.end());
    if (reaching.empty())
        return; // a program without lights
    // Equal types side by side, so that few orders of the same lights make variants.
    std::stable_sort(reaching.begin(), reaching.end(),
                     [this](std::uint32_t a, std::uint32_t b)
                     { return _lights[a].type < _lights[b].type; });
    if (reaching.size() <= maxUniform)
    {
        key.kit = static_cast<std::uint32_t>(reaching.size()) << NumberShift;
        for (std::size_t i = 0; i < reaching.size(); ++i)
            key.kit |= std::uint32_t(_lights[reaching[i]].type) << (TypesShift + 2 * i);
    }
    else if (isInGrid)
    {
        // Of lights that reach the leaf, few may reach a pixel.
        if (!set.grid)
            makeGrid(set);
        key.kit = Gridded;
        number = set.gridNumber;
        return;
    }
    else
        key.kit = Listed;
    const bool fewForAll = set.reachesAll && reaching.size() <= maxUniform;
    number = listOf(std::move(reaching));
    if (fewForAll)
        set.forAll = LightSet::ForAll{key.kit, number};
}

} // namespace osgShadowVolume
