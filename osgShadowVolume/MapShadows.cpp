// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MapShadows.h>

#include <osgShadowVolume/Shaders.h>

#include <osg/GLExtensions>
#include <osg/Program>
#include <osgDB/ReadFile>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace osgShadowVolume
{

namespace
{

constexpr unsigned int mostSamples = 16; ///< On a side.

template <class Box> Hexahedron toHexahedron(const Box& box, const glm::dmat4& modelview)
{
    return boxOf(glm::make_vec3(box._min.ptr()), glm::make_vec3(box._max.ptr()), modelview);
}

glm::dmat4 worldFrom(const osgMultiRender::SurfaceFrame& frame)
{
    auto& stage = const_cast<osgUtil::RenderStage&>(frame.getStage());
    const osg::RefMatrix* view = stage.getInitialViewMatrix();
    glm::dmat4 toWorld =
        view ? glm::inverse(glm::dmat4(glm::make_mat4(view->ptr()))) : glm::dmat4(1.0);
    // In a mirror's picture the world is reflected; maps want a frame that is only turned.
    if (glm::determinant(glm::dmat3(toWorld)) < 0.0)
        for (int column = 0; column < 4; ++column)
            toWorld[column].x = -toWorld[column].x;
    return toWorld;
}

std::string plural(std::size_t number, const char* what)
{
    return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

} // namespace

MapShadows::MapShadows(const ShadowSettings& settings, ShadowResources& resources)
    : LightShadows(settings), _resources(resources),
      _samples(std::clamp(settings.mapSamples, 1u, mostSamples))
{
}

MapShadows::~MapShadows()
{
    if (_targets)
        _resources.maps.release(_contextID, _targets);
}

void MapShadows::begin(osg::RenderInfo&)
{
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &_largest);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS_EXT, &_maxLayers);
}

void MapShadows::draw(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame,
                      const std::vector<bool>& used,
                      const std::function<bool(const osgMultiRender::SurfaceItem&)>&)
{
    osg::State& state = *renderInfo.getState();
    _contextID = state.getContextID();
    _descriptions.assign(getLights().size(), std::string());
    std::vector<std::size_t> lights;
    for (std::size_t i = 0; i < getLights().size(); ++i)
        if (getDecision(i).index >= 0 && used[i])
            lights.push_back(i);
    if (lights.empty())
        return;
    _resources.casters->evict(state.getFrameStamp() ? state.getFrameStamp()->getFrameNumber() : 0);
    _meshes.assign(getCasters().size(), nullptr);
    std::vector<Placed> maps = fit(frame, lights);
    // Without a map the table alone is read: a light has none where it says so.
    _targets = _resources.maps.acquire(_contextID,
                                       {std::max(1u, _budget.size), std::max(1u, _budget.layers)});
    _bytes = _targets->getBytes();
    const FramebufferVisit visit(state);
    const std::string& status = _targets->whyIncomplete(state);
    if (!status.empty())
    {
        const int size = int(_budget.size);
        const std::string reason = _resources.warnIncomplete(status, size, size, 1);
        for (const Placed& placed : maps)
            _descriptions[placed.light] = reason;
        maps.clear();
    }
    _targets->setData(makeData(maps));
    state.pushStateSet(_targets->getDrawState());
    state.pushStateSet(&_resources.mapPrograms.get(_samples));
    state.apply();
    if (state.getLastAppliedProgramObject())
        for (const Placed& placed : maps)
            drawMap(renderInfo, placed);
    state.popStateSet();
    state.popStateSet();
}

std::vector<MapShadows::Placed> MapShadows::fit(const osgMultiRender::SurfaceFrame& frame,
                                                const std::vector<std::size_t>& lights)
{
    std::vector<unsigned int> layers;
    for (std::size_t light : lights)
        layers.push_back(mapKindOf(getLights()[light]) == ShadowMap::Cube ? 6 : 1);
    _budget = fitBudget(layers, getSettings().mapSize, unsigned(_largest), unsigned(_maxLayers),
                        std::size_t(getSettings().mapMegabytes) << 20);
    _boxes.clear();
    for (const Caster& caster : getCasters())
        _boxes.push_back(toHexahedron(caster.box, glm::make_mat4(caster.modelview->ptr())));

    MapView view;
    view.toWorld = worldFrom(frame);
    view.receivers.push_back(frustumOf(glm::make_mat4(getProjection()->ptr())));
    bool unbounded = false;
    const osg::BoundingBoxd bounds = frame.getBounds(osg::Matrixd(), unbounded);
    if (!unbounded && bounds.valid())
        view.receivers.push_back(toHexahedron(bounds, glm::dmat4(1.0)));

    std::vector<Placed> maps;
    unsigned int layer = 0;
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
        const std::size_t light = lights[i];
        if (i >= _budget.lights)
        {
            _descriptions[light] = "no shadow: there is no room for its map";
            continue;
        }
        view.casters.clear();
        for (std::uint32_t caster : getDecision(light).casters)
            view.casters.push_back(_boxes[caster]);
        const std::optional<ShadowMap> map =
            fitMap(getLights()[light], view, _budget.size, _samples);
        if (map)
            maps.push_back({light, layer, *map});
        else
            _descriptions[light] = "no caster between it and what is in view";
        layer += layers[i];
    }
    return maps;
}

