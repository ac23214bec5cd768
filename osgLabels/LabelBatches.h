// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/LabelSource.h>
#include <osgLabels/PrimitiveBatch.h>

#include <osg/observer_ptr>

#include <functional>
#include <map>
#include <mutex>

namespace osgLabels
{

/// The labels of the PrimitiveBatches of a scene: one for each object that has a text, identifiers
/// without gaps from 1 in the order of the batches. Thread safe.
class LabelBatches
{
public:
    using SetText = std::function<void(std::uint32_t identifier, const std::string& text)>;

    /// Finds the batches below `root` and gives their objects identifiers from `first` on; returns
    /// the next one.
    std::uint32_t collect(osg::Node& root, const LabelSource& source, std::uint32_t first,
                          const SetText& setText);

    struct Found
    {
        osg::ref_ptr<PrimitiveBatch> batch; ///< Null for an identifier of no batch.
        unsigned int object = 0;
    };
    Found find(std::uint32_t identifier) const;
    std::size_t getCount() const;
    /// Of their records and colours on the GPU.
    std::size_t getBytes() const;

private:
    struct Entry
    {
        osg::observer_ptr<PrimitiveBatch> batch;
        std::uint32_t end; ///< Behind its last identifier.
    };
    mutable std::mutex _mutex;
    std::map<std::uint32_t, Entry> _batches; ///< By first identifier.
};

} // namespace osgLabels
