// SPDX-License-Identifier: MIT
// One merged program with its uniforms and textures. Not installed.
#pragma once

#include <osgMultiRender/Merger.h>
#include <osgMultiRender/MixSnapshot.h>
#include <osgMultiRender/SurfaceVariant.h>

#include <osg/Uniform>

#include <memory>
#include <mutex>
#include <tuple>

namespace osgMultiRender
{

/// Which renderings a program shows: slots in order. `isWhole`: the only one, everywhere at 1.
/// `isTransparent`: fragments of alpha 0 are left out. `ownLighting`: as MergeOptions has it.
/// `lights`: likewise.
struct MixSet
{
    struct Member
    {
        std::uint16_t slot = 0;
        std::uint64_t id = 0;
        bool operator<(const Member& other) const
        {
            return slot != other.slot ? slot < other.slot : id < other.id;
        }
        bool operator==(const Member& other) const { return slot == other.slot && id == other.id; }
    };

    std::vector<Member> members;
    bool isWhole = false;
    bool isTransparent = false;
    bool ownLighting = false;
    int lights = MergeOptions::AnyLights;

    bool operator<(const MixSet& other) const
    {
        return std::tie(isWhole, isTransparent, ownLighting, lights, members) <
               std::tie(other.isWhole, other.isTransparent, other.ownLighting, other.lights,
                        other.members);
    }
    bool operator==(const MixSet& other) const
    {
        return isWhole == other.isWhole && isTransparent == other.isTransparent &&
               ownLighting == other.ownLighting && lights == other.lights &&
               members == other.members;
    }
    bool has(std::uint16_t slot) const;
};

class MixTextures;

/// The texture unit of the sampler of mix.glsl; the table of units is in docs/design.md.
constexpr unsigned int MixUnit = 11;

/// How much each slot counts in the picture; empty: the earlier the more.
using MixSlotShares = std::vector<double>;

/// Merges the renderings of a set. Entries of the result are its members, in order. Where a limit
/// is passed that of the least share goes.
Merged mergeSet(const MixSet& set, const MixSnapshot& snapshot, const MergeLimits& limits,
                const MixSlotShares& shares = {});

/// Reads the files of the textures that the program of the set needs, so that MixProgram need not.
void readTextures(const MixSet& set, const Merged& merged, const MixSnapshot& snapshot,
                  MixTextures& textures);

/// A set's program, and the StateSet with what it needs beside key points and weights.
class MixProgram : public SurfaceLook
{
public:
    MixProgram(const MixSet& set, Merged merged, const MixSnapshot& snapshot,
               MixTextures& textures);

    const MixSet& getSet() const { return _set; }
    const Merged& getMerged() const { return _merged; }
    /// Whether it shows the slot: a member may have been left out.
    bool covers(std::uint16_t slot) const;
    /// Values of the renderings' uniforms in one revision of a snapshot; nobody changes them.
    struct Values
    {
        std::uint64_t revision = 0;
        std::vector<osg::ref_ptr<osg::Uniform>> uniforms;

        /// To the program in use, past osg::State, whose values of these names would be the last
        /// frame's.
        void send(const osg::Program::PerContextProgram& program, osg::State& state) const;
    };
    /// Those of a snapshot, for apply(). They are not in the StateSet: contexts may draw different
    /// frames at the same time.
    std::shared_ptr<const Values> valuesOf(const MixSnapshot& snapshot);

    std::uint64_t lastUsed = 0; ///< For the one who keeps it.
    MixSlotShares shares;       ///< As they were when it was merged.

protected:
    ~MixProgram() override = default;

private:
    struct Value
    {
        osg::Uniform::Type type;
        std::string merged;
        int arraySize;
        std::uint16_t slot;
        std::string name;
        std::vector<double> ownValues;
    };

    void addUniforms(const MixSnapshot& snapshot);
    void addTextures(const MixSnapshot& snapshot, MixTextures& textures);

    MixSet _set;
    Merged _merged;
    std::vector<Value> _values;
    std::mutex _mutex;
    std::shared_ptr<const Values> _latest;
};

} // namespace osgMultiRender
