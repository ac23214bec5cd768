// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelSource.h>
#include <osgLabels/PrimitiveBatch.h>

#include <osg/observer_ptr>

#include <functional>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

namespace osgLabels
{

/// The labels of the PrimitiveBatches of a scene: one for each object that has a text, identifiers
/// without gaps from 1 in the order of the batches. Thread safe.
class LabelBatches
{
public:
    using SetLabel = std::function<void(std::uint32_t identifier, const LabelSource::Found& label)>;

    /// Finds the batches below `root`, which is none, and gives their objects identifiers from
    /// `first` on; returns the next one.
    std::uint32_t collect(osg::Node& root, const LabelSource& source, std::uint32_t first,
                          const SetLabel& setLabel);

    /// Calls `f` with each batch and the index of its first object's record.
    void forEach(const std::function<void(const PrimitiveBatch&, std::uint32_t)>& f) const;
    /// What has to be added to the place of a record in the run's page; none for a run of no batch.
    std::optional<int> recordBaseOf(const PrimitiveRun& run) const;
    /// Objects of all batches: so many records from 1 on are theirs.
    std::uint32_t getNumObjects() const;
    /// A bit for each shape that they have.
    std::uint32_t getShapes() const;

    struct Found
    {
        osg::ref_ptr<PrimitiveBatch> batch; ///< Null for an identifier of no batch.
        unsigned int object = 0;
    };
    Found find(std::uint32_t identifier) const;
    /// Of their colours on the GPU.
    std::size_t getBytes() const;

private:
    struct Entry
    {
        osg::observer_ptr<PrimitiveBatch> batch;
        std::uint32_t firstIdentifier, endIdentifier, firstRecord;
        /// Kept, so that no other run gets the address of one in _bases.
        std::vector<osg::ref_ptr<PrimitiveRun>> runs;
    };
    mutable std::mutex _mutex;
    std::vector<Entry> _batches; ///< By identifiers.
    std::unordered_map<const PrimitiveRun*, int> _bases;
    std::uint32_t _numObjects = 0, _shapes = 0;
};

} // namespace osgLabels
