// SPDX-License-Identifier: MIT
#include <osgLabels/MapMemory.h>

#include <osg/FrameBufferObject>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

using osgMultiRender::TargetTexture;

void MapMemory::declutter(std::vector<PlacedLabel>& labels, const PixelBox& view, double time)
{
    std::vector<DeclutterLabel> wanted;
    wanted.reserve(labels.size());
    for (const PlacedLabel& label : labels)
    {
        const auto pixel = [&](double x, double y)
        { return glm::vec2(float(x - view.left), float(y - view.bottom)); };
        wanted.push_back({{pixel(label.plate.left, label.plate.bottom),
                           pixel(label.plate.right, label.plate.top)},
                          label.label->priority,
                          label.label->key});
    }
    const std::vector<std::uint8_t>& shown = _declutter.update(
        wanted, glm::vec2(float(view.right - view.left), float(view.top - view.bottom)), time);
    std::size_t count = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (shown[i])
            labels[count++] = labels[i];
    labels.resize(count);
}

std::vector<std::uint32_t> MapMemory::begin(osg::State& state,
                                            const std::vector<PlacedLabel>& labels, double time)
{
    const bool isCut = !_framebuffer || !(time > _time) || _contextID != state.getContextID();
    if (!_framebuffer || _contextID != state.getContextID())
    {
        _contextID = state.getContextID();
        _framebuffer = std::make_unique<osgMultiRender::Framebuffer>(_contextID);
        _textures[0] = _textures[1] = nullptr;
    }
    _start = isCut ? time : _start;
    _time = time;
    std::vector<std::uint32_t> last;
    std::unordered_map<std::uint64_t, std::uint32_t> indices;
    for (const PlacedLabel& label : labels)
    {
        const auto found = _indices.find(label.label->key);
        last.push_back(isCut || found == _indices.end() ? 0 : found->second + 1);
        indices.emplace(label.label->key, std::uint32_t(indices.size()));
    }
    _indices = std::move(indices);
    _current = 1 - _current;
    // The last frame's keep their size, whatever it is.
    _rows = int((labels.size() + RowLength - 1) / RowLength);
    osg::ref_ptr<TargetTexture>& texture = _textures[_current];
    if (!texture || texture->getTextureHeight() != _rows)
        texture = new TargetTexture(GL_RGBA32F_ARB, RowLength, _rows, 0, 1);
    return last;
}

void MapMemory::bind(osg::State& state, osg::StateSet& stateSet, int unit)
{
    _framebuffer->bind(state, 1);
    _textures[_current]->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    const osg::ref_ptr<TargetTexture>& old = _textures[1 - _current];
    if (old)
        stateSet.setTextureAttribute(unsigned(unit), old, osg::StateAttribute::OVERRIDE);
    stateSet.addUniform(new osg::Uniform("osgLabels_states", unit));
}

unsigned int MapMemory::read(osg::State& state, std::size_t index)
{
    _framebuffer->bind(state, 1);
    _textures[_current]->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    glReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
    GLfloat texel[4] = {};
    glReadPixels(GLint(index) % RowLength, GLint(index) / RowLength, 1, 1, GL_RGBA, GL_FLOAT,
                 texel);
    return unsigned(std::lround(texel[0]));
}

} // namespace osgLabels
