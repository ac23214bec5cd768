// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixedScene.h>

#include <osgMultiRender/MixDrag.h>
#include <osgMultiRender/MixPass.h>
#include <osgMultiRender/MixWatch.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

namespace
{

std::uint64_t nextId()
{
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::vector<glm::dvec3> toGlm(const std::vector<osg::Vec3d>& points)
{
    std::vector<glm::dvec3> result;
    for (const osg::Vec3d& point : points)
        result.emplace_back(point.x(), point.y(), point.z());
    return result;
}

} // namespace

MixedScene::MixedScene()
    : _snapshot(std::make_shared<MixSnapshot>()), _resources(std::make_shared<MixResources>()),
      _drag(std::make_unique<MixDrag>())
{
    // So that parents lead event visitors here; not for children, which have their own.
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

MixedScene::MixedScene(const MixedScene& other, const osg::CopyOp& copyop)
    : SurfaceGroup(other, copyop), _snapshot(other.getSnapshot()), _points(other.getKeyPoints()),
      _keyNode(const_cast<osg::Node*>(other.getKeyNode())), _marks(other.getMarks()),
      _answersKeys(other.getAnswersKeys()), _resources(std::make_shared<MixResources>()),
      _drag(std::make_unique<MixDrag>())
{
    setNumChildrenRequiringEventTraversal(getNumChildrenRequiringEventTraversal() + 1);
}

MixedScene::~MixedScene()
{
    _watch.reset(); // before what its thread uses
}

std::shared_ptr<const MixSnapshot> MixedScene::getSnapshot() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _snapshot;
}

/// Frames that are being drawn keep what they have.
template <class Change> void MixedScene::change(Change change)
{
    std::lock_guard<std::mutex> lock(_settings);
    auto snapshot = std::make_shared<MixSnapshot>(*_snapshot);
    change(*snapshot);
    _snapshot = std::move(snapshot);
}

template <class Change> bool MixedScene::changeSlot(unsigned int number, Change change)
{
    bool isThere = false;
    this->change(
        [&](MixSnapshot& snapshot)
        {
            isThere = number < snapshot.slots.size() && snapshot.slots[number].rendering;
            if (isThere)
                change(snapshot, snapshot.slots[number]);
        });
    return isThere;
}

unsigned int MixedScene::addRendering(const Rendering& rendering, const MixRange& range)
{
    unsigned int number = None;
    change(
        [&](MixSnapshot& snapshot)
        {
            std::size_t place = 0;
            while (place < snapshot.slots.size() && snapshot.slots[place].rendering)
                ++place;
            if (place >= MaxRenderings)
                return;
            number = static_cast<unsigned int>(place);
            if (place == snapshot.slots.size())
                snapshot.slots.emplace_back();
            snapshot.slots[place] = {
                std::make_shared<Rendering>(rendering), nextId(), range, {}, nullptr};
            ++snapshot.uniformRevision;
        });
    if (number == None)
        OSG_WARN << "osgMultiRender::MixedScene: rendering '" << rendering.name
                 << "' is not added, there are " << MaxRenderings << "; remove one" << std::endl;
    return number;
}

/// What is shown while another rendering can't take the slot's place.
std::shared_ptr<const MixSlot> MixedScene::beforeOf(const MixSlot& slot) const
{
    if (_resources->programs.hasFailed(slot.id))
        return slot.before;
    auto before = std::make_shared<MixSlot>(slot);
    before->before = nullptr;
    return before;
}

bool MixedScene::setRendering(unsigned int number, const Rendering& rendering)
{
    return changeSlot(number,
                      [&](MixSnapshot& snapshot, MixSlot& slot)
                      {
                          slot.before = beforeOf(slot);
                          slot.rendering = std::make_shared<Rendering>(rendering);
                          slot.id = nextId();
                          ++snapshot.uniformRevision;
                      });
}

bool MixedScene::removeRendering(unsigned int number)
{
    return changeSlot(number,
                      [](MixSnapshot& snapshot, MixSlot& slot)
                      {
                          slot = MixSlot();
                          while (!snapshot.slots.empty() && !snapshot.slots.back().rendering)
                              snapshot.slots.pop_back();
                          ++snapshot.mixRevision;
                      });
}

std::vector<unsigned int> MixedScene::getRenderings() const
{
    const auto snapshot = getSnapshot();
    std::vector<unsigned int> numbers;
    for (std::size_t i = 0; i < snapshot->slots.size(); ++i)
        if (snapshot->slots[i].rendering)
            numbers.push_back(static_cast<unsigned int>(i));
    return numbers;
}

std::shared_ptr<const Rendering> MixedScene::getRendering(unsigned int number) const
{
    const auto snapshot = getSnapshot();
    return number < snapshot->slots.size() ? snapshot->slots[number].rendering : nullptr;
}

bool MixedScene::setRange(unsigned int number, const MixRange& range)
{
    return changeSlot(number,
                      [&](MixSnapshot& snapshot, MixSlot& slot)
                      {
                          slot.range = range;
                          ++snapshot.mixRevision;
                      });
}

MixRange MixedScene::getRange(unsigned int number) const
{
    const auto snapshot = getSnapshot();
    return number < snapshot->slots.size() ? snapshot->slots[number].range : MixRange();
}

void MixedScene::setKeyPoints(const std::vector<osg::Vec3d>& points, KeyMode mode)
{
    const auto keys = std::make_shared<KeyPoints>(toGlm(points), mode);
    change(
        [&](MixSnapshot& snapshot)
        {
            snapshot.points = keys;
            ++snapshot.mixRevision;
            _points = points;
            _drawnMarks = nullptr;
        });
}

std::vector<osg::Vec3d> MixedScene::getKeyPoints() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _points;
}

