// SPDX-License-Identifier: MIT
#include <osgLabels/LabelBatches.h>

#include <osg/NodeVisitor>

#include <algorithm>
#include <set>

namespace osgLabels
{

namespace
{

class BatchVisitor : public osg::NodeVisitor
{
public:
    BatchVisitor() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN)
    {
        setNodeMaskOverride(~0u); // what is hidden now may be shown later
    }
    void apply(osg::Group& group) override
    {
        if (auto* batch = dynamic_cast<PrimitiveBatch*>(&group))
        {
            if (_seen.insert(batch).second) // may have several parents
                batches.emplace_back(batch,
                                     osg::NodePath(getNodePath().begin() + 1, getNodePath().end()));
        }
        else
            traverse(group);
    }
    std::vector<std::pair<osg::ref_ptr<PrimitiveBatch>, osg::NodePath>> batches;

private:
    std::set<const PrimitiveBatch*> _seen;
};

} // namespace

std::uint32_t LabelBatches::collect(osg::Node& root, const LabelSource& source, std::uint32_t first,
                                    const SetLabel& setLabel)
{
    BatchVisitor visitor;
    root.accept(visitor);
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& [batch, path] : visitor.batches)
    {
        const std::uint32_t begin = first;
        for (unsigned int i = 0; i < batch->getNumObjects(); ++i)
        {
            const auto label = source.ofName(batch->getObjectName(i), path);
            batch->setIdentifier(i, label ? first : 0);
            if (!label)
                continue;
            setLabel(first, *label);
            ++first;
        }
        const std::uint32_t firstRecord = _numObjects + 1;
        _batches.push_back({batch.get(), begin, first, firstRecord, batch->getRuns()});
        for (const osg::ref_ptr<PrimitiveRun>& run : batch->getRuns())
        {
            _bases[run.get()] =
                int(firstRecord + run->getFirstObject()) - int(run->getFirstRecord());
            _shapes |= 1u << std::uint32_t(run->getShape());
        }
        _numObjects += batch->getNumObjects();
    }
    return first;
}

void LabelBatches::forEach(const std::function<void(const PrimitiveBatch&, std::uint32_t)>& f) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    osg::ref_ptr<PrimitiveBatch> batch;
    for (const Entry& entry : _batches)
        if (entry.batch.lock(batch))
            f(*batch, entry.firstRecord);
}

std::optional<int> LabelBatches::recordBaseOf(const PrimitiveRun& run) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _bases.find(&run);
    return found == _bases.end() ? std::nullopt : std::make_optional(found->second);
}

std::uint32_t LabelBatches::getShapes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _shapes;
}

std::uint32_t LabelBatches::getNumObjects() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _numObjects;
}

LabelBatches::Found LabelBatches::find(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto after = std::upper_bound(_batches.begin(), _batches.end(), identifier,
                                        [](std::uint32_t value, const Entry& entry)
                                        { return value < entry.endIdentifier; });
    Found found;
    if (after == _batches.end() || identifier < after->firstIdentifier ||
        !after->batch.lock(found.batch))
        return {};
    // Identifiers grow with the objects' numbers, with gaps where an object has no text.
    for (found.object = identifier - after->firstIdentifier;
         found.object < found.batch->getNumObjects(); ++found.object)
        if (found.batch->getIdentifier(found.object) == identifier)
            return found;
    return {};
}

std::size_t LabelBatches::getBytes() const
{
    return std::size_t(getNumObjects()) * sizeof(std::uint32_t);
}

} // namespace osgLabels
