// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixPrograms.h>

#include <osgMultiRender/AllCores.h>

#include <osgMultiRender/MixTrial.h>
#include <osgMultiRender/ProgramWrap.h>

#include <osg/Notify>
#include <osg/Timer>

#include <algorithm>

namespace osgMultiRender
{

namespace
{

/// The errors of a merge about one entry, or about all.
std::string errorsOf(const Merged& merged)
{
    std::string text;
    for (const MergeMessage& message : merged.messages)
        if (message.severity == MergeSeverity::Error)
            text += (text.empty() ? "" : "\n") + message.text;
    return text;
}

std::string errorsOf(const Rendering& rendering)
{
    std::string text;
    for (const RenderingMessage& message : rendering.messages)
        if (message.error)
            text += (text.empty() ? "" : "\n") + message.text;
    return text.empty() && rendering.shaders.empty() ? rendering.name + ": it has no shader" : text;
}

/// Several errors, as "a.frag:3: x; a.frag:4: y".
std::string inOneLine(const std::string& text)
{
    std::string line;
    for (const char c : text)
        if (c != '\n')
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += "; ";
    while (!line.empty() && (line.back() == ' ' || line.back() == ';'))
        line.pop_back();
    return line;
}

double millisecondsSince(osg::Timer_t start)
{
    return osg::Timer::instance()->delta_m(start, osg::Timer::instance()->tick());
}

} // namespace

std::shared_ptr<const MixSnapshot>
MixPrograms::withoutBroken(const std::shared_ptr<const MixSnapshot>& snapshot, osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_limits)
        _limits = limitsOf(state, snapshot->limits);
    forgetCombinations(*snapshot);
    tryNew(*snapshot, state);
    std::shared_ptr<MixSnapshot> changed;
    for (std::size_t i = 0; i < snapshot->slots.size(); ++i)
    {
        const MixSlot& slot = snapshot->slots[i];
        if (!slot.before || !_failed.count(slot.id) || _failed.count(slot.before->id))
            continue;
        if (!changed)
            changed = std::make_shared<MixSnapshot>(*snapshot);
        changed->slots[i].rendering = slot.before->rendering;
        changed->slots[i].id = slot.before->id;
    }
    return changed ? changed : snapshot;
}

bool MixPrograms::hasFailed(std::uint64_t id) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _failed.count(id) != 0;
}

MixPrograms::Frame MixPrograms::begin(const std::shared_ptr<const MixSnapshot>& snapshot,
                                      osg::State& state, const GetMixShares& getShares)
{
    std::lock_guard<std::mutex> lock(_mutex);
    ++_frame;
    if (!_limits)
        _limits = limitsOf(state, snapshot->limits);
    tryNew(*snapshot, state);
    for (;;)
    {
        const MixSet set = allOf(*snapshot);
        if (set.members.empty())
        {
            _all = nullptr;
            break;
        }
        if (_all && _all->getSet() == set)
        {
            // Made anew meanwhile, perhaps of others, where limits leave some out.
            if (_job && _job->set == set && isReady())
                claim(state);
            if (const auto latest = _programs.find(set); latest != _programs.end())
                _all = latest->second;
            break;
        }
        const bool showsAny =
            _all && _all->getSet().isTransparent == set.isTransparent &&
            std::any_of(set.members.begin(), set.members.end(),
                        [&](const MixSet::Member& m) { return _all->covers(m.slot); });
        osg::ref_ptr<MixProgram> made = build(set, snapshot, state, !showsAny, getShares);
        if (made)
            _all = made;
        if (made || !_broken.count(set))
            break;
        // Each alone is fine: the newest one, of the highest id, is what has changed.
        const MixSet::Member newest =
            *std::max_element(set.members.begin(), set.members.end(),
                              [](const auto& a, const auto& b) { return a.id < b.id; });
        _together.insert(newest.id);
        fail(snapshot->slots[newest.slot],
             "it can't be shown in one program with the others: " + _broken.at(set));
    }
    forget(*snapshot);
    Frame frame;
    fillFrame(*snapshot, frame);
    return frame;
}

/// What failed only with others is tried again when these are others. Of the renderings as they
/// were set, not of those that stand in for broken ones.
void MixPrograms::forgetCombinations(const MixSnapshot& snapshot)
{
    std::set<std::uint64_t> ids;
    for (const MixSlot& slot : snapshot.slots)
    {
        if (slot.rendering)
            ids.insert(slot.id);
        if (slot.rendering && slot.before)
            ids.insert(slot.before->id);
    }
    if (ids == _ids)
        return;
    for (const std::uint64_t id : _together)
        _failed.erase(id);
    _together.clear();
    const auto isGone = [&](std::uint64_t id) { return !ids.count(id); };
    for (auto at = _tried.begin(); at != _tried.end();)
        at = isGone(*at) ? _tried.erase(at) : std::next(at);
    for (auto at = _failed.begin(); at != _failed.end();)
        at = isGone(at->first) ? _failed.erase(at) : std::next(at);
    for (auto at = _broken.begin(); at != _broken.end();)
        at = std::any_of(at->first.members.begin(), at->first.members.end(),
                         [&](const MixSet::Member& m) { return isGone(m.id); })
                 ? _broken.erase(at)
                 : std::next(at);
    _textures.keep(ids);
    _ids = std::move(ids);
}

