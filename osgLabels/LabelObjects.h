// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/BufferTexture.h>
#include <osgLabels/LabelBatches.h>
#include <osgLabels/ObjectRecord.h>

#include <osg/StateSet>

#include <array>
#include <map>
#include <mutex>
#include <vector>

namespace osgLabels
{

/// The object records of a scene, and their copies on the GPU: those of its batches, and one for
/// each object that a LabelCollector has found. 0 is none. Thread safe.
class OSGLABELS_EXPORT LabelObjects
{
public:
    /// `records` numbers those of the batches too; both live as long.
    LabelObjects(const LabelBatches& batches, NumberSpace& records)
        : _batches(batches), _space(records)
    {
    }

    /// Sets the record of a collector's object.
    void set(std::uint32_t object, const ObjectRecord& record);
    /// Of a collector's object; 0 for one without a record. Those set before any batch is taken in
    /// follow each other.
    std::uint32_t indexOf(std::uint32_t object) const;
    /// The identifier of a record; 0 for none.
    std::uint32_t getIdentifier(std::uint32_t index) const;

    /// Uploads what is new for the context, which is current. Returns texture and uniform.
    osg::ref_ptr<const osg::StateSet> update(osg::State& state);

    /// A bit for each shape that a labelled object has.
    std::uint32_t getShapes() const;
    std::size_t getBytes() const;
    void releaseGLObjects(osg::State* state);

private:
    using Words = std::array<std::uint32_t, ObjectRecord::Words>;

    struct Context
    {
        osg::ref_ptr<osg::StateSet> stateSet;
        osg::ref_ptr<BufferTexture> texture;
        std::size_t changes = 0;   ///< How many of _changed it has taken.
        std::uint64_t batches = 0; ///< The time of LabelBatches that it has.
    };

    Context& contextOf(osg::State& state);
    void writeChanged(osg::State& state, Context& context) const;
    void write(osg::State& state, BufferTexture& texture, std::size_t object,
               std::size_t end) const;
    void dropTaken();

    const LabelBatches& _batches;
    NumberSpace& _space;
    mutable std::mutex _mutex;
    std::vector<Words> _records{1}; ///< By the collector's number; 0 is none.
    Stretches _indices;             ///< Of objects.
    std::uint32_t _shapes = 0;
    std::vector<std::uint32_t> _changed; ///< Objects, in the order in which they were set.
    std::map<unsigned int, Context> _contexts;
};

} // namespace osgLabels
