// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LitPass.h>

#include <osgShadowVolume/EyeLights.h>
#include <osgShadowVolume/RadicalInverse.h>
#include <osgShadowVolume/Shaders.h>

#include <osg/GLExtensions>
#include <osgDB/ReadFile>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

using osgMultiRender::LightingMode;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceSnippet;
using osgMultiRender::SurfaceState;

namespace
{

/// Lights of a state up to which each leaf is tested for those that reach it; more go to a grid.
constexpr std::size_t maxListed = 32;
constexpr std::size_t maxUniform = 8; ///< Lights up to which a leaf has them as uniforms.

/// Bits of SurfaceKey::kit. Uniform lights: their number from bit 4, two bits for the type of each
/// from bit 8.
enum KitBits : std::uint32_t
{
    Listed = 1,
    Gridded = 2,
    Shadowed = 4,    ///< A light of the leaf may be taken away.
    Transparent = 8, ///< Looks visibility up by its depth.
    NumberShift = 4,
    TypesShift = 8,
    TechniqueShift = 24,    ///< LightShadows::getVariantBits(), three bits.
    ShowShift = 27,         ///< Show, three bits.
    FaceNormals = 1u << 30, ///< The model has no normals: those of its triangles.
    Reflecting = 1u << 31   ///< A mirror.
};

std::uint32_t numberOfUniformLights(std::uint32_t kit)
{
    return (kit >> NumberShift) & 15u;
}

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

LitPass::LitPass(const LitScene& scene) : LitPass(scene, ShadowSettings(), nullptr) {}

LitPass::LitPass(const LitScene& scene, const ShadowSettings& settings,
                 std::unique_ptr<LightShadows> shadows)
    : _scene(scene),
      _lighting(measuresLight(settings) ? LitScene::Lighting::PIXEL : scene.getLighting()),
      _lightScope(measuresLight(settings) ? LitScene::LightScope::ALL : scene.getLightScope()),
      _tolerance(scene.getLightTolerance()), _settings(settings)
{
    if (_lighting == LitScene::Lighting::PIXEL)
        _shadows = std::move(shadows);
}

void LitPass::cull(osgUtil::CullVisitor& visitor, osgMultiRender::SurfaceGroup& group)
{
    if (_shadows)
        _shadows->cull(visitor, group);
    if (_mirrors)
        _mirrors->cull(visitor, group);
    if (measuresLight(_settings))
        _measures = _illuminance->measure(visitor, group, _settings);
}

bool LitPass::isDynamic() const
{
    return _shadows && _shadows->isDynamic();
}

LightingMode LitPass::getLighting() const
{
    switch (_lighting)
    {
    case LitScene::Lighting::OFF:
        return LightingMode::Off;
    case LitScene::Lighting::VERTEX:
        return LightingMode::Vertex;
    case LitScene::Lighting::PIXEL:
        break;
    }
    return LightingMode::Pixel;
}

void LitPass::begin(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceFrame& frame)
{
    std::map<int, std::size_t> lastOf;
    std::vector<EyeLight> all;
    frame.forEachLight(
        [&](const osg::Light& light, const osg::Matrix* matrix, bool isHeadlight)
        {
            EyeLight eye = toEye(light, matrix);
            eye.isHeadlight = isHeadlight;
            if (_shadows && _shadows->isShadowless(light))
                eye.castsShadow = false;
            if (measuresLight(_settings) && !measure(eye, light, frame))
                return;
            if (_lightScope == LitScene::LightScope::MODES)
            {
                const auto [found, isNew] = lastOf.emplace(light.getLightNum(), all.size());
                if (!isNew) // GL keeps the last one of a number.
                {
                    all[found->second] = eye;
                    return;
                }
            }
            all.push_back(eye);
        });
    if (_lighting != LitScene::Lighting::PIXEL)
    {
        for (const EyeLight& light : all)
        {
            if (_lighting == LitScene::Lighting::OFF)
                _dropped.push_back({light, "lighting is off"});
            else if (light.number >= int(SurfaceState::MaxGLLights))
                _dropped.push_back({light, "GL has lights 0 to 7 only; lighting=pixel has all"});
            else
            {
                _lights.push_back(light);
                _used.push_back(true);
            }
        }
        return;
    }
    chooseGridAxes(frame);
    bool unbounded = false;
    const osg::BoundingBoxd box = frame.getBounds(_toGrid, unbounded);
    _hasBox = box.valid();
    _boxMin = glm::dvec3(box.xMin(), box.yMin(), box.zMin());
    _boxMax = glm::dvec3(box.xMax(), box.yMax(), box.zMax());
    _hasBox = _hasBox && std::isfinite(glm::length(_boxMax - _boxMin));
    const bool everythingBounded = _hasBox && !unbounded;
    const osg::Vec3d middle = osg::Matrixd::inverse(_toGrid).preMult(box.center());
    const glm::dvec3 center(middle.x(), middle.y(), middle.z());
    const double radius = 0.5 * glm::length(_boxMax - _boxMin);
    // Half of the tolerance is for what the whole view leaves out, half for what a leaf does.
    const double threshold = 0.5 * _tolerance / std::max<std::size_t>(1, all.size());
    std::vector<double> limits;
    for (const EyeLight& light : all)
    {
        if (!isUsable(light))
            continue;
        if (_settings.lightShown >= 0 && light.number != _settings.lightShown)
        {
            _dropped.push_back({light, "another light is shown alone"});
            continue;
        }
        const double reach = reachOf(light, threshold);
        if (brightness(light) == 0.0 && !lightsUnlit())
            _dropped.push_back({light, "it is black"});
        else if (everythingBounded && !reaches(light, reach, center, radius))
            _dropped.push_back({light, "it reaches nothing in view"});
        else
        {
            _lights.push_back(light);
            limits.push_back(reach);
        }
    }
    _used.assign(_lights.size(), false);
    if (_shadows)
    {
        _shadows->begin(renderInfo);
        GLint viewport[4];
        glGetIntegerv(GL_VIEWPORT, viewport);
        const glm::dmat4 toEye(glm::make_mat4(osg::Matrixd::inverse(_toGrid).ptr()));
        const Hexahedron receivers = everythingBounded
                                         ? boxOf(_boxMin, _boxMax, toEye)
                                         : boxOf(glm::dvec3(1.0), glm::dvec3(-1.0), toEye);
        _shadows->plan({viewport[0], viewport[1], viewport[2], viewport[3]}, receivers, _lights,
                       limits);
    }
    if (_lights.size() > maxListed && _hasBox)
        for (unsigned int i = 0; i < 64; ++i)
        {
            const glm::dvec3 p =
                _boxMin + (_boxMax - _boxMin) * glm::dvec3(radicalInverse(i + 1, 2),
                                                           radicalInverse(i + 1, 3),
                                                           radicalInverse(i + 1, 5));
            const osg::Vec3d eye =
                osg::Matrixd::inverse(_toGrid).preMult(osg::Vec3d(p.x, p.y, p.z));
            _points.emplace_back(eye.x(), eye.y(), eye.z());
        }
}

void LitPass::chooseGridAxes(const osgMultiRender::SurfaceFrame& frame)
{
    auto& stage = const_cast<osgUtil::RenderStage&>(frame.getStage());
    if (!stage.getInitialViewMatrix())
        return;
    // A view matrix may scale; only its rotation counts.
    const osg::Quat rotation = stage.getInitialViewMatrix()->getRotate();
    if (std::isfinite(rotation.length2()) && rotation.length2() > 0.0)
        _toGrid.makeRotate(rotation.inverse());
}

glm::dvec3 LitPass::toGrid(const glm::dvec3& eye) const
{
    const osg::Vec3d p = osg::Vec3d(eye.x, eye.y, eye.z) * _toGrid;
    return {p.x(), p.y(), p.z()};
}

bool LitPass::isUsable(const EyeLight& light)
{
    const double values[] = {brightness(light),
                             glm::dot(light.position, light.position),
                             glm::dot(light.spotDirection, light.spotDirection),
                             double(light.constantAttenuation),
                             double(light.linearAttenuation),
                             double(light.quadraticAttenuation),
                             double(light.spotCutoffDegrees),
                             double(light.spotExponent)};
    if (std::all_of(std::begin(values), std::end(values),
                    [](double x) { return std::isfinite(x); }))
        return true;
    _dropped.push_back({light, "a parameter of it is infinite or not a number"});
    return false;
}

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

void LitPass::classify(const SurfaceState& state, const osgUtil::RenderLeaf& leaf, SurfaceKey& key,
                       std::uint32_t& number)
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

void LitPass::drawBefore(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame)
{
    if (_shadows && !_lists.empty())
        _shadows->draw(renderInfo, frame, _used,
                       [](const osgMultiRender::SurfaceItem& item)
                       { return item.variant && (item.variant->getKey().kit & Shadowed); });
    _under = nullptr; // now there are shadows to be looked up
}

void LitPass::drawn(osg::RenderInfo& renderInfo)
{
    if (_shadows)
        _shadows->drawn(renderInfo);
    if (_mirrors)
        _mirrors->drawn();
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

bool LitPass::isUniform(const List& list) const
{
    return !list.grid && list.lights.size() <= maxUniform;
}

void LitPass::end(osg::RenderInfo& renderInfo)
{
    if (_lighting != LitScene::Lighting::PIXEL || _lists.empty())
        return;
    bool needsTextures = false;
    for (List& list : _lists)
    {
        if (!isUniform(list))
        {
            needsTextures = true;
            continue;
        }
        list.uniforms.resize(list.lights.size() * FloatsPerLight);
        for (std::size_t i = 0; i < list.lights.size(); ++i)
            packLight(_lights[list.lights[i]], shadowIndexOf(list.lights[i]),
                      &list.uniforms[i * FloatsPerLight]);
    }
    if (!needsTextures)
        return;
    // Only lights that some leaf uses go to the GPU.
    std::vector<const EyeLight*>& lights = _gpuLights;
    std::vector<std::int32_t>& data = _gpuLists;
    std::vector<std::int32_t> index(_lights.size(), 0);
    for (std::size_t i = 0; i < _lights.size(); ++i)
        if (_used[i])
        {
            index[i] = static_cast<std::int32_t>(lights.size());
            lights.push_back(&_lights[i]);
            _gpuShadows.push_back(shadowIndexOf(i));
        }
    for (List& list : _lists)
    {
        if (isUniform(list))
            continue;
        list.offset = static_cast<int>(data.size());
        for (std::uint32_t light : list.lights)
            data.push_back(index[light]);
        if (!list.grid)
            continue;
        const LightGrid& grid = *list.grid->grid;
        const int base = static_cast<int>(data.size());
        for (std::uint32_t light : grid.getIndices())
            data.push_back(index[light]);
        list.gridCells = static_cast<int>(data.size());
        for (std::size_t cell = 0; cell + 1 < grid.getOffsets().size(); ++cell)
        {
            data.push_back(base + static_cast<int>(grid.getOffsets()[cell]));
            data.push_back(static_cast<int>(grid.getOffsets()[cell + 1] - grid.getOffsets()[cell]));
        }
    }
    _textures = _scene._textures->get(renderInfo.getContextID());
    _textures->set(this, lights, _gpuShadows, data);
}

SurfaceSnippet LitPass::makeSnippet(const SurfaceKey& key) const
{
    SurfaceSnippet snippet;
    if (key.kit & Reflecting)
    {
        snippet.output = Mirrors::makeSource();
        snippet.samplers.emplace_back("osgsv_reflection", Mirrors::ReflectionUnit);
    }
    if (key.lighting != LightingMode::Pixel)
        return snippet;
    const auto show = static_cast<Show>((key.kit >> ShowShift) & 7u);
    if (show == Show::MASK)
    {
        snippet.fragment = "#define OSGSV_MASK\n";
        snippet.output = "vec4 osgmr_output(vec4 surface)\n{\n"
                         "    return vec4(vec3(osgsv_lightLeft), 1.0);\n}\n";
    }
    if (show == Show::LUX || show == Show::ILLUMINANCE)
    {
        snippet.fragment = "#define OSGSV_ILLUMINANCE\n";
        snippet.output = illuminanceSource(show == Show::ILLUMINANCE);
    }
    if (key.kit & FaceNormals)
        snippet.fragment += "#define OSGSV_FACE_NORMALS\n";
    if (key.kit & Shadowed)
    {
        snippet.fragment += "#define OSGSV_SHADOWS\n";
        snippet.fragment += _shadows->makeSource((key.kit & Transparent) != 0);
        for (const auto& sampler : _shadows->getSamplers())
            snippet.samplers.push_back(sampler);
    }
    const std::uint32_t uniforms = numberOfUniformLights(key.kit);
    if (key.kit & Gridded)
        snippet.fragment += "#define OSGSV_GRID\n";
    if (!(key.kit & (Gridded | Listed)))
        snippet.fragment += "#define OSGSV_UNIFORM " + std::to_string(uniforms) + "\n";
    osg::ref_ptr<osg::Shader> shader = osgDB::readRefShaderFileWithFallback(
        osg::Shader::FRAGMENT, "osgShadowVolume/lights.frag", shaders::lights_frag);
    snippet.fragment += shader->getShaderSource();
    if (!(key.kit & (Gridded | Listed)))
    {
        snippet.fragment += "void osgmr_addLights(osgmr_Lit surface, inout vec3 ambient, "
                            "inout vec3 diffuse, inout vec3 specular)\n{\n";
        for (std::uint32_t i = 0; i < uniforms; ++i)
            snippet.fragment += "    osgsv_addLight(" + std::to_string(i) + ", " +
                                std::to_string((key.kit >> (TypesShift + 2 * i)) & 3u) +
                                ".0, surface, ambient, diffuse, specular);\n";
        snippet.fragment += "}\n";
        return snippet;
    }
    snippet.samplers.emplace_back("osgsv_lights", LitScene::LightTextures::LightsUnit);
    snippet.samplers.emplace_back("osgsv_lists", LitScene::LightTextures::ListsUnit);
    return snippet;
}

const osg::StateSet* LitPass::startRun()
{
    _applied.clear();
    if (_textures && !_textures->isOf(this))
        _textures->set(this, _gpuLights, _gpuShadows, _gpuLists);
    return mergeUnder({_textures ? _textures->stateSet.get() : nullptr,
                       _shadows ? _shadows->getStateSet() : nullptr,
                       measuresLight(_settings) ? IlluminanceView::getStateSet() : nullptr});
}

const osg::StateSet* LitPass::mergeUnder(std::initializer_list<const osg::StateSet*> stateSets)
{
    const osg::StateSet* only = nullptr;
    int count = 0;
    for (const osg::StateSet* stateSet : stateSets)
        if (stateSet)
        {
            only = stateSet;
            ++count;
        }
    if (count < 2)
        return only;
    if (!_under)
    {
        _under = new osg::StateSet;
        for (const osg::StateSet* stateSet : stateSets)
            if (stateSet)
                _under->merge(*stateSet);
    }
    return _under.get();
}

void LitPass::apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
                    std::uint32_t number)
{
    const auto [applied, isNew] = _applied.emplace(&variant, number);
    if (!isNew && applied->second == number)
        return;
    applied->second = number;
    // osg::Program trims "[0]" off the names of arrays.
    static const unsigned int uniforms = osg::Uniform::getNameID("osgsv_light");
    static const unsigned int range = osg::Uniform::getNameID("osgsv_range");
    static const unsigned int axes = osg::Uniform::getNameID("osgsv_gridAxes");
    static const unsigned int origin = osg::Uniform::getNameID("osgsv_gridOrigin");
    static const unsigned int scale = osg::Uniform::getNameID("osgsv_gridScale");
    static const unsigned int size = osg::Uniform::getNameID("osgsv_gridSize");
    static const unsigned int maximum = osg::Uniform::getNameID("osgsv_maximum");
    static const unsigned int cells = osg::Uniform::getNameID("osgsv_gridCells");

    osg::State& state = *renderInfo.getState();
    const auto& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    if (variant.getKey().kit & Shadowed)
        _shadows->apply(program, *gl);
    if (variant.getKey().kit & Reflecting)
    {
        const Reflection& reflection = _reflections[number];
        _mirrors->apply(state, program, reflection.mirror);
        number = reflection.list;
    }
    if (_settings.show == Show::ILLUMINANCE)
        gl->glUniform1f(program.getUniformLocation(maximum), float(_measures.maximum));
    if (!(variant.getKey().kit & ((1u << TypesShift) - 1u)))
        return; // no light
    const List& list = _lists[number];
    if (isUniform(list))
    {
        gl->glUniform4fv(program.getUniformLocation(uniforms), int(list.uniforms.size() / 4),
                         list.uniforms.data());
        return;
    }
    gl->glUniform2i(program.getUniformLocation(range), list.offset, int(list.lights.size()));
    if (!list.grid)
        return;
    const LightGrid& grid = *list.grid->grid;
    const glm::dvec3 o = grid.getOrigin(), c = grid.getCellSize();
    const glm::ivec3 n = grid.getSize();
    float columns[9];
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            columns[3 * column + row] =
                float(_toGrid(column, row)); // osg's rows are GLSL's columns
    gl->glUniformMatrix3fv(program.getUniformLocation(axes), 1, GL_FALSE, columns);
    gl->glUniform3f(program.getUniformLocation(origin), float(o.x), float(o.y), float(o.z));
    gl->glUniform3f(program.getUniformLocation(scale), float(1.0 / c.x), float(1.0 / c.y),
                    float(1.0 / c.z));
    gl->glUniform3i(program.getUniformLocation(size), n.x, n.y, n.z);
    gl->glUniform1i(program.getUniformLocation(cells), list.gridCells);
}

} // namespace osgShadowVolume