void MixPrograms::fillFrame(const MixSnapshot& snapshot, Frame& frame) const
{
    frame.all = _all;
    frame.isShown.assign(snapshot.slots.size(), false);
    for (std::size_t i = 0; i < snapshot.slots.size(); ++i)
    {
        const MixSlot& slot = snapshot.slots[i];
        if (!slot.rendering)
            continue;
        const auto number = std::uint16_t(i);
        const auto failed = _failed.find(slot.id);
        frame.isShown[i] = _all && _all->covers(number) && failed == _failed.end();
        if (frame.isShown[i])
            continue;
        std::string why = failed != _failed.end() ? failed->second : "its program is being made";
        if (_all && failed == _failed.end())
            for (const MergeMessage& message : _all->getMerged().messages)
                if (message.severity == MergeSeverity::Error &&
                    message.rendering < _all->getSet().members.size() &&
                    _all->getSet().members[message.rendering].slot == number)
                    why = message.text;
        frame.leftOut.emplace_back(number, why);
    }
    if (_all)
        _all->lastUsed = _frame;
}

/// Compiles and links each new rendering alone, so that what is wrong is said of it alone.
void MixPrograms::tryNew(const MixSnapshot& snapshot, osg::State& state)
{
    for (std::size_t i = 0; i < snapshot.slots.size(); ++i)
    {
        const MixSlot& slot = snapshot.slots[i];
        if (!slot.rendering || !_tried.insert(slot.id).second)
            continue;
        ++_counts.tried;
        if (!slot.rendering->ok())
        {
            fail(slot, errorsOf(*slot.rendering));
            continue;
        }
        MixSet own;
        own.members.push_back({std::uint16_t(i), slot.id});
        own.isWhole = true;
        own.ownLighting = snapshot.ownLighting;
        const Merged alone = mergeSet(own, snapshot, *_limits);
        const std::string cause = alone.ok ? tryProgram(alone, state) : errorsOf(alone);
        if (!cause.empty())
            fail(slot, cause);
    }
}

void MixPrograms::fail(const MixSlot& slot, const std::string& cause)
{
    const std::string text = inOneLine(cause);
    _failed[slot.id] = text;
    OSG_WARN << "osgMultiRender::MixedScene: rendering '" << slot.rendering->name
             << "' is left out: " << text << std::endl;
}

MixSet MixPrograms::allOf(const MixSnapshot& snapshot) const
{
    MixSet set;
    set.isTransparent = snapshot.isTransparent;
    set.ownLighting = snapshot.ownLighting;
    for (std::size_t i = 0; i < snapshot.slots.size(); ++i)
        if (snapshot.slots[i].rendering && !_failed.count(snapshot.slots[i].id))
            set.members.push_back({std::uint16_t(i), snapshot.slots[i].id});
    return set;
}

osg::ref_ptr<MixProgram> MixPrograms::find(const MixSet& set)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _programs.find(set);
    if (found == _programs.end())
        return nullptr;
    found->second->lastUsed = _frame;
    return found->second;
}

void MixPrograms::makeWanted(const std::map<MixSet, unsigned int>& missing,
                             const std::shared_ptr<const MixSnapshot>& snapshot,
                             const osg::Matrixd& keysToScene, osg::State& state,
                             const GetMixShares& getShares)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const osg::FrameStamp* stamp = state.getFrameStamp();
    const unsigned int frame = stamp ? stamp->getFrameNumber() : static_cast<unsigned int>(_frame);
    _rest.see(snapshot->mixRevision, keysToScene, frame);
    if (_rest.getQuietFrames(frame) == 0)
        _ranking.reset();
    const MixSet* wanted = nullptr;
    unsigned int most = 0;
    for (const auto& [set, leaves] : missing)
        if (_rest.want(set, frame) >= snapshot->settleFrames && leaves > most)
        {
            wanted = &set;
            most = leaves;
        }
    // The program of all comes first: the others only save time.
    const bool isWhole = _all && _all->getSet() == allOf(*snapshot);
    if (!isWhole || _rest.getQuietFrames(frame) < snapshot->settleFrames)
        return;
    if (wanted)
        build(*wanted, snapshot, state, snapshot->settleFrames == 0, getShares);
    if (_job)
        return;
    if (auto shares = _ranking.look(*_all, frame, snapshot->settleFrames, getShares))
        start(_all->getSet(), snapshot, std::move(*shares));
}

