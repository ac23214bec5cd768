// SPDX-License-Identifier: MIT
#include <osgLabels/LabelBatches.h>

#include <osg/NodeVisitor>

#include <iterator>

namespace osgLabels
{

namespace
{

class BatchVisitor : public osg::NodeVisitor
{
public:
    explicit BatchVisitor(std::function<void(PrimitiveBatch&)> f)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _f(std::move(f))
    {
        setNodeMaskOverride(~0u); // what is hidden now may be shown later
    }
    void apply(osg::Group& group) override
    {
        if (auto* batch = dynamic_cast<PrimitiveBatch*>(&group))
            _f(*batch);
        else
            traverse(group);
    }

private:
    const std::function<void(PrimitiveBatch&)> _f;
};

PrimitiveBatch* batchOf(const PrimitiveRun& run)
{
    const osg::Node* node = &run;
    while (node->getNumParents())
    {
        node = node->getParent(0);
        if (auto* batch = dynamic_cast<const PrimitiveBatch*>(node))
            return const_cast<PrimitiveBatch*>(batch);
    }
    return nullptr;
}

/// From below `root` down to the batch: one of them where there are several.
osg::NodePath pathOf(const PrimitiveBatch& batch, const osg::Node* root)
{
    for (const osg::NodePath& path : batch.getParentalNodePaths(const_cast<osg::Node*>(root)))
        if (!path.empty() && path.front() == root)
            return osg::NodePath(path.begin() + 1, path.end());
    return {};
}

} // namespace

void LabelBatches::setSource(std::shared_ptr<const LabelSource> source, Encode encode,
                             StyleOf styleOf)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _source = std::move(source);
    _encode = std::move(encode);
    _styleOf = std::move(styleOf);
}

void LabelBatches::collect(osg::Node& root)
{
    std::lock_guard<std::mutex> lock(_mutex);
    _root = &root;
    BatchVisitor visitor(
        [this](PrimitiveBatch& batch)
        {
            if (!_batches.count(&batch)) // may have several parents
                add(batch);
        });
    root.accept(visitor);
}

void LabelBatches::add(PrimitiveBatch& batch)
{
    const auto entry = std::make_shared<Entry>();
    entry->batch = &batch;
    entry->runs = batch.getRuns();
    entry->pages = batch.getContent().pages;
    entry->time = ++_time;
    entry->objects = batch.getNumObjects();
    _batches[&batch] = entry;
    if (!entry->objects)
        return;
    entry->firstRecord = _places.records.take(entry->objects);
    addLabels(batch, *entry);
    for (const osg::ref_ptr<PrimitiveRun>& run : entry->runs)
    {
        _bases[run.get()] = entry->firstRecord + run->getFirstObject() - run->getFirstRecord();
        _shapes |= 1u << std::uint32_t(run->getShape());
    }
    _byRecord[entry->firstRecord] = entry;
    if (entry->labels)
        _byIdentifier[entry->firstIdentifier] = entry;
    _numObjects += entry->objects;
}

void LabelBatches::addLabels(const PrimitiveBatch& batch, Entry& entry)
{
    entry.firstIdentifier = _places.identifiers.take(entry.objects);
    const osg::NodePath path = pathOf(batch, _root);
    for (unsigned int i = 0; i < entry.objects; ++i)
    {
        const auto label = _source->ofName(batch.getObjectName(i), path);
        if (!label)
            continue;
        const std::uint32_t identifier = entry.firstIdentifier + entry.labels++;
        entry.identifiers.add(i, identifier);
        _places.table->setCodes(identifier, _encode(label->text));
        if (_styleOf && !label->style.empty())
            _places.table->setStyle(identifier, _styleOf(label->style));
    }
    _places.identifiers.give(entry.firstIdentifier + entry.labels, entry.objects - entry.labels);
}

std::uint32_t LabelBatches::recordBaseOf(const PrimitiveRun& run)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _bases.find(&run);
    if (found != _bases.end())
        return found->second;
    PrimitiveBatch* batch = _source ? batchOf(run) : nullptr;
    if (!batch)
        return 0;
    if (const auto old = _batches.find(batch); old != _batches.end())
        remove(old);
    add(*batch);
    const auto added = _bases.find(&run);
    return added == _bases.end() ? 0 : added->second;
}