KeyMode MixedScene::getKeyMode() const
{
    return getSnapshot()->points->getMode();
}

void MixedScene::setKeyNode(osg::Node* node)
{
    change(
        [&](MixSnapshot& snapshot)
        {
            _keyNode = node;
            ++snapshot.mixRevision;
        });
}

const osg::Node* MixedScene::getKeyNode() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _keyNode.get();
}

void MixedScene::setRules(const MixRules& rules)
{
    change(
        [&](MixSnapshot& snapshot)
        {
            snapshot.rules = rules;
            ++snapshot.mixRevision;
        });
}

MixRules MixedScene::getRules() const
{
    return getSnapshot()->rules;
}

void MixedScene::setTransparent(bool transparent)
{
    change([&](MixSnapshot& snapshot) { snapshot.isTransparent = transparent; });
}

void MixedScene::setOwnLighting(bool own)
{
    change([&](MixSnapshot& snapshot) { snapshot.ownLighting = own; });
}

bool MixedScene::getOwnLighting() const
{
    return getSnapshot()->ownLighting;
}

bool MixedScene::isTransparent() const
{
    return getSnapshot()->isTransparent;
}

void MixedScene::setInput(MixInput input)
{
    change(
        [&](MixSnapshot& snapshot)
        {
            // The programs of one are none for the other.
            if (snapshot.isOfFrame != (input == MixInput::Frame))
                _resources = std::make_shared<MixResources>();
            snapshot.isOfFrame = input == MixInput::Frame;
        });
}

MixInput MixedScene::getInput() const
{
    return getSnapshot()->isOfFrame ? MixInput::Frame : MixInput::Surface;
}

std::shared_ptr<MixResources> MixedScene::getResources() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _resources;
}

bool MixedScene::setUniform(unsigned int number, const std::string& name,
                            const std::vector<double>& values)
{
    return changeSlot(number,
                      [&](MixSnapshot& snapshot, MixSlot& slot)
                      {
                          slot.uniforms[name] = values;
                          ++snapshot.uniformRevision;
                      });
}

std::vector<double> MixedScene::getUniform(unsigned int number, const std::string& name) const
{
    const auto snapshot = getSnapshot();
    if (number >= snapshot->slots.size() || !snapshot->slots[number].rendering)
        return {};
    const MixSlot& slot = snapshot->slots[number];
    if (const auto found = slot.uniforms.find(name); found != slot.uniforms.end())
        return found->second;
    const RenderingUniform* own = slot.rendering->findUniform(name);
    return own ? own->values : std::vector<double>();
}

std::vector<std::string> MixedScene::getSetUniforms(unsigned int number) const
{
    const auto snapshot = getSnapshot();
    std::vector<std::string> names;
    if (number < snapshot->slots.size())
        for (const auto& [name, values] : snapshot->slots[number].uniforms)
            names.push_back(name);
    return names;
}

void MixedScene::setPruning(bool prunes)
{
    change([&](MixSnapshot& snapshot) { snapshot.prunes = prunes; });
}

bool MixedScene::getPruning() const
{
    return getSnapshot()->prunes;
}

void MixedScene::setSettleFrames(unsigned int frames)
{
    change([&](MixSnapshot& snapshot) { snapshot.settleFrames = frames; });
}

unsigned int MixedScene::getSettleFrames() const
{
    return getSnapshot()->settleFrames;
}

void MixedScene::setMaxPrograms(unsigned int programs)
{
    change([&](MixSnapshot& snapshot) { snapshot.maxPrograms = programs; });
}

unsigned int MixedScene::getMaxPrograms() const
{
    return static_cast<unsigned int>(getSnapshot()->maxPrograms);
}

void MixedScene::setLimits(const MergeLimits* limits)
{
    change(
        [&](MixSnapshot& snapshot)
        {
            snapshot.limits = limits ? std::make_optional(*limits) : std::nullopt;
            _resources = std::make_shared<MixResources>();
        });
}

void MixedScene::setMarks(MixMarks marks)
{
    std::lock_guard<std::mutex> lock(_settings);
    _marks = marks;
    _drawnMarks = nullptr;
}

MixMarks MixedScene::getMarks() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _marks;
}

void MixedScene::setAnswersKeys(bool answers)
{
    std::lock_guard<std::mutex> lock(_settings);
    _answersKeys = answers;
}

bool MixedScene::getAnswersKeys() const
{
    std::lock_guard<std::mutex> lock(_settings);
    return _answersKeys;
}

} // namespace osgMultiRender
