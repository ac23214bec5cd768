// SPDX-License-Identifier: MIT
// The programs of a MixedScene: merged, linked, kept. Not installed.
#pragma once

#include <osgMultiRender/MixProgram.h>
#include <osgMultiRender/MixRanking.h>
#include <osgMultiRender/MixRest.h>
#include <osgMultiRender/MixTexture.h>

#include <osg/State>

#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <set>

namespace osgMultiRender
{

/// Makes programs of sets of renderings and keeps them.
///
/// One program shows all renderings. When renderings change it is merged anew in a thread of its
/// own, and the one before stays until the new one is linked, so a picture never lacks what it had.
/// Programs of fewer renderings only save time: they are made when nothing has moved for some
/// frames, until then the one of all stands in. Thread safe; all but the counts with the context of
/// the state current.
class MixPrograms
{
public:
    /// What a frame draws with.
    struct Frame
    {
        osg::ref_ptr<MixProgram> all;                               ///< Null: nothing can be shown.
        std::vector<bool> isShown;                                  ///< By slot.
        std::vector<std::pair<std::uint16_t, std::string>> leftOut; ///< Slots, and why.
    };

    struct Counts
    {
        double started = 0.0, merged = 0.0, linked = 0.0, tried = 0.0, evicted = 0.0, kept = 0.0;
        double mergeMilliseconds = 0.0, linkMilliseconds = 0.0; ///< All together.
    };

    /// To be called before begin(): where a rendering can't be used that has replaced another one,
    /// that one stays.
    std::shared_ptr<const MixSnapshot>
    withoutBroken(const std::shared_ptr<const MixSnapshot>& snapshot, osg::State& state);
    bool hasFailed(std::uint64_t id) const;
    /// At the head of a frame. Waits for a merge only where there is nothing to show yet.
    Frame begin(const std::shared_ptr<const MixSnapshot>& snapshot, osg::State& state,
                const GetMixShares& getShares);
    /// The linked program of exactly this set, or null.
    osg::ref_ptr<MixProgram> find(const MixSet& set);
    /// At the end of each view's frame, with the sets that were wanted and are not there, each with
    /// how many drawables wait for it. Has the one that most wait for made, if nothing has moved,
    /// and it has been wanted, for as long as the snapshot says.
    void makeWanted(const std::map<MixSet, unsigned int>& missing,
                    const std::shared_ptr<const MixSnapshot>& snapshot,
                    const osg::Matrixd& keysToScene, osg::State& state,
                    const GetMixShares& getShares);

    Counts getCounts() const;
    /// Of the program that shows all; "" before there is one.
    std::string getSource() const;

    void resizeGLObjectBuffers(unsigned int maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    struct Job
    {
        MixSet set;
        std::shared_ptr<const MixSnapshot> snapshot;
        MixSlotShares shares;
        std::future<Merged> merged;
    };

    void tryNew(const MixSnapshot& snapshot, osg::State& state);
    void forgetCombinations(const MixSnapshot& snapshot);
    void fail(const MixSlot& slot, const std::string& cause);
    MixSet allOf(const MixSnapshot& snapshot) const;
    osg::ref_ptr<MixProgram> build(const MixSet& set,
                                   const std::shared_ptr<const MixSnapshot>& snapshot,
                                   osg::State& state, bool waits, const GetMixShares& getShares);
    void start(const MixSet& set, const std::shared_ptr<const MixSnapshot>& snapshot,
               MixSlotShares shares);
    bool isReady() const;
    void claim(osg::State& state);
    bool link(MixProgram& program, osg::State& state);
    void forget(const MixSnapshot& snapshot);
    void fillFrame(const MixSnapshot& snapshot, Frame& frame) const;

    mutable std::mutex _mutex;
    std::optional<MergeLimits> _limits;
    std::map<MixSet, osg::ref_ptr<MixProgram>> _programs; ///< Linked ones.
    osg::ref_ptr<MixProgram> _all;                        ///< The last good one.
    MixTextures _textures;
    std::optional<Job> _job;                      ///< Behind what it uses: it is waited for.
    std::map<MixSet, std::string> _broken;        ///< Not merged or not linked, why.
    std::set<std::uint64_t> _tried;               ///< Renderings.
    std::map<std::uint64_t, std::string> _failed; ///< Of these, why.
    std::set<std::uint64_t> _together;            ///< Failed ones that are fine alone.
    std::set<std::uint64_t> _ids;                 ///< Of the last frame's renderings.
    std::uint64_t _frame = 0;                     ///< Of any view.
    MixRest _rest;
    MixRanking _ranking;
    Counts _counts;
};

} // namespace osgMultiRender