CasterMesh& MapShadows::getMesh(std::uint32_t caster)
{
    osg::ref_ptr<CasterMesh>& mesh = _meshes[caster];
    if (!mesh)
        mesh = _resources.casters->get(getCasters()[caster].source);
    return *mesh;
}

void MapShadows::drawMap(osg::RenderInfo& renderInfo, const Placed& placed)
{
    static const unsigned int toMap = osg::Uniform::getNameID("osgsv_toMap");
    osg::State& state = *renderInfo.getState();
    const auto* gl = state.get<osg::GLExtensions>();
    const auto& program = *state.getLastAppliedProgramObject();
    const std::vector<std::uint32_t>& casters = getDecision(placed.light).casters;
    for (unsigned int face = 0; face < placed.map.getLayers(); ++face)
    {
        _targets->bind(state, placed.layer + face);
        glClear(GL_DEPTH_BUFFER_BIT);
        const glm::dmat4 matrix = placed.map.getMatrix(face);
        for (std::uint32_t index : casters)
        {
            if (!placed.map.mayShow(_boxes[index], face))
                continue;
            const Caster& caster = getCasters()[index];
            const glm::mat4 local(matrix * glm::dmat4(glm::make_mat4(caster.modelview->ptr())));
            gl->glUniformMatrix4fv(program.getUniformLocation(toMap), 1, GL_FALSE, &local[0][0]);
            getMesh(index).getTriangles()->draw(renderInfo);
            ++_drawCalls;
        }
    }
    _descriptions[placed.light] = plural(placed.map.getLayers(), "map") + " of " +
                                  std::to_string(_budget.size) +
                                  (_budget.isSmaller ? " (smaller than asked for)" : "") + ", " +
                                  plural(casters.size(), "caster");
}

std::vector<float> MapShadows::makeData(const std::vector<Placed>& maps) const
{
    std::size_t lights = 0;
    for (std::size_t i = 0; i < getLights().size(); ++i)
        lights = std::max<std::size_t>(lights, std::size_t(getDecision(i).index + 1));
    std::vector<float> data(lights * MapTargets::FloatsPerLight, 0.0f);
    for (std::size_t i = 0; i < lights; ++i)
        data[i * MapTargets::FloatsPerLight] = -1.0f; // no map
    for (const Placed& placed : maps)
    {
        const ShadowMap& map = placed.map;
        const glm::vec4 texels[] = {
            {float(map.kind), float(placed.layer), float(map.nearest), float(map.bias)},
            glm::vec4(map.rows[0]),
            glm::vec4(map.rows[1]),
            glm::vec4(map.rows[2]),
            {float(map.spread), float(_samples), 0.0f, 0.0f}};
        static_assert(sizeof(texels) == MapTargets::FloatsPerLight * sizeof(float));
        std::copy_n(&texels[0].x, MapTargets::FloatsPerLight,
                    data.begin() + std::ptrdiff_t(getDecision(placed.light).index) *
                                       MapTargets::FloatsPerLight);
    }
    return data;
}

std::string MapShadows::makeSource(bool) const
{
    osg::ref_ptr<osg::Shader> shader = osgDB::readRefShaderFileWithFallback(
        osg::Shader::FRAGMENT, "osgShadowVolume/map.frag", shaders::map_frag);
    return shader->getShaderSource();
}

std::vector<std::pair<std::string, int>> MapShadows::getSamplers() const
{
    return {{"osgsv_maps", MapTargets::MapsUnit}, {"osgsv_mapData", MapTargets::DataUnit}};
}

const osg::StateSet* MapShadows::getStateSet() const
{
    return _targets ? _targets->getStateSet() : nullptr;
}

void MapShadows::drawn(osg::RenderInfo&)
{
    if (_targets)
        _resources.maps.release(_contextID, _targets);
    _targets = nullptr;
}

std::string MapShadows::describe(std::size_t light) const
{
    return _descriptions.empty() ? std::string() : _descriptions[light];
}

void MapShadows::fillPlan(osgMultiRender::Plan& plan) const
{
    LightShadows::fillPlan(plan);
    plan.counts["shadows.drawCalls"] = _drawCalls;
    plan.counts["shadows.mapSize"] = _budget.size;
    plan.counts["shadows.mapLayers"] = _budget.layers;
    plan.counts["shadows.bytes"] = double(_bytes);
}

} // namespace osgShadowVolume
