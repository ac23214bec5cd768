// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualPass.h>

#include <osgPagedTexture/Shaders.h>

#include <osg/GLExtensions>
#include <osgDB/ReadFile>

#include <algorithm>

namespace osgPagedTexture
{

using osgMultiRender::SurfaceFrame;
using osgMultiRender::SurfaceItem;
using osgMultiRender::SurfaceKey;
using osgMultiRender::SurfaceSnippet;
using osgMultiRender::SurfaceState;
using osgMultiRender::TextureKey;

namespace
{

std::string shaderText(const char* file, const char* fallback)
{
    const osg::ref_ptr<osg::Shader> shader =
        osgDB::readRefShaderFileWithFallback(osg::Shader::FRAGMENT, file, fallback);
    return shader ? shader->getShaderSource() : std::string(fallback);
}

int wrapOf(osg::Texture::WrapMode mode)
{
    return mode == osg::Texture::REPEAT ? 1 : mode == osg::Texture::MIRROR ? 2 : 0;
}

} // namespace

VirtualPass::VirtualPass(std::shared_ptr<VirtualResources> resources)
    : _resources(std::move(resources)), _settings(_resources->getSettings())
{
}

void VirtualPass::begin(osg::RenderInfo& renderInfo, const SurfaceFrame& frame)
{
    osg::State& state = *renderInfo.getState();
    _frame = &frame;
    if (const osg::FrameStamp* stamp = state.getFrameStamp())
    {
        _frameNumber = stamp->getFrameNumber();
        _seconds = stamp->getReferenceTime();
    }
    if (_resources->hasTextures())
        _context = _resources->contextOf(state);
}

VirtualPass::Code VirtualPass::codeOf(const VirtualTexture& texture)
{
    const auto [found, isNew] = _codeOf.emplace(&texture, Code());
    if (!isNew)
        return found->second;
    const int number = _resources->numberOf(texture);
    if (number < 0 || number > int(VirtualTables::MaxTextures))
        return {};
    _context->add(std::uint32_t(number), texture);
    const int taps = _settings.anisotropy
                         ? int(_settings.anisotropy)
                         : std::clamp(int(texture.getMaxAnisotropy() + 0.5f), 1, 16);
    found->second = {number, taps | wrapOf(texture.getWrap(osg::Texture::WRAP_S)) << 8 |
                                 wrapOf(texture.getWrap(osg::Texture::WRAP_T)) << 10};
    return found->second;
}

/// What the sampling of a texture needs beyond a clamped trilinear lookup.
std::uint32_t VirtualPass::featuresOf(const Code& code) const
{
    return ((code.sampling & 255) > 1 ? Taps : 0u) | (code.sampling >> 8 ? Wraps : 0u) |
           (!_settings.wait && _settings.fadeSeconds > 0.0 ? Fades : 0u) |
           (_settings.show != VirtualShow::Picture ? Shows : 0u);
}

void VirtualPass::classify(const SurfaceState& state, const osgUtil::RenderLeaf&, bool,
                           SurfaceKey& key, std::uint32_t& number)
{
    if (!_context)
        return;
    std::array<const VirtualTexture*, Units> textures{};
    Codes codes{};
    for (unsigned int unit = 0; unit < Units; ++unit)
    {
        auto* texture =
            key.textures[unit].target == TextureKey::Target2D
                ? dynamic_cast<const VirtualTexture*>(state.get(unit, SurfaceState::Texture))
                : nullptr;
        const Code code = texture ? codeOf(*texture) : Code();
        if (code.number < 0)
            continue;
        textures[unit] = texture;
        codes[unit] = code;
        key.textures[unit].sampled = 1;
        key.texture |= 1u << unit | featuresOf(code);
    }
    if (!key.texture)
        return;
    const auto [found, isNew] = _numbers.emplace(textures, std::uint32_t(_codes.size()));
    if (isNew)
        _codes.push_back(codes);
    number = found->second;
}

SurfaceSnippet VirtualPass::makeSnippet(const SurfaceKey& key) const
{
    SurfaceSnippet snippet;
    if (key.texture & Sampled)
    {
        for (const auto& [bit, name] : {std::pair(Taps, "Taps"), std::pair(Wraps, "Wraps"),
                                        std::pair(Fades, "Fades"), std::pair(Shows, "Shows")})
            if (key.texture & bit)
                snippet.fragment += std::string("#define osgPagedTexture_") + name + "\n";
        snippet.fragment += shaderText("osgPagedTexture/virtual.glsl", shaders::virtual_glsl);
        snippet.samplers = {{"osgPagedTexture_table", int(VirtualContext::TableUnit)},
                            {"osgPagedTexture_pages", int(VirtualContext::PagesUnit)}};
    }
    if (!(key.texture & Feedback))
    {
        snippet.fragment +=
            shaderText("osgPagedTexture/virtualSample.glsl", shaders::virtualSample_glsl);
        return snippet;
    }
    snippet.vertex = "uniform vec2 osgPagedTexture_jitter;\n";
    snippet.vertexStatements = "    gl_Position.xy += osgPagedTexture_jitter * gl_Position.w;\n";
    if (key.texture & Cutout)
        snippet.statements += "    if (osgmr_out0.a < 0.5)\n        discard;\n";
    if (key.texture & Sheer)
        snippet.statements += "    if (((int(gl_FragCoord.x) ^ int(gl_FragCoord.y)) & 1) == 0)\n"
                              "        discard;\n";
    if (!(key.texture & Sampled))
    {
        snippet.statements += "    osgmr_out0 = vec4(0.0);\n";
        return snippet;
    }
    snippet.fragment +=
        shaderText("osgPagedTexture/virtualFeedback.glsl", shaders::virtualFeedback_glsl);
    // One unit a pixel, in turn.
    std::vector<unsigned int> units;
    for (unsigned int unit = 0; unit < Units; ++unit)
        if (key.texture & (1u << unit))
            units.push_back(unit);
    for (std::size_t i = 0; i < units.size(); ++i)
    {
        const std::string unit = std::to_string(units[i]);
        const std::string coord = "gl_TexCoord[" + unit + "]";
        snippet.statements +=
            "    vec4 need" + unit + " = osgPagedTexture_need(" + unit + ", " + coord + ".st / " +
            coord + ".q);\n    if ((int(gl_FragCoord.x) + int(osgPagedTexture_sharper.y)) % " +
            std::to_string(units.size()) + " == " + std::to_string(i) +
            ")\n        osgmr_out0 = need" + unit + ";\n";
    }
    return snippet;
}

const osg::StateSet* VirtualPass::startRun()
{
    _sent.clear();
    return _context ? &_context->getStateSet() : nullptr;
}

void VirtualPass::apply(osg::RenderInfo& renderInfo, const osgMultiRender::SurfaceVariant& variant,
                        const osgUtil::RenderLeaf&, std::uint32_t number)
{
    static const unsigned int gridsName = osg::Uniform::getNameID("osgPagedTexture_grids");
    static const unsigned int rowsName = osg::Uniform::getNameID("osgPagedTexture_rows");
    if (!_context || !(variant.getKey().texture & Sampled) || number >= _codes.size())
        return;
    const auto& program = *renderInfo.getState()->getLastAppliedProgramObject();
    const auto* gl = renderInfo.getState()->get<osg::GLExtensions>();
    GLfloat grids[Units][4] = {};
    GLint rows[Units][4] = {};
    for (unsigned int unit = 0; unit < Units; ++unit)
    {
        const Code& code = _codes[number][unit];
        if (code.number < 0)
            continue;
        const TileGrid& grid = _context->getGrid(std::uint32_t(code.number));
        const GLfloat sides[4] = {GLfloat(grid.getWidth()), GLfloat(grid.getHeight()),
                                  GLfloat(grid.getPayload()), GLfloat(grid.getBorder())};
        const GLint row[4] = {code.number,
                              _context->getTables().finestOf(std::uint32_t(code.number)),
                              pageLevels(grid) - 1, code.sampling};
        std::copy(sides, sides + 4, grids[unit]);
        std::copy(row, row + 4, rows[unit]);
    }
    gl->glUniform4fv(program.getUniformLocation(gridsName), Units, grids[0]);
    gl->glUniform4iv(program.getUniformLocation(rowsName), Units, rows[0]);
    if (_sent.insert(&variant).second)
        sendFrame(*renderInfo.getState());
}

/// What holds for all leaves of a program.
void VirtualPass::sendFrame(osg::State& state) const
{
    static const unsigned int slotsName = osg::Uniform::getNameID("osgPagedTexture_slots");
    static const unsigned int timeRowName = osg::Uniform::getNameID("osgPagedTexture_timeRow");
    static const unsigned int showName = osg::Uniform::getNameID("osgPagedTexture_show");
    static const unsigned int texelName = osg::Uniform::getNameID("osgPagedTexture_pixel");
    static const unsigned int timeName = osg::Uniform::getNameID("osgPagedTexture_time");
    const auto& program = *state.getLastAppliedProgramObject();
    const auto* gl = state.get<osg::GLExtensions>();
    const SlotGrid& slots = _context->getSlots();
    const UploadTexture& pages = _context->getPages();
    gl->glUniform3f(program.getUniformLocation(slotsName), float(slots.columns),
                    1.0f / float(slots.columns), float(slots.side));
    gl->glUniform1i(program.getUniformLocation(timeRowName), _context->getTables().getTimeRow());
    gl->glUniform1i(program.getUniformLocation(showName), int(_settings.show));
    gl->glUniform2f(program.getUniformLocation(texelName), 1.0f / float(pages.getTextureWidth()),
                    1.0f / float(pages.getTextureHeight()));
    // While nothing fades, no pixel asks.
    const bool fades =
        !_settings.wait && _seconds < _context->getLastArrival() + _settings.fadeSeconds;
    gl->glUniform2f(program.getUniformLocation(timeName), float(_seconds),
                    fades ? float(1.0 / _settings.fadeSeconds) : 0.0f);
}

void VirtualPass::fillPlan(osgMultiRender::Plan& plan) const
{
    using Decision = osgMultiRender::PlanEntry::Decision;
    for (const VirtualResources::Line& line : _resources->getLines())
    {
        osgMultiRender::PlanEntry entry{
            "virtual texture '" + line.file + "' " + std::to_string(line.width) + "x" +
                std::to_string(line.height),
            Decision::Drawn, std::to_string(line.pages) + " pages on all levels"};
        if (!line.error.empty())
            entry = {"virtual texture '" + line.file + "'", Decision::Dropped, line.error};
        else if (line.width == 0)
            entry = {"virtual texture '" + line.file + "'", Decision::Dropped,
                     "nothing in view uses it"};
        else if (_context && line.pages <= std::uint64_t(_context->getSlots().count()))
            entry.reason += ", all of which fit: plain or paged textures would do";
        plan.entries.push_back(entry);
    }
    plan.entries.push_back({"feedback", _hasFeedback ? Decision::Drawn : Decision::Dropped,
                            _hasFeedback
                                ? "a pixel stands for " + std::to_string(_settings.feedback) +
                                      " x " + std::to_string(_settings.feedback)
                                : "nothing has moved and all pages are there"});
    if (!_context)
        return;
    const VirtualPagerStatistics s = _context->getPager()->getStatistics();
    for (const auto& [name, value] : std::map<std::string, double>{
             {"pages.slots", double(s.slots)},
             {"pages.used", double(s.usedSlots)},
             {"pages.needed", double(s.neededPages)},
             {"pages.chosen", double(s.chosenPages)},
             {"pages.missing", double(s.missingPages)},
             {"pages.loading", double(s.loadingPages)},
             {"pages.failed", double(s.failedPages)},
             {"pages.uploaded", double(s.uploadedPages)},
             {"pages.uploadedThisFrame", double(_context->getLastPages())},
             {"upload.bytes", double(s.uploadedBytes)},
             {"upload.bytesThisFrame", double(_context->getLastUploaded())},
             {"levels.missing", double(s.bias)},
             {"pages.loaded", double(s.loadedPages)},
             {"store.bytesRead", double(s.bytesRead)},
             {"workers.seconds", s.workerSeconds},
             {"cache.hits", double(s.cacheHits)},
             {"cache.misses", double(s.cacheMisses)},
             {"cpu.bytes", double(s.cacheBytes)},
             {"switches", double(s.switches)},
             {"sharp.seconds", s.secondsUntilSharp},
             {"sharp.frames", double(s.framesUntilSharp)},
             {"feedback", double(_hasFeedback)},
             {"gpu.bytes",
              double(_context->getSlots().count()) * double(_context->getPager()->getPageBytes())}})
        plan.counts[name] = value;
}

} // namespace osgPagedTexture
