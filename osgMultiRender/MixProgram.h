// SPDX-License-Identifier: MIT
// One merged program with its uniforms and textures. Not installed.
#pragma once

#include <osgMultiRender/Merger.h>
#include <osgMultiRender/MixSnapshot.h>
#include <osgMultiRender/SurfaceVariant.h>

#include <osg/Uniform>

#include <atomic>

namespace osgMultiRender
{

/// Which renderings a program shows: slots in order. `isWhole`: the only one, everywhere at 1.
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

    bool operator<(const MixSet& other) const
    {
        return isWhole != other.isWhole ? other.isWhole : members < other.members;
    }
    bool operator==(const MixSet& other) const
    {
        return isWhole == other.isWhole && members == other.members;
    }
    bool has(std::uint16_t slot) const;
};

/// The texture unit of the sampler of mix.glsl; the table of units is in docs/design.md.
constexpr unsigned int MixUnit = 11;

/// Merges the renderings of a set. Entries of the result are its members, in order.
Merged mergeSet(const MixSet& set, const MixSnapshot& snapshot, const MergeLimits& limits);

/// A set's program, and the StateSet with what it needs beside key points and weights.
class MixProgram : public SurfaceLook
{
public:
    MixProgram(const MixSet& set, Merged merged, const MixSnapshot& snapshot);

    const MixSet& getSet() const { return _set; }
    const Merged& getMerged() const { return _merged; }
    /// Whether it shows the slot: a member may have been left out.
    bool covers(std::uint16_t slot) const;
    /// Takes other values of uniforms. Not while it is drawn.
    void update(const MixSnapshot& snapshot);

    std::uint64_t lastUsed = 0; ///< For the one who keeps it.

protected:
    ~MixProgram() override = default;

private:
    struct Value
    {
        osg::ref_ptr<osg::Uniform> uniform;
        std::uint16_t slot;
        std::string name;
        std::vector<double> ownValues;
    };

    void addUniforms(const MixSnapshot& snapshot);
    void addTextures(const MixSnapshot& snapshot);

    MixSet _set;
    Merged _merged;
    std::vector<Value> _values;
    std::uint64_t _uniformRevision = ~std::uint64_t(0);
};

} // namespace osgMultiRender