LabelBatches::Batches::iterator LabelBatches::remove(Batches::iterator batch)
{
    const EntryPointer entry = batch->second;
    for (const osg::ref_ptr<PrimitiveRun>& run : entry->runs)
        _bases.erase(run.get());
    for (std::uint32_t i = 0; i < entry->labels; ++i)
    {
        _places.table->remove(entry->firstIdentifier + i);
        _texts.erase(entry->firstIdentifier + i);
    }
    if (entry->labels)
        _byIdentifier.erase(entry->firstIdentifier);
    _numObjects -= entry->objects;
    _retired.add(entry, _places.frames);
    return _batches.erase(batch);
}

void LabelBatches::sweep()
{
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto batch = _batches.begin(); batch != _batches.end();)
        batch = batch->second->batch.valid() ? std::next(batch) : remove(batch);
    _retired.release(_places.frames,
                     [this](const EntryPointer& entry)
                     {
                         if (entry->labels)
                             _places.identifiers.give(entry->firstIdentifier, entry->labels);
                         if (!entry->objects)
                             return;
                         _places.records.give(entry->firstRecord, entry->objects);
                         _byRecord.erase(entry->firstRecord);
                     });
}

bool LabelBatches::setText(std::uint32_t identifier, const std::string& text)
{
    std::lock_guard<std::mutex> lock(_mutex);
    const Entry* entry = entryAt(_byIdentifier, identifier);
    if (!entry || identifier - entry->firstIdentifier >= entry->labels)
        return false;
    _texts[identifier] = text;
    return _places.table->setCodes(identifier, _encode(text));
}

const LabelBatches::Entry*
LabelBatches::entryAt(const std::map<std::uint32_t, EntryPointer>& entries, std::uint32_t number)
{
    const auto after = entries.upper_bound(number);
    return after == entries.begin() ? nullptr : std::prev(after)->second.get();
}

LabelBatches::Found LabelBatches::find(std::uint32_t identifier) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const Entry* entry = entryAt(_byIdentifier, identifier);
    const auto object = entry ? entry->identifiers.leftOf(identifier) : std::nullopt;
    Found found;
    if (!object || !entry->batch.lock(found.batch))
        return {};
    found.object = *object;
    const auto text = _texts.find(identifier);
    found.hasText = text != _texts.end();
    if (found.hasText)
        found.text = text->second;
    return found;
}

std::uint32_t LabelBatches::getIdentifier(std::uint32_t record) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const Entry* entry = entryAt(_byRecord, record);
    return entry ? entry->identifiers.rightOf(record - entry->firstRecord).value_or(0) : 0;
}

std::uint64_t LabelBatches::getTime() const
{
    std::lock_guard<std::mutex> lock(_mutex);
    return _time;
}

void LabelBatches::forEachRecord(std::uint64_t since, std::uint64_t until, const Records& f) const
{
    std::vector<EntryPointer> entries;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        for (const auto& [first, entry] : _byRecord)
            if (entry->time > since && entry->time <= until)
                entries.push_back(entry);
    }
    for (const EntryPointer& entry : entries)
        writeRecords(*entry, f);
}

void LabelBatches::writeRecords(const Entry& entry, const Records& f)
{
    std::uint32_t object = 0;
    std::vector<std::uint32_t> words;
    for (const osg::ref_ptr<RecordPage>& page : entry.pages)
    {
        words.assign(page->getRecords().begin(), page->getRecords().end());
        for (std::uint32_t i = 0; i < page->size(); ++i)
            words[ObjectRecord::Words * i + ObjectRecord::IdentifierWord] =
                entry.identifiers.rightOf(object + i).value_or(0);
        f(entry.firstRecord + object, words.data(), page->size());
        object += page->size();
    }
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

std::size_t LabelBatches::getBytes() const
{
    return std::size_t(getNumObjects()) * sizeof(std::uint32_t);
}

} // namespace osgLabels
