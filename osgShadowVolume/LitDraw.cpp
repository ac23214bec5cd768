// SPDX-License-Identifier: MIT
// What LitPass gives to the programs of the leaves.
#include <osgShadowVolume/LitPass.h>

#include <osgShadowVolume/LitBits.h>
#include <osgShadowVolume/Shaders.h>

#include <osg/GLExtensions>
#include <osgDB/ReadFile>

namespace osgShadowVolume
{

using osgMultiRender::LightingMode;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceSnippet;

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
    const bool measures = show == Show::LUX || show == Show::ILLUMINANCE;
    if (measures)
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
        if (measures && uniforms > 0)
            snippet.fragment += "    surface.normal = osgsv_seenNormal(surface);\n";
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
                    const osgUtil::RenderLeaf&, std::uint32_t number)
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

void LitPass::drawBefore(osg::RenderInfo& renderInfo, osgMultiRender::SurfaceFrame& frame)
{
    if (_shadows && !_lists.empty())
        _shadows->draw(renderInfo, frame, _used,
                       [&](const osgMultiRender::SurfaceItem& item) {
                           return item.variant && (item.variant->getKey().kit & Shadowed) &&
                                  frame.isOf(*this, item);
                       });
    _under = nullptr; // now there are shadows to be looked up
}

void LitPass::drawn(osg::RenderInfo& renderInfo)
{
    if (_shadows)
        _shadows->drawn(renderInfo);
    if (_mirrors)
        _mirrors->drawn();
}

} // namespace osgShadowVolume
