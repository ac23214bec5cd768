// SPDX-License-Identifier: MIT
#include <osgLabels/LabelBatches.h>

#include <osg/NodeVisitor>

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
            batches.emplace_back(batch);
        else
            traverse(group);
    }
    std::vector<osg::ref_ptr<PrimitiveBatch>> batches;
};

} // namespace

std::uint32_t LabelBatches::collect(osg::Node& root, const LabelSource& source, std::uint32_t first,
                                    const SetText& setText)
{
    BatchVisitor visitor;
    root.accept(visitor);
    std::lock_guard<std::mutex> lock(_mutex);
    for (const osg::ref_ptr<PrimitiveBatch>& batch : visitor.batches)
    {
        const std::uint32_t begin = first;
        for (unsigned int i = 0; i < batch->getNumObjects(); ++i)
        {
            const auto text = source.ofName(batch->getObjectName(i));
            batch->setIdentifier(i, text && !text->empty() ? first : 0);
            if (!text || text->empty())
                continue;
            setText(first, *text);
            ++first;
        }
        if (first > begin)
            _batches[begin] = {batch.get(), first};
    }
    return first;
}

LabelBatches::Found LabelBatches::find(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    auto after = _batches.upper_bound(identifier);
    if (after == _batches.begin())
        return {};
    const auto& [first, entry] = *--after;
    Found found;
    if (identifier >= entry.end || !entry.batch.lock(found.batch))
        return {};
    // Identifiers grow with the objects' numbers, with gaps where an object has no text.
    for (found.object = identifier - first; found.object < found.batch->getNumObjects();
         ++found.object)
        if (found.batch->getIdentifier(found.object) == identifier)
            return found;
    return {};
}

std::size_t LabelBatches::getCount() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::size_t count = 0;
    for (const auto& [first, entry] : _batches)
        count += entry.end - first;
    return count;
}

std::size_t LabelBatches::getBytes() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    std::size_t bytes = 0;
    for (const auto& [first, entry] : _batches)
        if (osg::ref_ptr<PrimitiveBatch> batch; entry.batch.lock(batch))
            bytes += batch->getGpuBytes();
    return bytes;
}

} // namespace osgLabels
