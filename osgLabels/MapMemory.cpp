// SPDX-License-Identifier: MIT
#include <osgLabels/MapMemory.h>

#include <osg/FrameBufferObject>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

using osgMultiRender::TargetTexture;

namespace
{

/// What labels move by in a frame, as a share of the view's smaller side, when the view jumps.
constexpr double farJump = 0.5;

double distanceOf(const osg::Vec2d& a, const osg::Vec2d& b)
{
    return (a - b).length();
}

} // namespace

bool MapCamera::operator==(const MapCamera& other) const
{
    const PixelBox &a = viewport, &b = other.viewport;
    return groupToEye == other.groupToEye && projections == other.projections && a.left == b.left &&
           a.bottom == b.bottom && a.right == b.right && a.top == b.top;
}

/// Whether the view is elsewhere than in the last frame, so that nobody can follow its labels.
bool MapMemory::isJump(const std::vector<PlacedLabel>& labels, const PixelBox& view) const
{
    const double far = farJump * std::min(view.right - view.left, view.top - view.bottom);
    std::size_t known = 0, jumped = 0;
    for (const PlacedLabel& label : labels)
        if (const auto found = _indices.find(label.label->key); found != _indices.end())
        {
            ++known;
            jumped += distanceOf(label.anchor, _last[found->second].anchor) > far;
        }
    if (known)
        return 2 * jumped > known;
    return _numLast ? _numLast > 1 : _last.empty();
}

void MapMemory::forget(osg::State& state, double time)
{
    _start = time;
    _last.clear();
    _indices.clear();
    _fed.clear();
    _feedback.drop(state);
    _declutter.cut();
}

void MapMemory::begin(osg::State& state, const std::vector<PlacedLabel>& labels,
                      const MapCamera& camera, double time)
{
    if (!_framebuffer || _contextID != state.getContextID())
    {
        _contextID = state.getContextID();
        _framebuffer = std::make_unique<osgMultiRender::Framebuffer>(_contextID);
        _textures[0] = _textures[1] = nullptr;
        _feedback = MapFeedback();
        _last.clear();
        _time = time;
    }
    _isCut = !(time > _time) || isJump(labels, camera.viewport);
    if (_isCut)
        forget(state, time);
    _time = time;
    _isMoving = !(camera == _camera);
    _camera = camera;
    std::vector<Last> now;
    now.reserve(labels.size());
    _pasts.assign(labels.size(), Past());
    std::unordered_map<std::uint64_t, std::uint32_t> indices(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
        const PlacedLabel& label = labels[i];
        const std::uint64_t key = label.label->key;
        now.push_back({key, label.anchor, time});
        if (!indices.emplace(key, std::uint32_t(i)).second)
            continue;
        if (const auto found = _indices.find(key); found != _indices.end())
            _pasts[i].last = found->second + 1;
    }
    _indices.swap(indices);
    _numLast = labels.size();
    keepGone(now);
    _last = std::move(now);
    _current = 1 - _current;
    // The last frame's keep their size, whatever it is.
    _rows = std::max(1, int((_last.size() + RowLength - 1) / RowLength));
    osg::ref_ptr<TargetTexture>& texture = _textures[_current];
    if (!texture || texture->getTextureHeight() != _rows)
        texture = new TargetTexture(GL_RGBA32F_ARB, RowLength, _rows, 0, 1);
}

/// Labels of the last frame that are not in this one keep their states for as long as these last.
void MapMemory::keepGone(std::vector<Last>& now)
{
    for (std::size_t i = 0; i < _last.size(); ++i)
    {
        const Last& last = _last[i];
        if (_time - last.seen > double(Hold) ||
            !_indices.emplace(last.key, std::uint32_t(now.size())).second)
            continue;
        now.push_back(last);
        Past past;
        past.last = std::uint32_t(i) + 1;
        past.isGone = true;
        _pasts.push_back(past);
    }
}

void MapMemory::findSights(osg::State& state, const std::vector<PlacedLabel>& labels, bool isTested)
{
    _sights.clear();
    if (!isTested)
        return;
    MapFeedback::Keys keys;
    MapFeedback::States states;
    if (_isCut)
    {
        attach(state);
        states = MapFeedback::readNow(labels.size(), RowLength, _rows);
        for (const PlacedLabel& label : labels)
            keys.push_back(label.label->key);
    }
    else
        while (_feedback.take(state, keys, states)) // the newest that has come
            ;
    if (!keys.empty())
    {
        _fed.clear();
        for (std::size_t i = 0; i < keys.size(); ++i)
            _fed.emplace(keys[i], states[i]);
    }
    _sights.resize(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
        const auto found = _fed.find(labels[i].label->key);
        DeclutterSight& sight = _sights[i];
        sight.what = DeclutterSight::Unknown;
        if (found == _fed.end())
            continue;
        sight.what = found->second.isHidden ? DeclutterSight::Hidden : DeclutterSight::Seen;
        sight.since = _start + double(found->second.since);
    }
}

const std::vector<std::uint8_t>& MapMemory::declutter(osg::State& state,
                                                      const std::vector<PlacedLabel>& labels,
                                                      const PixelBox& view, bool isTested)
{
    findSights(state, labels, isTested);
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
    return _declutter.update(
        wanted, glm::vec2(float(view.right - view.left), float(view.top - view.bottom)), _time,
        _sights);
}

float MapMemory::getAge(std::size_t index) const
{
    // Longer than anything is held, and finite.
    return float(std::min(_time - _declutter.getSince(index), 1e6));
}

void MapMemory::attach(osg::State& state)
{
    _framebuffer->bind(state, 1);
    _textures[_current]->attach(state, GL_COLOR_ATTACHMENT0_EXT, 0);
    glReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
}

void MapMemory::bind(osg::State& state, osg::StateSet& stateSet, int unit)
{
    attach(state);
    const osg::ref_ptr<TargetTexture>& old = _textures[1 - _current];
    if (old)
        stateSet.setTextureAttribute(unsigned(unit), old, osg::StateAttribute::OVERRIDE);
    stateSet.addUniform(new osg::Uniform("osgLabels_states", unit));
}

void MapMemory::startFeedback(osg::State& state, const std::vector<PlacedLabel>& labels)
{
    MapFeedback::Keys keys;
    keys.reserve(labels.size());
    for (const PlacedLabel& label : labels)
        keys.push_back(label.label->key);
    _feedback.start(state, std::move(keys), RowLength, _rows);
}

unsigned int MapMemory::read(osg::State& state, std::size_t index)
{
    attach(state);
    GLfloat texel[4] = {};
    glReadPixels(GLint(index) % RowLength, GLint(index) / RowLength, 1, 1, GL_RGBA, GL_FLOAT,
                 texel);
    return unsigned(std::lround(texel[0]));
}

} // namespace osgLabels