/// Null where it is not ready, or broken.
osg::ref_ptr<MixProgram> MixPrograms::build(const MixSet& set,
                                            const std::shared_ptr<const MixSnapshot>& snapshot,
                                            osg::State& state, bool waits,
                                            const GetMixShares& getShares)
{
    const auto known = [&]
    {
        const auto found = _programs.find(set);
        return found == _programs.end() ? nullptr : found->second;
    };
    if (const osg::ref_ptr<MixProgram> program = known())
        return program;
    // One at a time; what is ready is claimed, whoever has wanted it.
    if (_job && !waits && !isReady())
        return nullptr;
    if (_job)
        claim(state);
    if (const osg::ref_ptr<MixProgram> program = known(); program || _broken.count(set))
        return program;
    start(set, snapshot, getShares());
    if (!waits)
        return nullptr;
    claim(state);
    return known();
}

bool MixPrograms::isReady() const
{
    return _job->merged.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

void MixPrograms::start(const MixSet& set, const std::shared_ptr<const MixSnapshot>& snapshot,
                        MixSlotShares shares)
{
    ++_counts.started;
    _job = Job{set, snapshot, shares,
               std::async(std::launch::async,
                          [this, set, snapshot, shares, limits = *_limits]
                          {
                              useAllCores();
                              Merged merged = mergeSet(set, *snapshot, limits, shares);
                              if (merged.ok)
                                  readTextures(set, merged, *snapshot, _textures);
                              return merged;
                          })};
}

/// Takes what the job has made, waiting for it, and links it.
void MixPrograms::claim(osg::State& state)
{
    Merged merged = _job->merged.get();
    const Job job = std::move(*_job);
    _job.reset();
    ++_counts.merged;
    _counts.mergeMilliseconds += merged.statistics.milliseconds;
    for (const MixSet::Member& member : job.set.members)
        if (!_ids.count(member.id))
            return; // gone meanwhile
    if (!merged.ok)
    {
        _broken[job.set] = errorsOf(merged);
        return;
    }
    const osg::ref_ptr<MixProgram> program =
        new MixProgram(job.set, std::move(merged), *job.snapshot, _textures);
    if (!link(*program, state))
    {
        _broken[job.set] = "the driver does not link it";
        return;
    }
    program->lastUsed = _frame;
    program->shares = job.shares;
    _programs[job.set] = program;
    _ranking.warn(*program);
}

bool MixPrograms::link(MixProgram& program, osg::State& state)
{
    const osg::Timer_t start = osg::Timer::instance()->tick();
    auto& object = const_cast<osg::Program&>(*program.getProgram());
    object.compileGLObjects(state);
    ++_counts.linked;
    _counts.linkMilliseconds += millisecondsSince(start);
    const osg::Program::PerContextProgram* linked = object.getPCP(state);
    if (linked && linked->isLinked())
        return true;
    OSG_WARN << "osgMultiRender::MixedScene: the program '" << object.getName()
             << "' does not link and is not used:\n"
             << program.getMerged().explain(osgMultiRender::errorsOf(object, state)) << std::flush;
    return false;
}

/// Programs of renderings that are gone, and the least recently used of too many.
void MixPrograms::forget(const MixSnapshot& snapshot)
{
    const auto isGone = [&](const MixSet& set)
    {
        return std::any_of(set.members.begin(), set.members.end(),
                           [&](const MixSet::Member& m) {
                               return m.slot >= snapshot.slots.size() ||
                                      snapshot.slots[m.slot].id != m.id;
                           });
    };
    for (auto at = _programs.begin(); at != _programs.end();)
        at = isGone(at->first) ? _programs.erase(at) : std::next(at);
    while (_programs.size() > std::max<std::size_t>(snapshot.maxPrograms, 1))
    {
        auto oldest = _programs.end();
        for (auto at = _programs.begin(); at != _programs.end(); ++at)
            if (at->second != _all && at->second->lastUsed + 1 < _frame &&
                (oldest == _programs.end() || at->second->lastUsed < oldest->second->lastUsed))
                oldest = at;
        if (oldest == _programs.end())
            return; // all are in use
        _programs.erase(oldest);
        ++_counts.evicted;
    }
}

MixPrograms::Counts MixPrograms::getCounts() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    Counts counts = _counts;
    counts.kept = static_cast<double>(_programs.size());
    return counts;
}

std::string MixPrograms::getSource() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _all ? _all->getMerged().vertex + "\n" + _all->getMerged().fragment : "";
}

void MixPrograms::resizeGLObjectBuffers(unsigned int maxSize)
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto& [set, program] : _programs)
        program->resizeGLObjectBuffers(maxSize);
}

void MixPrograms::releaseGLObjects(osg::State* state) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [set, program] : _programs)
        program->releaseGLObjects(state);
}

} // namespace osgMultiRender
