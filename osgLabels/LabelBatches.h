// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/FramesInFlight.h>
#include <osgLabels/LabelSource.h>
#include <osgLabels/LabelTable.h>
#include <osgLabels/NumberSpace.h>
#include <osgLabels/PrimitiveBatch.h>
#include <osgLabels/Stretches.h>

#include <osg/observer_ptr>

#include <functional>
#include <map>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace osgLabels
{

/// The PrimitiveBatches of a scene: a label for each of their objects that has a text, and a place
/// for each record. What build() has made is never written again, so that other threads may draw
/// while a batch is built anew. Thread safe.
class OSGLABELS_EXPORT LabelBatches
{
public:
    using Encode = std::function<LabelTable::Codes(const std::string& utf8)>;
    using StyleOf = std::function<std::uint32_t(const std::string& name)>;

    /// Where labels are numbered and stored; all live as long.
    struct Places
    {
        std::shared_ptr<LabelTable> table;
        NumberSpace& identifiers;
        NumberSpace& records;
        const FramesInFlight& frames;
    };
    explicit LabelBatches(const Places& places) : _places(places) {}

    /// What texts come from. To be called first.
    void setSource(std::shared_ptr<const LabelSource> source, Encode encode, StyleOf styleOf = {});

    // Only while nobody changes the subgraph, such as in cull.

    /// Takes in all batches below `root`.
    void collect(osg::Node& root);
    /// What has to be added to the place of a record in the run's page; 0 for a run of no batch.
    /// Takes in the run's batch where it is new or has been built anew.
    std::uint32_t recordBaseOf(const PrimitiveRun& run);
    /// Forgets batches that are gone.
    void sweep();

    // From any thread.

    /// UTF-8. False for an identifier that no batch has.
    bool setText(std::uint32_t identifier, const std::string& text);

    struct Found
    {
        osg::ref_ptr<PrimitiveBatch> batch; ///< Null for an identifier of no batch.
        unsigned int object = 0;
        std::string text; ///< What setText() has set.
        bool hasText = false;
    };
    Found find(std::uint32_t identifier) const;

    /// The identifier of a record; 0 for none.
    std::uint32_t getIdentifier(std::uint32_t record) const;
    /// How many batches have been taken in so far.
    std::uint64_t getTime() const;
    /// Calls `f` with pieces of the records of all batches that were taken in after the time
    /// `since`, until `until`.
    using Records =
        std::function<void(std::uint32_t first, const std::uint32_t* words, std::uint32_t count)>;
    void forEachRecord(std::uint64_t since, std::uint64_t until, const Records& f) const;

    /// Objects of all batches.
    std::uint32_t getNumObjects() const;
    /// A bit for each shape that they have had.
    std::uint32_t getShapes() const;
    /// Of their colours on the GPU.
    std::size_t getBytes() const;

private:
    /// A batch as it was when it was taken in.
    struct Entry
    {
        osg::observer_ptr<PrimitiveBatch> batch;
        std::vector<osg::ref_ptr<PrimitiveRun>> runs;
        std::vector<osg::ref_ptr<RecordPage>> pages;
        std::uint64_t time = 0; ///< When.
        std::uint32_t firstRecord = 0, objects = 0, firstIdentifier = 0, labels = 0;
        Stretches identifiers; ///< Of objects.
    };
    using EntryPointer = std::shared_ptr<const Entry>;
    using Batches = std::map<const PrimitiveBatch*, EntryPointer>;

    void add(PrimitiveBatch& batch);
    void addLabels(const PrimitiveBatch& batch, Entry& entry);
    Batches::iterator remove(Batches::iterator batch);
    static const Entry* entryAt(const std::map<std::uint32_t, EntryPointer>& entries,
                                std::uint32_t number);
    static void writeRecords(const Entry& entry, const Records& f);

    const Places _places;
    std::shared_ptr<const LabelSource> _source;
    Encode _encode;
    StyleOf _styleOf;
    const osg::Node* _root = nullptr; ///< Of the last collect().
    mutable std::mutex _mutex;
    Batches _batches;
    /// By their first numbers. Records stay while a frame may show them.
    std::map<std::uint32_t, EntryPointer> _byIdentifier, _byRecord;
    Retired<EntryPointer> _retired;
    std::unordered_map<const PrimitiveRun*, std::uint32_t> _bases;
    std::unordered_map<std::uint32_t, std::string> _texts; ///< What setText() has set.
    std::uint64_t _time = 0;
    std::uint32_t _numObjects = 0, _shapes = 0;
};

} // namespace osgLabels
